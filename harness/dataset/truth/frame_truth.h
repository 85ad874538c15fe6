/// A drive's stereo pairs with their truth, as they are rendered.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "harness/dataset/dataset_pair.h"
#include "harness/drive/recording.h"
#include "harness/drive/shutter.h"
#include "renderer/renderer.h"
#include "renderer/truth/scene_geometry.h"

namespace stereobench::harness {

/// One stereo pair after the other. Which truth a scenario has is what require_truth (truth_limits.h) says.
class FrameTruth final : public DatasetPair {
 public:
  /// @param scenario, world as they are rendered; they outlive this
  /// @param read meshes, when truth is first asked for
  /// @param linear16_seed pictures are linear, of 16 bits (PictureKind::kLinear16), with the noise of this
  /// seed
  FrameTruth(const worlds::Scenario& scenario, const worlds::World& world, renderer::FormReader read,
             std::optional<std::uint64_t> linear16_seed = {});

  /// Takes up a pair. Pairs come in the order of their steps, each with its renderer.
  /// @param event outlives what is asked of it
  /// @throws std::runtime_error from here on when a mesh cannot be read
  void look_at(const FrameEvent& event);

  std::size_t step() const override { return event_->step; }
  cv::Mat picture(vision::Side side) override;
  cv::Mat ball_id(vision::Side side) override { return image(side).ball_id; }
  cv::Mat depth_m(vision::Side side) override { return image(side).depth_m; }
  const renderer::PixelTruth& pixels(vision::Side side) override;
  std::vector<renderer::BallTruth> balls(vision::Side side) override;
  const renderer::Correspondence& to_other_camera(vision::Side side) override;
  const renderer::Correspondence& to_next_step(vision::Side side) override;

 private:
  using StereoIdBuffers = renderer::StereoIdBuffers;
  /// What is known of one camera's picture.
  struct Known {
    std::optional<renderer::PixelTruth> pixels;
    std::optional<renderer::Correspondence> to_other_camera, to_next_step;
  };
  const renderer::RenderedImage& image(vision::Side side) const;
  Known& known_of(vision::Side side);
  const renderer::SceneGeometry& scene();
  StereoIdBuffers id_buffers_of(const RowBand& band, std::size_t step, double late_s);
  const std::vector<StereoIdBuffers>& id_buffers_at(std::size_t step, double late_s);
  const std::vector<StereoIdBuffers>& id_buffers() { return id_buffers_at(event_->step, event_->late_s); }

  const worlds::Scenario& scenario_;
  const worlds::World& world_;
  renderer::FormReader read_;
  std::optional<std::uint64_t> linear16_seed_;
  std::optional<renderer::SceneGeometry> scene_;
  const FrameEvent* event_ = nullptr;
  std::array<Known, 2> known_;                                   ///< by Side
  std::map<std::size_t, std::vector<StereoIdBuffers>> buffers_;  ///< of this step and the next, by bands
};

}  // namespace stereobench::harness
