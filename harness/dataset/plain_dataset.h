/// A data set of the format `plain`, read back: what other formats are exported from.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "harness/dataset/dataset_drive.h"
#include "harness/dataset/dataset_pair.h"
#include "harness/types.h"

namespace stereobench::harness {

struct PlainDataset {
  std::filesystem::path folder;
  DatasetDrive drive;
  MeasurementLog log;
};

/// Reads all but the pictures.
/// @throws std::runtime_error, one line, when the folder is no finished data set of the format `plain`, or a
///   file is missing or not as `render` writes it
PlainDataset read_plain_dataset(const std::filesystem::path& folder);

/// Makes sure that a set has truth of a kind, exactly. Balls are exact with each --truth-format.
/// @throws std::runtime_error, one line that says how to render it
void require_exact_truth(const PlainDataset& dataset, TruthKind kind);

/// A stereo pair of it: pictures, identities, depth, balls, disparity and flow.
/// All but step and file_of throw std::runtime_error, one line, for what is missing, broken, or not read.
class PlainPair final : public DatasetPair {
 public:
  /// @param dataset outlives it
  PlainPair(const PlainDataset& dataset, std::size_t step) : dataset_(dataset), step_(step) {}

  std::size_t step() const override { return step_; }
  std::optional<std::filesystem::path> file_of(vision::Side side) const override;
  cv::Mat picture(vision::Side side) override;
  cv::Mat ball_id(vision::Side side) override;
  cv::Mat depth_m(vision::Side side) override;
  const renderer::PixelTruth& pixels(vision::Side side) override;
  std::vector<renderer::BallTruth> balls(vision::Side side) override;
  const renderer::Correspondence& to_other_camera(vision::Side side) override;
  const renderer::Correspondence& to_next_step(vision::Side side) override;

 private:
  std::filesystem::path file(vision::Side side, std::string_view kind, std::string_view extension) const;
  /// @throws std::runtime_error as require_exact_truth
  std::filesystem::path truth_file(vision::Side side, TruthKind kind, std::string_view extension) const;
  renderer::Correspondence with_occlusion(vision::Side side, TruthKind kind,
                                          const std::vector<cv::Mat>& shift_px) const;
  cv::Mat sized(const std::filesystem::path& file, cv::Mat picture, int type) const;

  const PlainDataset& dataset_;
  std::size_t step_;
  std::array<std::optional<renderer::Correspondence>, 2> to_other_camera_, to_next_step_;  ///< by Side
};

}  // namespace stereobench::harness
