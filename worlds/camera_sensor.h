/// What a camera makes of light: the lens, the chip, and how levels are stored.
#pragma once

#include <Eigen/Core>

namespace stereobench::worlds {

/// How a level is written down.
enum class Encoding {
  kLinear,  ///< as light
  kSrgb,    ///< IEC 61966-2-1
  kGamma    ///< light^(1 / gamma)
};

/// When the cameras look. The defaults are an instant, the same for both and for all rows, and every time.
struct Shutter {
  double open_s = 0.0;            ///< how long, centred on the frame's time: what moves is blurred
  int samples = 8;                ///< instants that the blur is the average of, at least
  int most_samples = 128;         ///< and at most, where points move by more than a pixel between them
  double right_delay_s = 0.0;     ///< of the right camera's shutter behind the left one's
  double readout_s = 0.0;         ///< from the first row's look to the last one's, around the frame's time
  double drop_probability = 0.0;  ///< that a frame is lost
  double late_probability = 0.0;  ///< that both cameras look late, at a frame whose time is not told
  double late_s = 0.0;            ///< how late they are then
};

/// A camera whose defaults change nothing. Light of 255 levels is what a perfect picture calls white.
///
/// In the order in which light goes through it: the lens blurs and darkens the corners; a pixel gathers
/// electrons, whose number is Poisson's; reading it adds noise; gain and white balance make levels of it;
/// the levels are encoded, rounded and clamped (EMVA 1288 calls it the linear camera model).
struct CameraSensor {
  double noise_sd_levels =
      0.0;  ///< Gaussian, per pixel, channel and camera, in levels of 255, before encoding

  double defocus_sd_px = 0.0;  ///< of the Gaussian that a point of light becomes
  double vignette = 0.0;  ///< share of the light that is lost in the corners, as the square of the radius

  double exposure = 1.0;              ///< light gathered, 1 = white fills the well
  double full_well_electrons = 0.0;   ///< electrons of a white pixel; 0 = light has no grains
  double read_noise_electrons = 0.0;  ///< standard deviation
  double gain = 1.0;                  ///< levels per electron, 1 = a full well is level 255
  Eigen::Vector3d white_balance_rgb = Eigen::Vector3d::Ones();  ///< further gains of the channels

  Encoding encoding = Encoding::kLinear;
  double gamma = 2.2;  ///< of kGamma

  bool operator==(const CameraSensor&) const = default;
};

}  // namespace stereobench::worlds
