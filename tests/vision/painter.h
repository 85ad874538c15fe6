/// An independent picture of balls for the vision tests: rays against spheres, many a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "vision/types.h"

namespace stereobench::vision::painter {

struct PaintedBall {
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();  ///< in the left camera, metres
  int colour = 0;
  double radius_m = 0.05;
};

/// An upright grey rectangle that faces the camera and hides what is behind it.
struct Panel {
  double depth_m = 1.0;
  double min_x_m = 0.0;  ///< in the left camera
  double max_x_m = 0.0;
  double min_y_m = 0.0;
  double max_y_m = 0.0;
  Eigen::Vector3d bgr = {150.0, 155.0, 160.0};
};

enum class Backdrop { kPlain, kTextured };

struct Scene {
  std::vector<PaintedBall> balls;
  std::vector<Panel> panels;
  Backdrop backdrop = Backdrop::kTextured;
  Eigen::Vector3d plain_bgr = {150.0, 155.0, 160.0};
  Eigen::Vector3d towards_light_source = {-0.2, -0.9, -0.3};  ///< any length but zero
  double sheen =
      1.0;  ///< power of the light source's cosine on the balls: 1 is matt, more is satin, less is dusty
  double blur_px = 0.0;  ///< standard deviation of the Gaussian that the lens makes of a point
  double noise_sd_levels = 0.0;
  std::uint64_t seed = 0;
};

/// The usual rig with smaller pictures.
StereoRig rig_with_pictures_of(int width_px, int height_px);

StereoPair paint(const Scene& scene, const StereoRig& rig);

/// How much of a ball's outline a camera sees, in [0, 1], the smaller of both cameras; what is beyond the
/// border is not seen.
double visible_share(const Scene& scene, const StereoRig& rig, std::size_t ball);

/// How much of a ball's outline, in degrees around its centre, stands before the backdrop in a camera, the
/// smaller of both cameras.
double visible_arc_deg(const Scene& scene, const StereoRig& rig, std::size_t ball);

/// Balls of 18 colours at random places within view, at random depths; outlines neither touch each other nor
/// the border in either camera when `apart`.
std::vector<PaintedBall> scattered_balls(const StereoRig& rig, double min_depth_m, double max_depth_m,
                                         std::uint64_t seed, bool apart = true);

/// Uniform and normal numbers for tests, the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ULL + 0x1234567ULL) {}
  double uniform(double from = 0.0, double to = 1.0);
  double normal();

 private:
  std::uint64_t next();
  std::uint64_t state_;
};

}  // namespace stereobench::vision::painter
