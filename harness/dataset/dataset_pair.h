/// A stereo pair of a data set with all that is known of it, rendered just now or read from a folder.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "renderer/truth/ball_truth.h"
#include "renderer/truth/correspondence.h"
#include "renderer/truth/pixel_truth.h"
#include "vision/types.h"

namespace stereobench::harness {

inline constexpr std::array kBothSides = {vision::Side::kLeft, vision::Side::kRight};

/// Each value is worked out, or read, when it is asked for. References stay as they are until the next pair.
class DatasetPair {
 public:
  virtual ~DatasetPair() = default;

  /// The step of the drive that it is of.
  virtual std::size_t step() const = 0;

  /// The file that has the picture already, where there is one: a PNG that need not be made again.
  virtual std::optional<std::filesystem::path> file_of(vision::Side) const { return {}; }

  /// What the camera stored: CV_8UC3, BGR.
  virtual cv::Mat picture(vision::Side side) = 0;

  /// Which ball each pixel shows: CV_8UC1, 0 = none, k = ball k - 1.
  virtual cv::Mat ball_id(vision::Side side) = 0;

  /// Planar Z of each pixel, m: CV_32FC1, +inf = nothing.
  virtual cv::Mat depth_m(vision::Side side) = 0;

  /// Surface, range and normal of each pixel.
  virtual const renderer::PixelTruth& pixels(vision::Side side) = 0;

  /// The balls whose outlines meet the picture.
  virtual std::vector<renderer::BallTruth> balls(vision::Side side) = 0;

  /// Where each pixel's point is in the other camera's picture.
  virtual const renderer::Correspondence& to_other_camera(vision::Side side) = 0;

  /// Where each pixel's point is in the next step's picture of the same camera. The last step has none.
  virtual const renderer::Correspondence& to_next_step(vision::Side side) = 0;
};

}  // namespace stereobench::harness
