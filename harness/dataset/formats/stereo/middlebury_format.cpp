#include "harness/dataset/formats/stereo/middlebury_format.h"

#include <fmt/format.h>

#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/formats/rectified_pair.h"

namespace stereobench::harness {
namespace {

using vision::Side;

class MiddleburyWriter final : public DatasetWriter {
 public:
  explicit MiddleburyWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    std::vector<DatasetFile> files;
    const std::string folder = fmt::format("{:06}/", pair.step());
    for (const Side side : kBothSides) {
      const int camera = side == Side::kLeft ? 0 : 1;
      files.push_back(camera_file(fmt::format("{}im{}.png", folder, camera), pair, side));
      files.push_back(picture_file(fmt::format("{}disp{}.pfm", folder, camera),
                                   [side, &pair] { return disparity_of(pair, side); }));
      files.push_back(picture_file(fmt::format("{}mask{}nocc.png", folder, camera),
                                   [side, &pair] { return seen_by_both(pair, side); }));
      if (side == Side::kLeft)
        files.push_back({folder + "calib.txt", [this, &pair] {
                           return middlebury_calibration(drive_.rig, disparity_of(pair, Side::kLeft));
                         }});
    }
    return files;
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }

 private:
  const DatasetDrive& drive_;
};

}  // namespace

void check_middlebury_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"middlebury", "rectified pairs of one instant, and their disparity"};
  limits.require_pairs(drive);
}

std::unique_ptr<DatasetWriter> middlebury_writer(const DatasetDrive& drive) {
  return std::make_unique<MiddleburyWriter>(drive);
}

}  // namespace stereobench::harness
