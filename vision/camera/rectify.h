/// Pictures as a rig without faults would have taken them: what vision measures in.
#pragma once

#include <array>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "vision/camera/camera_pair.h"
#include "vision/types.h"

namespace stereobench::vision {

/// Undoes what is believed of a rig: the lenses' distortion, and the cameras' turns.
///
/// A turn about the camera's own centre moves pixels in a way that does not depend on what they see, so that
/// each camera is one remapping, by cubic interpolation, onto a picture that is large enough for all that
/// either camera has seen (within twice the size); it is black elsewhere. A rig that has no such faults costs
/// nothing.
class Rectification {
 public:
  /// @param rig as it is believed to be
  /// @throws std::invalid_argument when it cannot be computed with
  explicit Rectification(const StereoRig& rig);

  /// Of a rig of two different cameras.
  /// @param rig where the cameras are, without faults, and the camera that rectified pictures are to be of
  /// @throws std::invalid_argument when it cannot be computed with, or when sizes differ
  Rectification(const StereoRig& rig, const CameraPair& cameras);

  /// The rig that the rectified pictures are of.
  const StereoRig& rig() const { return rectified_; }

  /// Whether there is nothing to undo.
  bool is_nothing() const { return maps_[1].places.empty(); }

  /// @param pair CV_8UC3 of the rig's size
  /// @throws std::invalid_argument when a picture is not
  StereoPair apply(const StereoPair& pair) const;

  /// Where a pixel of a rectified picture is in the picture as it was taken.
  /// @return for what the camera has not seen a place outside of that picture: straight on from its border,
  ///   since lenses may fold there
  Eigen::Vector2d taken_px(const Eigen::Vector2d& rectified_px, Side side) const;

  /// Whether the camera has seen all within a circle of a rectified picture.
  bool shows(const Eigen::Vector2d& centre_px, double radius_px, Side side) const;

 private:
  cv::Mat rectified_picture(const cv::Mat& taken, Side side) const;
  /// Where a pixel of a rectified picture looks, in the camera's own frame at a depth of 1.
  Eigen::Vector2d direction_of(const Eigen::Vector2d& rectified_px, Side side) const;
  /// taken_px, or nowhere near the picture for what the camera has not seen.
  Eigen::Vector2d pixel_for(const Eigen::Vector2d& rectified_px, Side side) const;

  CameraPair cameras_;
  StereoRig rectified_;
  std::array<Eigen::AlignedBox2d, 2> seen_;  ///< directions in each camera's own frame
  struct Maps {
    cv::Mat places, fractions;  ///< OpenCV's fixed-point maps; empty where nothing moves
  };
  std::array<Maps, 2> maps_;
};

}  // namespace stereobench::vision
