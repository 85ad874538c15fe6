/// Colours as a camera really shows them: learned from samples, where kPalette is given.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/colour/colour_table.h"

namespace stereobench::vision {

/// What the levels of pictures are. Colours are learned and found in levels as they are stored: of sRGB,
/// 8 bits of light would be too few for all that is dark.
enum class Levels {
  kLinear,  ///< of light
  kSrgb     ///< of its root: a level is (light^(1 / 2.4) less a constant), so level + 14 is a power of light
};

/// A colour that was learned: where its pixels lie in rg chromaticity, (r, g) / (r + g + b), of light or of
/// its power, which shading leaves alone, and how dark they get.
struct LearnedColour {
  std::string name;
  Eigen::Vector2d chromaticity = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double darkest_level = 0.0;                     ///< of the brightest channel, 0 to 255
  Eigen::Vector3d bgr = Eigen::Vector3d::Zero();  ///< typical, for pictures
};

/// Learns one colour from pixels of samples. Highlights, whose chromaticity is the light's, and what else is
/// not of the colour, are passed over: mean and covariance are those of the half of the pixels that lies
/// closest together (minimum covariance determinant), and then of all that are within the gate of it.
/// @param bgr levels of 255 as they are stored; at least 20
/// @throws std::invalid_argument for fewer, or where half of them have no colour (grey, white or black)
LearnedColour learn_colour(const std::string& name, std::span<const Eigen::Vector3d> bgr,
                           Levels levels = Levels::kLinear);

/// How far a chromaticity is from a colour, in standard deviations.
double deviations_from(const LearnedColour& colour, const Eigen::Vector2d& chromaticity);

/// How far two colours are apart: the distance, in standard deviations of each, at which they meet half way.
double separation(const LearnedColour& a, const LearnedColour& b);

/// Which pixels have which colour: the likeliest, if it is within the gate, bright enough for the colour, and
/// at least half as far from grey as the colour itself.
/// @param colours at most 255
/// @param levels of the pictures, as of those that the colours were learned from
ColourTable table_of(std::span<const LearnedColour> colours, Levels levels = Levels::kLinear);

}  // namespace stereobench::vision
