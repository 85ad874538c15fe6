/// Reads folders of VSLAM-LAB's layout.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_like_vslamlab(const std::filesystem::path& folder);
DatasetView read_vslamlab_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
