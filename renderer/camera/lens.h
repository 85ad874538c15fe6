/// Pictures through lenses that distort.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "renderer/camera/picture_pool.h"
#include "renderer/camera/remap.h"
#include "renderer/types.h"
#include "vision/types.h"

namespace stereobench::renderer {

/// The pinhole rig that sees all that a rig's lenses see (pinhole_rig.h).
/// @throws std::invalid_argument when the lens folds its picture, or sees more than a pinhole can draw
vision::StereoRig pinhole_rig_of(const vision::StereoRig& rig);

/// Distorts pinhole pictures as a rig's lenses do. Rasterisers draw straight lines: what the lens sees is
/// drawn by a pinhole camera of more pixels, and its light gathered for each pixel of the distorted picture
/// around the place that its centre sees. Truth is that of the pinhole's pixel nearest to that place, half a
/// pixel off each way at most unless the lens more than doubles what it shows.
class Lens {
 public:
  /// @throws std::invalid_argument when the lens folds its picture, or sees more than a pinhole can draw
  explicit Lens(const vision::StereoRig& rig);

  /// The rig without distortion whose pictures distort() takes.
  const vision::StereoRig& pinhole_rig() const { return pinhole_; }

  int height_px() const { return static_cast<int>(rows_seen_.size()); }

  /// The rows of the pinhole's picture that some rows of the distorted one are made of.
  cv::Range rows_seen(const cv::Range& rows) const;

  /// @param undistorted of the pinhole rig, from a row of its picture on
  /// @param rows of the distorted picture, all of whose rows_seen() are there
  /// @param pool that the distorted pictures' memory is of
  RenderedImage distort(const RenderedImage& undistorted, int first_row, const cv::Range& rows,
                        PicturePool& pool) const;

 private:
  vision::StereoRig pinhole_;
  int width_px_;
  std::vector<PinholePlace> places_;  ///< that each pixel's centre sees, row by row
  std::vector<cv::Range> rows_seen_;  ///< by each row
};

}  // namespace stereobench::renderer
