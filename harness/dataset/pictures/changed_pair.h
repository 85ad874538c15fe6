/// A stereo pair whose pictures are cut, scaled or of another kind, with the truth that then holds.
#pragma once

#include <array>
#include <optional>

#include "harness/dataset/dataset_pair.h"
#include "harness/dataset/pictures/picture_change.h"
#include "harness/dataset/pictures/scaled_truth.h"

namespace stereobench::harness {

/// What a format writes then is what it would write of a camera that has these pictures.
class ChangedPair final : public DatasetPair {
 public:
  /// @param whole as the camera took it
  /// @param drive as `changed` gives it @param change that it was changed by; all of them outlive the pair
  ChangedPair(DatasetPair& whole, const DatasetDrive& drive, const PictureChange& change)
      : whole_(whole), drive_(drive), change_(change) {}

  std::size_t step() const override { return whole_.step(); }
  std::optional<std::filesystem::path> file_of(vision::Side side) const override;
  cv::Mat picture(vision::Side side) override;
  cv::Mat ball_id(vision::Side side) override;
  cv::Mat depth_m(vision::Side side) override;
  const renderer::PixelTruth& pixels(vision::Side side) override;
  std::vector<renderer::BallTruth> balls(vision::Side side) override;
  const renderer::Correspondence& to_other_camera(vision::Side side) override;
  const renderer::Correspondence& to_next_step(vision::Side side) override;

 private:
  /// What is known of one camera's picture.
  struct Known {
    std::optional<ScaledTruth> scaled;
    std::optional<renderer::PixelTruth> pixels;
    std::optional<renderer::Correspondence> to_other_camera, to_next_step;
  };
  Known& known_of(vision::Side side) { return known_[static_cast<std::size_t>(side)]; }
  cv::Mat cut(const cv::Mat& picture) const;
  renderer::PixelTruth cut(const renderer::PixelTruth& pixels) const;
  renderer::Correspondence cut(const renderer::Correspondence& found) const;
  const ScaledTruth& scaled(vision::Side side);
  ScaledLook look(vision::Side side) const;
  renderer::CameraView view_at(const Eigen::Isometry3d& world_from_camera) const;

  DatasetPair& whole_;
  const DatasetDrive& drive_;
  const PictureChange& change_;
  std::array<Known, 2> known_;  ///< by Side
};

}  // namespace stereobench::harness
