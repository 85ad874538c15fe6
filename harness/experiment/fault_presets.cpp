#include "harness/experiment/fault_presets.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

std::vector<FaultPreset> centre_presets() {
  return {
      {.name = "detector.centre_noise",
       .says = "Centres are noisy, in each frame anew.",
       .why = "Fits of circles reach 0.1 px, blobs 0.5 px, boxes of networks 1 to 2 px.",
       .settings = {{"detector_noise.centre_sd_px", {"0.1", "0.25", "0.5", "1", "2"}}}},
      {.name = "detector.lasting_errors",
       .says = "Centres are noisy, and the error of a ball lasts 10 s.",
       .why = "The standard deviations of centre_noise: the two differ in how long errors last.",
       .settings = {{"detector_noise.centre_sd_px", {"0.1", "0.25", "0.5", "1", "2"}},
                    {"detector_noise.correlated_s", {"10", "10", "10", "10", "10"}}}},
      {.name = "detector.heavy_tail",
       .says = "Some centres are off by ten times as much as the others, whose error is 0.25 px.",
       .why = "From one outlier in fifty to three in ten, below the breakdown of a median.",
       .settings = {{"detector_noise.centre_sd_px", {"0.25", "0.25", "0.25", "0.25", "0.25"}},
                    {"detector_noise.heavy_tail",
                     {"{share: 0.02, sd_scale: 10}", "{share: 0.05, sd_scale: 10}",
                      "{share: 0.1, sd_scale: 10}", "{share: 0.2, sd_scale: 10}",
                      "{share: 0.3, sd_scale: 10}"}}}},
      {.name = "detector.centre_bias",
       .says = "Centres of the left camera are too far right, and so are disparities too large.",
       .why = "Half a pixel is what pixels counted from corners and from middles differ by.",
       .settings = {{"detector_noise.centre_bias_px",
                     {"[[0.1, 0], [0, 0]]", "[[0.25, 0], [0, 0]]", "[[0.5, 0], [0, 0]]", "[[1, 0], [0, 0]]",
                      "[[2, 0], [0, 0]]"}}}},
      {.name = "detector.range_scale",
       .says = "Ranges are too long, by the same share.",
       .why = "Data sheets of stereo cameras allow 1 to 2 % at 2 m, and 5 % far away.",
       .settings = {{"detector_noise.range_scale", {"1.002", "1.005", "1.01", "1.02", "1.05"}}}},
  };
}

std::vector<FaultPreset> arrival_presets() {
  return {
      {.name = "detector.misses",
       .says = "Detections are lost, in each frame anew.",
       .why = "From a recall of 0.95 to one of 0.4.",
       .settings = {{"detector_noise.miss_probability", {"0.05", "0.1", "0.2", "0.4", "0.6"}}}},
      {.name = "detector.miss_bursts",
       .says = "Balls are lost for five frames at a time.",
       .why = "The shares of misses: the two differ in how long losses last.",
       .settings = {{"detector_noise.miss_probability", {"0.05", "0.1", "0.2", "0.4", "0.6"}},
                    {"detector_noise.miss_burst_frames", {"5", "5", "5", "5", "5"}}}},
      {.name = "detector.false_detections",
       .says = "There are detections of nothing.",
       .why = "Of networks at a usual threshold one in fifty frames; two a frame in clutter.",
       .settings = {{"detector_noise.false_per_frame", {"0.02", "0.1", "0.3", "1", "2"}}}},
      {.name = "detector.swaps",
       .says = "Pairs of detections have each other's name.",
       .why = "From one pair in a hundred to one in five.",
       .settings = {{"detector_noise.identity_swap_probability", {"0.01", "0.02", "0.05", "0.1", "0.2"}}}},
      {.name = "detector.latency",
       .says = "Detections arrive so many frames late, and are taken for new ones.",
       .why = "Whole frames: at 30 Hz these are 33 to 170 ms, at 0.5 Hz 2 to 10 s.",
       .settings = {{"detector_noise.latency_frames", {"1", "2", "3", "4", "5"}}}},
      {.name = "detector.overconfident",
       .says = "Stated standard deviations are too small, and errors are what they were.",
       .why = "They are divided by 1.25, 1.6, 2.5, 5 and 10.",
       .settings = {{"detector_noise.covariance_scale", {"0.64", "0.4", "0.16", "0.04", "0.01"}}}},
  };
}

std::vector<FaultPreset> light_presets() {
  return {
      {.name = "camera.blur",
       .says = "The lens is out of focus.",
       .why = "A disk of 1 to 6 px radius; in ImageNet-C (Hendrycks and Dietterich, 2019) 3 to 10 px.",
       .settings = {{"camera.defocus_sd_px", {"0.5", "1", "1.5", "2", "3"}}}},
      {.name = "camera.underexposure",
       .says = "The pictures are too dark.",
       .why = "0.3, 0.5, 0.7, 1 and 1.3 stops too little light.",
       .settings = {{"camera.exposure", {"0.8", "0.7", "0.63", "0.5", "0.4"}}}},
      {.name = "camera.noise",
       .says = "Pixels are noisy, however bright they are.",
       .why = "ImageNet-C begins at 20 levels, a sensor without gain has 1 to 2.",
       .settings = {{"camera.noise_sd_levels", {"4", "8", "16", "24", "32"}}}},
      {.name = "camera.shot_noise",
       .says = "Few electrons fill a pixel, as with a high gain in the dark; 5 electrons of read noise.",
       .why = "Sensors hold 10 000 electrons without gain (EMVA 1288 data sheets); 40 dB of gain leave 100.",
       .settings = {{"camera.full_well_electrons", {"10000", "3000", "1000", "300", "100"}},
                    {"camera.read_noise_electrons", {"5", "5", "5", "5", "5"}}}},
      {.name = "camera.vignette",
       .says = "The corners are darker than the middle.",
       .why = "A lens alone loses cos^4: 0.5 at 33 degrees aside, 0.9 at 56 degrees.",
       .settings = {{"camera.vignette", {"0.2", "0.4", "0.6", "0.8", "0.9"}}}},
  };
}

std::vector<FaultPreset> shutter_presets() {
  return {
      {.name = "camera.motion_blur",
       .says = "The shutter is open for long, and what moves is blurred.",
       .why = "From daylight to a lamp at night: 5 to 100 ms.",
       .settings = {{"shutter.open_s", {"0.005", "0.01", "0.02", "0.05", "0.1"}}}},
      {.name = "camera.rolling_shutter",
       .says = "The last row looks later than the first.",
       .why = "From a fast sensor to a web camera at 15 Hz.",
       .settings = {{"shutter.readout_s", {"0.005", "0.01", "0.02", "0.033", "0.066"}}}},
      {.name = "rig.desync",
       .says = "The right camera looks later than the left one.",
       .why = "Software triggers are off by some ms, cameras that run freely at 30 Hz by up to 33 ms.",
       .settings = {{"shutter.right_delay_s", {"0.001", "0.002", "0.005", "0.016", "0.033"}}}},
      {.name = "rig.drops",
       .says = "Frames are lost.",
       .why = "From a busy bus to every other frame.",
       .settings = {{"shutter.drop_probability", {"0.02", "0.05", "0.1", "0.25", "0.5"}}}},
      {.name = "rig.late",
       .says = "In three frames of ten both cameras look later than the time stamp says.",
       .why = "USB and exposure control delay by 5 to 100 ms.",
       .settings = {{"shutter.late_probability", {"0.3", "0.3", "0.3", "0.3", "0.3"}},
                    {"shutter.late_s", {"0.005", "0.01", "0.02", "0.05", "0.1"}}}},
  };
}

std::vector<FaultPreset> belief_presets() {
  return {
      {.name = "rig.calibration",
       .says = "Baseline and focal length are taken for longer than they are.",
       .why = "A good calibration is within 0.1 %, values of a drawing within 2 %.",
       .settings =
           {{"believed_rig.baseline_m", {"1.001", "1.002", "1.005", "1.01", "1.02"}, LevelIs::kFactorOnTruth},
            {"believed_rig.focal_px", {"1.001", "1.002", "1.005", "1.01", "1.02"}, LevelIs::kFactorOnTruth}}},
      {.name = "rig.turn",
       .says = "The right camera is turned about all three axes, and vision does not know.",
       .why =
           "0.02 degrees is heat, 0.7 degrees a mount that was knocked: 9 px of rows where focal_px is 720.",
       .settings = {{"believed_rig.right_turn_deg",
                     {"[0.02, 0.02, 0.02]", "[0.05, 0.05, 0.05]", "[0.1, 0.1, 0.1]", "[0.3, 0.3, 0.3]",
                      "[0.7, 0.7, 0.7]"},
                     LevelIs::kAddedToTruth}}},
      {.name = "rig.lens",
       .says = "Vision takes the lens for another one: k1 is off.",
       .why = "0.002 is a calibration from few views, 0.05 a lens that nobody has calibrated.",
       .settings = {{"believed_rig.distortion",
                     {"[0.002, 0, 0, 0, 0]", "[0.005, 0, 0, 0, 0]", "[0.01, 0, 0, 0, 0]",
                      "[0.02, 0, 0, 0, 0]", "[0.05, 0, 0, 0, 0]"},
                     LevelIs::kAddedToTruth}}},
      {.name = "rig.pitch",
       .says = "The cameras look less far down than vision believes.",
       .why = "0.1 degrees is a robot that brakes, 5 degrees a mount that slipped.",
       .settings = {{"believed_rig.pitch_down_deg", {"0.1", "0.5", "1", "2", "5"}, LevelIs::kAddedToTruth}}},
  };
}

/// The keys of a group below `faults:`.
struct FaultGroup : worlds::KeyGroup {
  explicit FaultGroup(const std::string& name) {
    for (const FaultPreset& preset : fault_presets()) {
      if (!preset.name.starts_with(name + ".")) continue;
      keys.push_back(worlds::whole(preset.name.substr(name.size() + 1), 0, kMostSeverity, preset.says)
                         .with(&worlds::Key::fallback, "0"));
    }
  }
};

struct FaultGroups : worlds::KeyGroup {
  FaultGroups() {
    static const FaultGroup detector("detector"), camera("camera"), rig("rig");
    keys = {worlds::group("detector", detector, "Faults of the detector, whoever it is."),
            worlds::group("camera", camera, "Faults of the cameras' light and shutters."),
            worlds::group("rig", rig, "Faults of the rig's calibration and timing.")};
  }
};

}  // namespace

std::span<const FaultPreset> fault_presets() {
  static const std::vector<FaultPreset> presets = [] {
    std::vector<FaultPreset> all;
    for (const auto& some :
         {centre_presets(), arrival_presets(), light_presets(), shutter_presets(), belief_presets()})
      all.insert(all.end(), some.begin(), some.end());
    return all;
  }();
  return presets;
}

bool is_of_cameras(const FaultPreset& preset) {
  return std::ranges::any_of(preset.settings, [](const FaultSetting& setting) {
    return !setting.key.starts_with("detector_noise.");
  });
}

std::string quantity_of(const FaultSetting& setting) {
  if (setting.is == LevelIs::kValue) return std::string(setting.key);
  const std::string_view sign = setting.is == LevelIs::kFactorOnTruth ? "/" : "-";
  return fmt::format("{} {} rig{}", setting.key, sign, setting.key.substr(setting.key.find('.')));
}

const worlds::KeyGroup& fault_keys() {
  static const FaultGroups keys;
  return keys;
}

}  // namespace stereobench::harness
