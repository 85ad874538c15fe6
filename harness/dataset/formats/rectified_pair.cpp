#include "harness/dataset/formats/rectified_pair.h"

#include <fmt/format.h>

#include "harness/io/calibration_file.h"

namespace stereobench::harness {

std::string projection_row(const vision::StereoRig& rig, double from_left_m) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const double f = camera.focal_px;
  return fmt::format("{} 0 {} {} 0 {} {} 0 0 0 1 0", f, camera.cx_px,
                     from_left_m == 0.0 ? 0.0 : -f * from_left_m, f, camera.cy_px);
}

std::string key_without_place(const worlds::Scenario& scenario) {
  const vision::StereoRig& rig = scenario.rig;
  if (!(rig.distortion == vision::Distortion{.pixel_aspect = rig.distortion.pixel_aspect}))
    return "rig.distortion";
  if (rig.distortion.pixel_aspect != 1.0) return "rig.pixel_aspect";
  if (!rig.right_turn_rad.isZero(0.0)) return "rig.right_turn_deg";
  if (calibration_yaml(scenario.believed_rig) != calibration_yaml(rig)) return "believed_rig";
  if (scenario.shutter.readout_s != 0.0) return "shutter.readout_s";
  if (scenario.shutter.right_delay_s != 0.0) return "shutter.right_delay_s";
  return {};
}

}  // namespace stereobench::harness
