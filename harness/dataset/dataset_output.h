/// A folder that becomes a data set of one format, pair by pair.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/rendered_dataset.h"

namespace stereobench::harness {

/// A folder that is to be a data set.
struct WantedDataset {
  const DatasetFormat* format = nullptr;
  std::filesystem::path folder;
  nlohmann::ordered_json identity;  ///< of RenderedDataset
};

/// What became of it.
struct WrittenDataset {
  long pairs = 0;                   ///< stereo pairs of the data set; 0 where it was complete
  bool was_complete = false;        ///< there was nothing to do
  std::vector<std::string> spoilt;  ///< files that were not as they had been written, and are again
};

/// Where one of several formats goes: a folder of its own in the one that was asked for. One alone is that
/// one.
std::filesystem::path folder_of(const std::filesystem::path& out, const DatasetFormat& format,
                                const std::vector<const DatasetFormat*>& formats);

/// Makes sure that data sets can be begun: none of their folders holds another one, nor does the one around
/// them.
/// @throws std::runtime_error, one line
void require_room(const std::vector<WantedDataset>& wanted, const std::filesystem::path& out);

class DatasetOutput {
 public:
  /// @param drive outlives it
  /// @throws std::runtime_error as RenderedDataset
  DatasetOutput(const WantedDataset& wanted, const DatasetDrive& drive);

  /// Every pair of the drive, in order. Where the data set is complete, nothing is done.
  void write(DatasetPair& pair);
  void finish(const MeasurementLog& log, const CoarseBlur& blur);

  const WrittenDataset& written() const { return written_; }

 private:
  RenderedDataset dataset_;
  std::unique_ptr<DatasetWriter> writer_;
  WrittenDataset written_;
};

}  // namespace stereobench::harness
