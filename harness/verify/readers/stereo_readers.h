/// Reads folders of Middlebury's, ETH3D's and Scene Flow's layouts.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_like_middlebury(const std::filesystem::path& folder);
DatasetView read_middlebury_view(const std::filesystem::path& folder);

bool looks_like_eth3d(const std::filesystem::path& folder);
DatasetView read_eth3d_view(const std::filesystem::path& folder);

bool looks_like_sceneflow(const std::filesystem::path& folder);
DatasetView read_sceneflow_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
