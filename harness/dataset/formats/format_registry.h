/// Data-set formats by name: one row a format, which `render --format NAME` chooses.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// What the program knows of a format.
struct DatasetFormat {
  std::string_view name;   ///< on command lines and in dataset.json
  std::string_view holds;  ///< what there is beside the stereo pairs, as the program prints it
  std::string_view needs;  ///< of the truth that a data set may have (truth_request.h): "disparity,flow"
  /// Refuses what the format cannot hold truthfully. @throws std::runtime_error, one line
  void (*check)(const DatasetDrive& drive);
  /// Starts on a drive that was checked. @param drive outlives the writer
  std::unique_ptr<DatasetWriter> (*make)(const DatasetDrive& drive);
  std::string_view pictures = "colour";  ///< the kinds of picture that it holds (picture_kind.h)
  bool has_sightings = false;            ///< its files say what the detector found
};

/// Refuses what a format cannot hold, its pictures' kind included. @throws std::runtime_error, one line
void check_format(const DatasetFormat& format, const DatasetDrive& drive);

/// Whether it is the first one, which holds everything.
bool is_plain(const DatasetFormat& format);

/// The truth that a format needs of a data set that it is exported from.
std::vector<TruthKind> needed_truth(const DatasetFormat& format);

/// @return all formats, in the order in which they are listed; the first one is the default
std::span<const DatasetFormat> dataset_formats();

/// @param option that the name was given to, for the message
/// @throws std::runtime_error, one line that lists the formats there are, for an unknown name
const DatasetFormat& dataset_format(std::string_view name, std::string_view option = "--format");

/// Reads "plain,tum". @return at least one, each once, in the order of the text
/// @throws std::runtime_error, one line, for an unknown name, and for one that stands there twice
std::vector<const DatasetFormat*> parse_formats(const std::string& text, std::string_view option);

}  // namespace stereobench::harness
