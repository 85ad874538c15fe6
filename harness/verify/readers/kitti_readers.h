/// Reads folders of KITTI's layouts: odometry, stereo of 2012 and 2015, scene flow.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_like_kitti_odometry(const std::filesystem::path& folder);
DatasetView read_kitti_odometry_view(const std::filesystem::path& folder);

/// The three take the folder itself, or its `training`.
bool looks_like_kitti_stereo(const std::filesystem::path& folder);
DatasetView read_kitti_stereo_view(const std::filesystem::path& folder);
bool looks_like_kitti_stereo_2012(const std::filesystem::path& folder);
DatasetView read_kitti_stereo_2012_view(const std::filesystem::path& folder);
bool looks_like_kitti_scene_flow(const std::filesystem::path& folder);
DatasetView read_kitti_scene_flow_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
