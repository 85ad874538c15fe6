/// What a sample's .json of `render --format webdataset` says.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// A ball of a sample: what holds for it in all samples, and what each camera sees.
struct SampleBall {
  int ball = 0;
  std::int64_t colour = 0;
  ViewBall in_world;
  std::array<Eigen::Vector3d, 2> centre_in_camera_m;  ///< by vision::Side, as below
  std::array<std::int64_t, 2> px_count_visib{};
  std::array<cv::Rect, 2> bbox_visib;  ///< empty where the camera sees none of it
};

/// One stereo pair.
struct ShardSample {
  std::string drive;
  std::uint64_t seed = 0;
  int step = 0;
  std::int64_t stamp_ns = 0;
  bool is_late = false;  ///< its pictures were taken after its time
  nlohmann::json said_of_rig;
  vision::StereoRig rig, believed_rig;
  Eigen::Isometry3d world_from_robot = Eigen::Isometry3d::Identity();
  std::array<Eigen::Isometry3d, 2> world_from_camera;
  std::vector<SampleBall> balls;
};

/// Whether a sample's .json says what ours say; other programs' samples may have anything there.
bool is_stereo_sample(const std::string& text);

/// @throws BadLine where a key is missing or no such value
ShardSample shard_sample(const std::string& text);

}  // namespace stereobench::harness
