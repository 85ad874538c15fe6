/// One point that two places of a data set speak of: where cameras, poses and depths put it in a picture, and
/// where that picture, or a file, says that it is. All geometric checks are residuals of links.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// What is held against what.
enum class LinkKind {
  kDisparityDepth,  ///< disparity against depth, cameras and baseline
  kRightDepth,      ///< the right camera's disparity against its depth
  kFlow,            ///< flow against depth (or disparity), cameras and poses
  kNextDisparity,   ///< the disparity of the next frame against depth, cameras and poses
  kBallCentre,      ///< centres of balls, or points, in pictures against world, poses and cameras
  kBallPlace,       ///< where two cameras, or frames, say that an object is, against poses
  kBallSurface,     ///< depth of pixels that see a ball against world, poses and cameras
  kStereoPictures,  ///< corners of the left picture found in the right one, against depth or disparity
  kEpipolar,        ///< the same without depth: their row, and that they lie before the cameras
  kNextPictures,    ///< corners found in the next frame's picture, against depth, cameras and poses
};
inline constexpr std::size_t kLinkKinds = 10;

/// "disparity against depth and baseline", as messages say it.
std::string_view name_of(LinkKind kind);

/// Whether one end of the link was measured in pictures: its errors are random, and some are gross.
bool is_measured(LinkKind kind);

/// Which frame's file of depth a point is taken from; others than its own are tried where frames may be late.
enum Instant : std::size_t { kNow = 0, kBefore = 1, kAfter = 2 };

struct Link {
  LinkKind kind = LinkKind::kFlow;
  std::size_t from = 0, to = 0;  ///< frames
  vision::Side from_side = vision::Side::kLeft, to_side = vision::Side::kLeft;
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero();
  /// Where the point is: one of the three. Depth, and the place in the other camera's picture, by Instant.
  std::array<std::optional<double>, 3> depth_m;
  std::array<std::optional<Eigen::Vector2d>, 3> mate_px;
  bool mate_is_measured = false;  ///< in pictures, not read from a file of disparities
  std::optional<int> ball;
  /// Where the file says that the ball is, in the frames of the cameras that the link is from and leads to.
  std::optional<Eigen::Vector3d> from_m, to_m;
  /// Of corners in both pictures: the same two values for the place that was found in the right picture.
  std::optional<double> found_depth_m;
  std::optional<Eigen::Vector2d> found_mate_px;
  /// Where it was found; of those that say less than a place, only what is compared.
  Eigen::Vector2d to_px = Eigen::Vector2d::Zero();
  double tolerance_px = 0.0;  ///< exact ends: the greatest error that rounding makes; measured: an usual one
};

/// All that a data set claims of its geometry; what Hypothesis changes.
struct Claims {
  struct Frame {
    std::array<ViewCamera, 2> cameras;
    std::array<std::optional<Eigen::Isometry3d>, 2> world_from_body;
  };
  std::vector<Frame> frames;
  const std::vector<ViewBall>* balls = nullptr;
  bool poses_are_of_each_camera = false;
  double depth_scale = 1.0;
  double disparity_shift_px = 0.0;
  bool depth_is_along_ray = false;
  std::size_t depth_instant = kNow;  ///< from which frame's file depth and disparity are taken
  int picture_shift = 0;             ///< pictures are those of the frame so much later than their name says
  bool pictures_are_swapped = false;
};

Claims claims_of(const DatasetView& view);

/// What a link is worth whose point is behind a camera, or farther off than this.
inline constexpr double kMostResidual_px = 20.0;

/// The vector from where a link's point should be to where it is; in px, and at most kMostResidual_px long.
/// Ends that say one number have one residual, in its first place.
/// @return empty where the claims say nothing of the link: there is no such frame, pose or file
std::optional<Eigen::Vector2d> residual_px(const Claims& claims, const Link& link);

}  // namespace stereobench::harness
