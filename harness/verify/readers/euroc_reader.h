/// Reads folders of EuRoC's layout (ASL).
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_like_euroc(const std::filesystem::path& folder);
DatasetView read_euroc_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
