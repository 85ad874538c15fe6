#include "worlds/scenario_parts.h"

namespace stereobench::worlds {

CameraSensor read_camera(const YamlValue& value) {
  const YamlMap map(value, {"noise_sd_levels", "defocus_sd_px", "vignette", "exposure", "full_well_electrons",
                            "read_noise_electrons", "gain", "white_balance_rgb", "encoding", "gamma"});
  constexpr Interval kGain = {1e-3, 1e3};
  constexpr std::array<std::string_view, 3> kEncodings = {"linear", "srgb", "gamma"};
  CameraSensor sensor;
  sensor.noise_sd_levels = map.number("noise_sd_levels", {0.0, 255.0}, sensor.noise_sd_levels);
  sensor.defocus_sd_px = map.number("defocus_sd_px", {0.0, 100.0}, sensor.defocus_sd_px);
  sensor.vignette = map.number("vignette", {0.0, 1.0}, sensor.vignette);
  sensor.exposure = map.number("exposure", kGain, sensor.exposure);
  sensor.full_well_electrons = map.number("full_well_electrons", {0.0, 1e6}, sensor.full_well_electrons);
  if (const auto read_noise = map.find("read_noise_electrons")) {
    sensor.read_noise_electrons = read_noise->number({0.0, 1e6});
    if (sensor.full_well_electrons == 0.0)
      read_noise->refuse("electrons are counted with full_well_electrons");
  }
  sensor.gain = map.number("gain", kGain, sensor.gain);
  if (const auto balance = map.find("white_balance_rgb"))
    sensor.white_balance_rgb = read_vector<3>(*balance, kGain);
  if (const auto encoding = map.find("encoding"))
    sensor.encoding = static_cast<Encoding>(encoding->choice(kEncodings));
  if (const auto gamma = map.find("gamma")) {
    sensor.gamma = gamma->number({0.1, 10.0});
    if (sensor.encoding != Encoding::kGamma) gamma->refuse("a gamma needs `encoding: gamma`");
  }
  return sensor;
}

Shutter read_shutter(const YamlValue& value) {
  const YamlMap map(value, {"open_s", "samples", "right_delay_s", "readout_s", "drop_probability",
                            "late_probability", "late_s"});
  Shutter shutter;
  shutter.open_s = map.number("open_s", {0.0, 10.0}, shutter.open_s);
  if (const auto samples = map.find("samples")) shutter.samples = samples->integer(1, 1000);
  shutter.right_delay_s = map.number("right_delay_s", {-10.0, 10.0}, shutter.right_delay_s);
  shutter.readout_s = map.number("readout_s", {-1.0, 1.0}, shutter.readout_s);
  shutter.drop_probability = map.number("drop_probability", {0.0, 1.0}, shutter.drop_probability);
  shutter.late_probability = map.number("late_probability", {0.0, 1.0}, shutter.late_probability);
  shutter.late_s = map.number("late_s", {-10.0, 10.0}, shutter.late_s);
  return shutter;
}

}  // namespace stereobench::worlds
