/// Data-set formats by name: one row a format, which `render --format NAME` chooses.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// What the program knows of a format.
struct DatasetFormat {
  std::string_view name;   ///< on command lines and in dataset.json
  std::string_view holds;  ///< what there is beside the stereo pairs, as the program prints it
  /// Refuses what the format cannot hold truthfully. @throws std::runtime_error, one line
  void (*check)(const worlds::Scenario& scenario, const TruthRequest& truth);
  /// Starts on a drive that was checked. @param drive outlived by its scenario and world
  std::unique_ptr<DatasetWriter> (*make)(const DatasetDrive& drive);
};

/// @return all formats, in the order in which they are listed; the first one is the default
std::span<const DatasetFormat> dataset_formats();

/// @throws std::runtime_error, one line that lists the formats there are, for an unknown name
const DatasetFormat& dataset_format(std::string_view name);

}  // namespace stereobench::harness
