/// Reads logs in the files of UTIAS MRCLAM, and holds them against themselves.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_like_mrclam(const std::filesystem::path& folder);
/// A frame is an instant at which a robot saw something; there are no pictures.
DatasetView read_mrclam_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
