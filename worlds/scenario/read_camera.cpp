#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kGain = {1e-3, 1e3};

}  // namespace

const KeyGroup& camera_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("noise_sd_levels", {0.0, 255.0},
                 "Standard deviation of Gaussian noise per pixel and channel, in levels of 255, before "
                 "encoding.")
              .otherwise("0"),
          number("defocus_sd_px", {0.0, 100.0},
                 "Standard deviation of the Gaussian that the lens makes of a point, in pixels.")
              .otherwise("0"),
          number("vignette", {0.0, 1.0}, "Share of the light that is lost in the corners.").otherwise("0"),
          number("exposure", kGain, "Light that is gathered; at 1, white fills the well.").otherwise("1"),
          number("full_well_electrons", {0.0, 1e6},
                 "Electrons of a white pixel, whose counts are Poisson's; 0 leaves out shot noise.")
              .otherwise("0"),
          number(
              "read_noise_electrons", {0.0, 1e6},
              "Standard deviation of the noise of reading a pixel, in electrons; needs full_well_electrons.")
              .otherwise("0"),
          number("gain", kGain, "Levels per electron; at 1, a full well is level 255.").otherwise("1"),
          number("white_balance_rgb", kGain, "Further gains of red, green and blue.")
              .vector(3)
              .otherwise("[1, 1, 1]"),
          choice("encoding", {"linear", "srgb", "gamma"}, "How a level stands for light.")
              .otherwise("linear"),
          number("gamma", {0.1, 10.0}, "Exponent of `encoding: gamma`: level = light^(1 / gamma).")
              .otherwise("2.2"),
      }};
  return keys;
}

CameraSensor read_camera(const YamlValue& value) {
  const YamlMap map(value, camera_keys());
  CameraSensor sensor;
  sensor.noise_sd_levels = map.number("noise_sd_levels", sensor.noise_sd_levels);
  sensor.defocus_sd_px = map.number("defocus_sd_px", sensor.defocus_sd_px);
  sensor.vignette = map.number("vignette", sensor.vignette);
  sensor.exposure = map.number("exposure", sensor.exposure);
  sensor.full_well_electrons = map.number("full_well_electrons", sensor.full_well_electrons);
  sensor.read_noise_electrons = map.number("read_noise_electrons", sensor.read_noise_electrons);
  if (const auto read_noise = map.find("read_noise_electrons");
      read_noise && sensor.full_well_electrons == 0.0)
    read_noise->refuse("electrons are counted with full_well_electrons");
  sensor.gain = map.number("gain", sensor.gain);
  sensor.white_balance_rgb = read_vector<3>(map, "white_balance_rgb", sensor.white_balance_rgb);
  sensor.encoding = read_choice(map, "encoding", sensor.encoding);
  sensor.gamma = map.number("gamma", sensor.gamma);
  if (const auto gamma = map.find("gamma"); gamma && sensor.encoding != Encoding::kGamma)
    gamma->refuse("a gamma needs `encoding: gamma`");
  return sensor;
}

const KeyGroup& shutter_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("open_s", {0.0, 10.0},
                 "How long the shutter is open around a frame's time, in seconds: what moves is blurred.")
              .otherwise("0"),
          whole("samples", 1, 1000, "Renderings that the blur is the average of, at least.").otherwise("8"),
          whole("most_samples", 1, 10000,
                "Renderings that it is the average of, at most: as many as keep points from moving by more "
                "than a pixel from one to the next.")
              .otherwise("128"),
          number("right_delay_s", {-10.0, 10.0}, "How much later the right camera looks, in seconds.")
              .otherwise("0"),
          number("readout_s", {-1.0, 1.0},
                 "Time from the first row's look to the last one's, in seconds: a rolling shutter.")
              .otherwise("0"),
          number("drop_probability", {0.0, 1.0}, "Probability that a frame is lost.").otherwise("0"),
          number("late_probability", {0.0, 1.0},
                 "Probability that both cameras look later than the frame says.")
              .otherwise("0"),
          number("late_s", {-10.0, 10.0}, "How late they look then, in seconds.").otherwise("0"),
      }};
  return keys;
}

Shutter read_shutter(const YamlValue& value) {
  const YamlMap map(value, shutter_keys());
  Shutter shutter;
  shutter.open_s = map.number("open_s", shutter.open_s);
  shutter.samples = map.whole("samples", shutter.samples);
  shutter.most_samples = map.whole("most_samples", shutter.most_samples);
  shutter.right_delay_s = map.number("right_delay_s", shutter.right_delay_s);
  shutter.readout_s = map.number("readout_s", shutter.readout_s);
  shutter.drop_probability = map.number("drop_probability", shutter.drop_probability);
  shutter.late_probability = map.number("late_probability", shutter.late_probability);
  shutter.late_s = map.number("late_s", shutter.late_s);
  return shutter;
}

}  // namespace stereobench::worlds
