/// Data sets of the format `plain` in other formats, without rendering them again.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "harness/dataset/dataset_output.h"
#include "harness/dataset/pictures/picture_change.h"

namespace stereobench::harness {

/// Writes a finished data set in other formats, perhaps with its pictures changed. The files are those that
/// `render --format` would have written, to the byte; what is complete is left as it is, what was interrupted
/// is gone on with. Pictures are copied as they are, unless they are changed; the format plain is written of
/// changed ones alone.
/// @param out the folder, or of several formats the one that theirs lie in (folder_of)
/// @return one for each format
/// @throws std::runtime_error, one line, when the folder is no finished data set of the format
///   `plain`, or one of its files is not as it was rendered; when a format has no place for something of it,
///   or needs truth that it has not; when it was changed before, or cannot be changed so
std::vector<WrittenDataset> export_dataset(const std::filesystem::path& dataset,
                                           const std::vector<const DatasetFormat*>& formats,
                                           const std::filesystem::path& out, const PictureChange& change,
                                           const std::function<void(double)>& on_progress);

}  // namespace stereobench::harness
