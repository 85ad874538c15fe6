/// Readers of data sets by format: one row a format, which `verify --as NAME` chooses.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "harness/logs/recorded_streams.h"
#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// What the program can read of a format, whoever wrote it.
struct DatasetReader {
  std::string_view format;  ///< its name
  /// Whether a folder looks like one of the format, by the files that the format cannot be without.
  bool (*recognises)(const std::filesystem::path& folder);
  /// @throws std::runtime_error, one line, where nothing of the folder can be read. What is wrong with single
  ///   files is a fault.
  DatasetView (*read)(const std::filesystem::path& folder);
  /// Why `import` does not read it, after "the format NAME"; empty where it does.
  std::string_view not_imported;
  /// Reads the odometry, with what was seen and the true path where they are there, but no instants; null
  /// where the format has none. @throws std::runtime_error as `read`
  RecordedStreams (*read_log)(const std::filesystem::path& folder) = nullptr;
};

/// All readers, in the order in which folders are tried.
std::span<const DatasetReader> dataset_readers();

/// @throws std::runtime_error, one line that lists the formats there are, for an unknown name
const DatasetReader& dataset_reader(std::string_view name);

/// The reader that a folder is recognised by.
/// @throws std::runtime_error, one line, where there is none
const DatasetReader& reader_of(const std::filesystem::path& folder);

}  // namespace stereobench::harness
