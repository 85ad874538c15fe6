/// Reads folders of TUM's RGB-D layout.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_like_tum(const std::filesystem::path& folder);
DatasetView read_tum_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
