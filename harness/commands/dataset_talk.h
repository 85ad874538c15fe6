/// What commands say that write data sets.
#pragma once

#include <filesystem>
#include <string>

#include "harness/dataset/dataset_output.h"

namespace stereobench::harness {

/// The formats and what each holds, for help: "plain (ids, ...), tum (...)".
std::string names_and_contents();

/// Says what a folder holds now, and which of its files had been spoilt.
/// @param name of the drive
void say_what_was_written(const std::string& name, const DatasetFormat& format,
                          const std::filesystem::path& folder, const WrittenDataset& written);

}  // namespace stereobench::harness
