/// Each ball in a camera's picture, exactly: its outline, and how much of it is seen.
#pragma once

#include <array>
#include <vector>

#include "renderer/camera/camera_view.h"
#include "vision/stereo/sphere.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// The pixels of one identity.
struct PixelSet {
  long count = 0;
  cv::Rect box;  ///< the least that holds them all; empty when there are none
};

/// The pixels of each identity of a picture. @param ball_id CV_8UC1
std::array<PixelSet, 256> pixels_by_id(const cv::Mat& ball_id);

/// The pixels whose centres lie within an outline, also those outside of the picture.
PixelSet pixels_within(const vision::OutlineEllipse& outline);

/// The same pixels as a picture: CV_8UC1, 255 within the outline.
cv::Mat mask_within(const vision::OutlineEllipse& outline, const cv::Size& size);

/// A ball as a camera sees it. The names of counts and boxes are those of BOP, the benchmark for 6D object
/// poses.
struct BallTruth {
  int ball = 0;  ///< index into World::balls
  Eigen::Vector3d centre_in_camera_m = Eigen::Vector3d::Zero();
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< its centre projected: not the ellipse's centre
  vision::OutlineEllipse outline;                       ///< with nothing in its way
  long px_count_all = 0;                                ///< of the whole outline, also outside of the picture
  long px_count_visib = 0;                              ///< that see the ball
  double visib_fract = 0.0;                             ///< px_count_visib / px_count_all; 0 where that is 0
  cv::Rect bbox_obj;                                    ///< of the whole outline's pixels
  cv::Rect bbox_visib;                                  ///< of those that see the ball; empty when none does
  bool truncated = false;                               ///< the outline reaches out of the picture
};

/// Those of some balls whose outlines meet a picture, with their pixels counted and boxed there.
/// @param truths of which all but counts, boxes and `truncated` are known
/// @param camera, ball_id of the picture; ball_id is CV_8UC1
std::vector<BallTruth> counted(std::vector<BallTruth> truths, const vision::Intrinsics& camera,
                               const cv::Mat& ball_id);

/// The balls whose outlines meet a camera's picture, hidden ones included, in order of the balls.
/// @param ball_id CV_8UC1, as rendered from there
std::vector<BallTruth> ball_truths(const worlds::World& world, const CameraView& view,
                                   const cv::Mat& ball_id);

}  // namespace stereobench::renderer
