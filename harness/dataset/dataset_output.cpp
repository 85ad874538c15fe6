#include "harness/dataset/dataset_output.h"

#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {

std::filesystem::path folder_of(const std::filesystem::path& out, const DatasetFormat& format,
                                const std::vector<const DatasetFormat*>& formats) {
  return formats.size() > 1 ? out / format.name : out;
}

void require_room(const std::vector<WantedDataset>& wanted, const std::filesystem::path& out) {
  for (const WantedDataset& one : wanted) {
    if (one.folder != out && holds_rendering(out))
      throw std::runtime_error(fmt::format(
          "{}: holds a data set itself, and cannot hold several; choose another folder or remove it",
          out.string()));
    require_same_rendering(one.folder, one.identity);
  }
}

DatasetOutput::DatasetOutput(const WantedDataset& wanted, const DatasetDrive& drive)
    : dataset_(wanted.folder, wanted.identity),
      writer_(wanted.format->make(drive)),
      written_{.was_complete = dataset_.is_complete(), .spoilt = dataset_.spoilt()} {}

void DatasetOutput::write(DatasetPair& pair) {
  if (written_.was_complete) return;
  dataset_.write(pair.step(), writer_->frame_files(pair));
  ++written_.pairs;
}

void DatasetOutput::finish(const MeasurementLog& log, const CoarseBlur& blur) {
  if (written_.was_complete) return;
  dataset_.finish(writer_->drive_files(log), blur, writer_->containers(log));
}

}  // namespace stereobench::harness
