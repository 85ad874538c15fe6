/// Pictures of balls as photographs have them: what vision is held against, and learns nothing from.
///
/// Balls lie on a ground of grass, wood, gravel or cloth before a background with things in it, under a sun
/// and a sky. They have seams, prints, felt or sheen, stand in their own shadow, take the ground's colour
/// from below, and grass grows before them. A camera moves, is a little out of focus, makes noise, stores
/// sRGB levels, and compresses them as a JPEG with halved colours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace stereobench::photograph {

/// What a surface gives back of red, green and blue light, in [0, 1].
using Light = Eigen::Array3d;

/// The colours that balls have.
inline constexpr std::array<const char*, 5> kNames = {"red", "orange", "yellow", "blue", "magenta"};

/// A thing of a ball's surface that is not of its colour.
enum class Dress { kPlain, kSeams, kCurvedSeam, kPrint, kFelt };
enum class Ground { kGrass, kWood, kGravel, kCloth };

/// A ball as the picture has it.
struct Ball {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double radius_px = 0.0;
  int colour = 0;        ///< into kNames
  double visible = 0.0;  ///< share of its outline's area that the picture shows
  Dress dress = Dress::kPlain;
  Light paint = Light::Zero();
  Light second = Light::Zero();  ///< of seams and prints
  double sheen = 0.0;            ///< of highlights, against white
  double sharpness = 20.0;       ///< of highlights: Blinn's exponent
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

/// A flat thing of one colour that stands in the picture: behind all balls, or before them.
struct Clutter {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_px = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;
  bool is_leaf = false;  ///< or else a box
  Light paint = Light::Zero();
};

/// All that is in a picture.
struct Scene {
  std::uint64_t seed = 0;
  int width_px = 640;
  int height_px = 480;
  double horizon_px = 0.0;
  double ball_radius = 0.15;  ///< of the camera's height
  Ground ground = Ground::kGrass;
  Light ground_paint = Light::Zero(), wall_paint = Light::Zero();
  Light sky = Light::Zero(), sun = Light::Zero();
  Eigen::Vector3d to_sun = Eigen::Vector3d::UnitY();  ///< x right, y up, z to the camera
  std::vector<Ball> balls;                            ///< the farthest first
  std::vector<Clutter> behind, before;
};

/// How a picture is taken and kept.
struct Camera {
  double exposure = 1.0;
  double defocus_sd_px = 0.5;
  Eigen::Vector2d motion_px = Eigen::Vector2d::Zero();  ///< of all while the shutter is open
  double noise_sd_levels = 1.5;                         ///< of linear light, at grey
  Eigen::Vector3d balance_bgr = Eigen::Vector3d::Ones();
  int jpeg_quality = 90;
};

struct Photograph {
  cv::Mat levels;  ///< CV_8UC3, BGR, sRGB
  std::vector<Ball> balls;
};

/// Draws a scene's parts and a camera. @param seed 0 is one as well
Scene scene_of(std::uint64_t seed);
Camera camera_of(std::uint64_t seed);

/// The light that a scene sends into each pixel. @param balls whose `visible` is set
/// @return CV_32FC3, BGR, white is 1
cv::Mat paint(const Scene& scene, std::vector<Ball>& balls);

/// @param light as paint returns it @return CV_8UC3, BGR, sRGB
cv::Mat expose(const cv::Mat& light, const Camera& camera, std::uint64_t seed);

Photograph take(std::uint64_t seed);

}  // namespace stereobench::photograph
