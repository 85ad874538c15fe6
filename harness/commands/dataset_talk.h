/// What commands say that write data sets.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "harness/dataset/dataset_output.h"
#include "harness/dataset/pictures/picture_change.h"

namespace stereobench::harness {

/// The formats and what each holds, for help: "plain (ids, ...), tum (...)".
std::string names_and_contents();

/// Adds --every, --crop, --scale and --picture, what is changed of pictures when they are written.
void add_picture_options(CLI::App& command, const std::shared_ptr<PictureChange>& change);

/// Says what a folder holds now, and which of its files had been spoilt.
/// @param name of the drive
void say_what_was_written(const std::string& name, const DatasetFormat& format,
                          const std::filesystem::path& folder, const WrittenDataset& written);

}  // namespace stereobench::harness
