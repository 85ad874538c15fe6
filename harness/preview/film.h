/// A data set as a film, by the program ffmpeg.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// The program in the folders of PATH.
/// @throws std::runtime_error, one line that says how to get it, where it is not there
std::filesystem::path find_ffmpeg();

/// Left and right pictures side by side, as screens show them, ten pairs a second, at most 1280 px wide.
/// @param frames indices, at least one
/// @param on_progress is told the share that is done, 0 to 1
/// @return the bytes of an MP4 file; they depend on the program's version
/// @throws std::runtime_error, one line, for a picture that is missing or broken, and with its last words
/// when
///   the program fails
std::string film_of(const DatasetView& view, const std::vector<std::size_t>& frames,
                    const std::filesystem::path& ffmpeg, const std::function<void(double)>& on_progress);

}  // namespace stereobench::harness
