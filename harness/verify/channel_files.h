/// The files of channels, read into one form each.
#pragma once

#include <filesystem>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// Reads a file of a channel.
/// @param step of its levels, px or m; 0 for files of floats
/// @return in the form that Channel says
/// @throws std::runtime_error, one line, for what cannot be read, or is of another type
cv::Mat read_channel(const std::filesystem::path& file, Channel channel, double step);

}  // namespace stereobench::harness
