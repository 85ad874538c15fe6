/// Frames to compare: of random rooms, from this process or another, and how much two of them differ.
#pragma once

#include <cstdint>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "renderer/backend.h"
#include "renderer/types.h"

namespace stereobench::renderer {

/// For names of tests.
inline void PrintTo(Backend backend, std::ostream* out) {
  *out << name_of(backend);
}

}  // namespace stereobench::renderer

namespace stereobench::renderer::test {

/// Bit for bit.
bool same(const cv::Mat& a, const cv::Mat& b);
bool same(const StereoFrame& a, const StereoFrame& b);

/// In how many pixels two frames of one size differ.
struct Difference {
  int ids = 0;      ///< another identity
  int colours = 0;  ///< a channel off by more than one level
  int depths = 0;   ///< off by more than a share of itself, or nothing there in one
};

/// @param depth_share 1e-5 are a hundred steps of a float
Difference difference(const StereoFrame& a, const StereoFrame& b, double depth_share = 1e-5);

/// Of all bytes of colours, identities and depths (FNV-1a).
std::uint64_t hash_of(const StereoFrame& frame);

/// What small_rig sees of random_room(room), with a texture in it, from random_pose(room).
StereoFrame room_frame(std::uint64_t room, Backend backend);

/// The frames of rooms 0 to `rooms` - 1 as another process renders them.
/// @param environment set for that process, e.g. "LP_NUM_THREADS=0 LP_NATIVE_VECTOR_WIDTH=128"
std::vector<StereoFrame> frames_of_process(const std::string& environment, Backend backend, int rooms);

/// The other process's side.
void write(const StereoFrame& frame, std::FILE* file);

}  // namespace stereobench::renderer::test
