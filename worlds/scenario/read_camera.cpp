#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kGain = {1e-3, 1e3};

void check_camera(const YamlMap& map, CameraSensor& sensor) {
  if (const auto read_noise = map.find("read_noise_electrons");
      read_noise && sensor.read_noise_electrons > 0.0 && sensor.full_well_electrons == 0.0)
    read_noise->refuse("electrons are counted with full_well_electrons");
  if (const auto gamma = map.find("gamma"); gamma && sensor.encoding != Encoding::kGamma)
    gamma->refuse("a gamma needs `encoding: gamma`");
}

}  // namespace

const Fields<CameraSensor>& camera_keys() {
  static const Fields<CameraSensor> keys(
      {
          number("noise_sd_levels", {0.0, 255.0},
                 "Standard deviation of Gaussian noise per pixel and channel, in levels of 255, before "
                 "encoding.")
              .fills(&CameraSensor::noise_sd_levels),
          number("defocus_sd_px", {0.0, 100.0},
                 "Standard deviation of the Gaussian that the lens makes of a point, in pixels.")
              .fills(&CameraSensor::defocus_sd_px),
          number("vignette", {0.0, 1.0}, "Share of the light that is lost in the corners.")
              .fills(&CameraSensor::vignette),
          number("exposure", kGain, "Light that is gathered; at 1, white fills the well.")
              .fills(&CameraSensor::exposure),
          number("full_well_electrons", {0.0, 1e6},
                 "Electrons of a white pixel, whose counts are Poisson's; 0 leaves out shot noise.")
              .fills(&CameraSensor::full_well_electrons),
          number(
              "read_noise_electrons", {0.0, 1e6},
              "Standard deviation of the noise of reading a pixel, in electrons; needs full_well_electrons.")
              .fills(&CameraSensor::read_noise_electrons),
          number("gain", kGain, "Levels per electron; at 1, a full well is level 255.")
              .fills(&CameraSensor::gain),
          number("white_balance_rgb", kGain, "Further gains of red, green and blue.")
              .fills(&CameraSensor::white_balance_rgb),
          choice("encoding", {"linear", "srgb", "gamma"}, "How a level stands for light.")
              .fills(&CameraSensor::encoding),
          number("gamma", {0.1, 10.0}, "Exponent of `encoding: gamma`: level = light^(1 / gamma).")
              .fills(&CameraSensor::gamma),
      },
      check_camera);
  return keys;
}

const Fields<Shutter>& shutter_keys() {
  static const Fields<Shutter> keys({
      number("open_s", {0.0, 10.0},
             "How long the shutter is open around a frame's time, in seconds: what moves is blurred.")
          .fills(&Shutter::open_s),
      whole("samples", 1, 1000, "Renderings that the blur is the average of, at least.")
          .fills(&Shutter::samples),
      whole("most_samples", 1, 10000,
            "Renderings that it is the average of, at most: as many as keep points from moving by more "
            "than a pixel from one to the next.")
          .fills(&Shutter::most_samples),
      number("right_delay_s", {-10.0, 10.0}, "How much later the right camera looks, in seconds.")
          .fills(&Shutter::right_delay_s),
      number("readout_s", {-1.0, 1.0},
             "Time from the first row's look to the last one's, in seconds: a rolling shutter.")
          .fills(&Shutter::readout_s),
      number("drop_probability", {0.0, 1.0}, "Probability that a frame is lost.")
          .fills(&Shutter::drop_probability),
      number("late_probability", {0.0, 1.0}, "Probability that both cameras look later than the frame says.")
          .fills(&Shutter::late_probability),
      number("late_s", {-10.0, 10.0}, "How late they look then, in seconds.").fills(&Shutter::late_s),
  });
  return keys;
}

}  // namespace stereobench::worlds
