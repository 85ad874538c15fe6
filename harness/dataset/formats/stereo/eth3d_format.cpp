#include "harness/dataset/formats/stereo/eth3d_format.h"

#include <fmt/format.h>

#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/formats/rectified_pair.h"

namespace stereobench::harness {
namespace {

using vision::Side;

class Eth3dWriter final : public DatasetWriter {
 public:
  explicit Eth3dWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    const std::string pictures = fmt::format("two_view_training/{:06}/", pair.step());
    const std::string truth = fmt::format("two_view_training_gt/{:06}/", pair.step());
    return {camera_file(pictures + "im0.png", pair, Side::kLeft),
            camera_file(pictures + "im1.png", pair, Side::kRight),
            {pictures + "calib.txt",
             [this, &pair] { return middlebury_calibration(drive_.rig, disparity_of(pair, Side::kLeft)); }},
            picture_file(truth + "disp0GT.pfm", [&pair] { return disparity_of(pair, Side::kLeft); }),
            picture_file(truth + "mask0nocc.png", [&pair] { return seen_by_both(pair, Side::kLeft); })};
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }

 private:
  const DatasetDrive& drive_;
};

}  // namespace

void check_eth3d_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"eth3d", "rectified pairs of one instant, and their disparity"};
  limits.require_pairs(drive);
}

std::unique_ptr<DatasetWriter> eth3d_writer(const DatasetDrive& drive) {
  return std::make_unique<Eth3dWriter>(drive);
}

}  // namespace stereobench::harness
