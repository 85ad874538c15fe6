/// Reads folders of the format `plain`, with or without dataset.json.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_plain(const std::filesystem::path& folder);
DatasetView read_plain_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
