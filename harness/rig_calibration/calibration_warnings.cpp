#include "harness/rig_calibration/calibration_warnings.h"

#include <algorithm>

#include <fmt/format.h>

#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

constexpr double kUnexplained =
    2.0;  // times what neighbours differ by; good pictures of real boards have 1.6
constexpr double kFineCorner_px = 0.1;  // of a corner: what finding corners is off by on sharp pictures
constexpr std::size_t kFewViews = 6;    // fewer, and a view that is off cannot be told by the others
constexpr double kPoorlyKnown = 0.005;  // of the focal length, and so of every range; of the aspect

std::string advice_on_smooth_errors(const BoardCalibration& calibration, const BoardSettings& settings) {
  if (!settings.compared.aspect && settings.square_pixels)
    return "leave out --pixels square, or show a flatter board";
  const bool all_rejected = std::ranges::none_of(calibration.models, [](const ModelTrial& t) {
    return t.refused.empty() && !t.taken && !(t.p < kRejected);
  });
  return fmt::format(
      "no model here has it{}: a board that is bent, another lens (fisheye), or a picture "
      "that was cropped or scaled unevenly",
      all_rejected ? ", the fullest included" : "");
}

}  // namespace

std::vector<std::string> warnings_of(const BoardCalibration& calibration, const BoardSettings& settings) {
  const RigFit& fit = calibration.fit;
  const double tilts_deg = fit.tilt_spread_rad * slam::kDegreesPerRad;
  std::vector<std::string> warnings;
  if (fit.corner_sd_px > std::max(kUnexplained * fit.neighbour_sd_px, kFineCorner_px))
    warnings.push_back(
        fmt::format("corners are {:.2f} px off where neighbours differ by {:.2f} px: an error that is smooth "
                    "over the board; {}",
                    fit.corner_sd_px, fit.neighbour_sd_px, advice_on_smooth_errors(calibration, settings)));
  if (calibration.used.size() < kFewViews)
    warnings.push_back(
        fmt::format("{} views: with fewer than {}, one that is off cannot be told by the others",
                    calibration.used.size(), kFewViews));
  double focal_sd = 0.0;
  for (std::size_t side = 0; side < 2; ++side)
    focal_sd = std::max(focal_sd, fit.cameras_sd[side][0] / fit.cameras[side][0]);
  if (focal_sd > kPoorlyKnown)
    warnings.push_back(
        fmt::format("the focal length is known to {:.1f} % only, and ranges are off as much: the "
                    "boards' tilts differ by up to {:.0f} deg, tilt it more",
                    100.0 * focal_sd, tilts_deg));
  double aspect_sd = 0.0;
  for (const ModelTrial& trial : calibration.models) aspect_sd = std::max(aspect_sd, trial.aspect_sd);
  if (aspect_sd > kPoorlyKnown)
    warnings.push_back(
        fmt::format("whether pixels are square is known to {:.1f} % only (boards' tilts differ by up "
                    "to {:.0f} deg): show the board larger, in more places",
                    100.0 * aspect_sd, tilts_deg));
  return warnings;
}

}  // namespace stereobench::harness
