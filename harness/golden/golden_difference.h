/// What changed from one golden frame to another, told by what truth says is there.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "harness/golden/golden_frame.h"
#include "harness/golden/golden_limits.h"

namespace stereobench::harness {

/// What is at a pixel. Of two pictures that say different things the first of these is taken.
enum class PixelPlace {
  kBallEdge,  ///< within 1.5 px of where a ball begins or ends
  kBall,      ///< inside a ball
  kMesh,
  kWall,
  kFloor,
  kBackground,  ///< nothing is there
};
inline constexpr std::size_t kPixelPlaces = 6;

/// "on balls' edges", "inside balls", "on meshes" ...
const char* text_of(PixelPlace place);

/// By how much a ball moved in a picture.
struct BallShift {
  int ball = 0;                                        ///< index into World::balls
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  ///< of the golden picture
};

/// What changed in one camera's picture.
struct PictureDifference {
  bool has_seen_the_same = true;  ///< what the detector is shown is equal, in full size and with noise
  long pixels = 0;                ///< of the golden picture
  std::array<long, kPixelPlaces> changed{};  ///< pixels of other colours, by PixelPlace
  long beyond = 0;                           ///< pixels of which a channel differs by more than the limit
  int most_levels = 0;                       ///< the largest difference of a channel
  long identities = 0;                       ///< pixels that show something else
  std::vector<BallShift> shifts;             ///< of balls that moved (ball_shift.h), the largest first

  long all_changed() const;
};

/// What changed in both, and whether it is within limits.
struct GoldenDifference {
  FrameName name;
  PictureDifference left, right;
  bool passes = true;

  bool is_none() const;
};

/// Compares two golden frames. They pass where all is equal, what the detector is shown included. Else,
/// unless the limits are exact, they pass where each pixel shows the same and, in each picture, no more than
/// a share of the pixels differs by more than so many levels; limits are inclusive.
///
/// Shifts are those of colours: identities know whole pixels alone, so that the centre of a ball of 5 px is
/// known to a tenth of a pixel. Where identities say that a ball moved by a pixel or more, they are taken.
/// Colours err by 0.03 px, and by 0.06 px where a ball touches a thing thinner than a pixel, which comes and
/// goes.
/// @throws std::runtime_error, one line, where frames have other sizes
GoldenDifference compare_golden(const GoldenFrame& before, const GoldenFrame& after,
                                const GoldenLimits& limits);

/// Where pixels of two pictures are, of the picture's size. @return CV_8UC1, values of PixelPlace
cv::Mat places_of(const cv::Mat& shown_before, const cv::Mat& shown_after, int first_mesh);

/// A line for each camera in whose picture something changed, for people.
std::string difference_text(const GoldenDifference& difference);

/// The same for programs.
nlohmann::ordered_json difference_json(const GoldenDifference& difference);

}  // namespace stereobench::harness
