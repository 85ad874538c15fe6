#include "harness/dataset/formats/format_limits.h"

#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/calibration_file.h"

namespace stereobench::harness {

void FormatLimits::refuse(std::string_view key) const {
  throw std::runtime_error(fmt::format("the format {} has no place for {}; it holds {}", format, key, holds));
}

void FormatLimits::require_undistorted(const DatasetDrive& drive) const {
  const vision::Distortion& lens = drive.rig.distortion;
  if (!(lens == vision::Distortion{.pixel_aspect = lens.pixel_aspect})) refuse("rig.distortion");
  if (lens.pixel_aspect != 1.0) refuse("rig.pixel_aspect");
}

void FormatLimits::require_rectified(const DatasetDrive& drive) const {
  require_undistorted(drive);
  if (!drive.rig.right_turn_rad.isZero(0.0)) refuse("rig.right_turn_deg");
}

void FormatLimits::require_believed(const DatasetDrive& drive) const {
  if (calibration_yaml(drive.believed_rig) != calibration_yaml(drive.rig)) refuse("believed_rig");
}

void FormatLimits::require_whole_pictures(const DatasetDrive& drive) const {
  if (drive.shutter.readout_s != 0.0) refuse("shutter.readout_s");
}

void FormatLimits::require_one_instant(const DatasetDrive& drive) const {
  require_whole_pictures(drive);
  if (drive.shutter.right_delay_s != 0.0) refuse("shutter.right_delay_s");
}

void FormatLimits::require_pairs(const DatasetDrive& drive) const {
  require_rectified(drive);
  require_believed(drive);
  require_one_instant(drive);
}

void FormatLimits::require_in_time(const DatasetDrive& drive) const {
  if (drive.shutter.late_probability > 0.0) refuse("shutter.late_probability");
}

void FormatLimits::require_all_frames(const DatasetDrive& drive) const {
  if (drive.shutter.drop_probability > 0.0) refuse("shutter.drop_probability");
}

}  // namespace stereobench::harness
