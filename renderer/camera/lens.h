/// Pictures through lenses that distort.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "renderer/camera/picture_pool.h"
#include "renderer/types.h"
#include "vision/types.h"

namespace stereobench::renderer {

/// The rig without distortion, with twice as many pixels each way, that sees all that a rig's lenses see.
/// @throws std::invalid_argument when the lens folds its picture, or sees more than a pinhole can draw
vision::StereoRig pinhole_rig_of(const vision::StereoRig& rig);

/// Distorts pinhole pictures as a rig's lenses do. Rasterisers draw straight lines: what the lens sees is
/// drawn by a pinhole camera with twice as many pixels each way, and its light gathered per pixel of the
/// distorted picture at four places. Truth is that of the pinhole's pixel nearest to where the distorted
/// pixel's centre looks, a third of a pixel off at most.
class Lens {
 public:
  /// @throws std::invalid_argument when the lens folds its picture, or sees more than a pinhole can draw
  explicit Lens(const vision::StereoRig& rig);

  /// The rig without distortion whose pictures distort() takes.
  const vision::StereoRig& pinhole_rig() const { return pinhole_; }

  int height_px() const { return truth_places_.rows; }

  /// The rows of the pinhole's picture that some rows of the distorted one are made of.
  cv::Range rows_seen(const cv::Range& rows) const;

  /// @param undistorted of the pinhole rig, from a row of its picture on
  /// @param rows of the distorted picture, all of whose rows_seen() are there
  /// @param pool that the distorted pictures' memory is of
  RenderedImage distort(const RenderedImage& undistorted, int first_row, const cv::Range& rows,
                        PicturePool& pool) const;

 private:
  vision::StereoRig pinhole_;
  cv::Mat light_places_, light_fractions_;  ///< OpenCV's fixed-point maps, at twice the resolution
  cv::Mat truth_places_;                    ///< CV_16SC2, the pixel that each pixel's centre sees
  std::vector<cv::Range> rows_seen_;        ///< by each row
};

}  // namespace stereobench::renderer
