// A folder as those of EuRoC are, made by hand: a body whose x axis is up, two different cameras with lenses,
// 17 columns of truth at a higher rate, lines that end as on Windows. Its pictures are painted ray by ray.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "tests/test_folder.h"

namespace stereobench::harness {

struct PaintedCamera {
  double fu, fv, cu, cv;
  std::array<double, 4> lens;  // k1, k2, p1, p2
  Eigen::Isometry3d body_from_camera;
};

struct PaintedBall {
  int colour;  // 0 red, 2 blue
  Eigen::Vector3d centre_m;
};

// What is in the folder, for a test to compute what it expects in its own way.
struct PaintedEuroc {
  static constexpr int kWidth = 376, kHeight = 240, kFrames = 4;
  static constexpr double kRadius_m = 0.08;
  static constexpr std::int64_t kFirst_ns = 1'403'636'579'763'555'584, kEvery_ns = 50'000'000;
  static constexpr std::int64_t kTruthBegins_ns = kFirst_ns + 3'000'000;  // after the first picture
  std::array<PaintedCamera, 2> cameras;
  std::vector<PaintedBall> balls;

  PaintedEuroc();
  static std::int64_t stamp_ns(int frame) { return kFirst_ns + frame * kEvery_ns; }
  // The body flies along a line, at one speed, without a turn.
  static Eigen::Isometry3d world_from_body(std::int64_t stamp_ns);
  // Writes mav0/; cam1 has no picture of the last frame.
  void write(const TestFolder& folder) const;
};

}  // namespace stereobench::harness
