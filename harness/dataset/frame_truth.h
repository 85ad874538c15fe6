/// Truth of a drive's pictures beyond identity and depth.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "harness/drive/recording.h"
#include "harness/drive/shutter.h"
#include "renderer/renderer.h"
#include "renderer/truth/ball_truth.h"
#include "renderer/truth/correspondence.h"
#include "renderer/truth/pixel_truth.h"
#include "renderer/truth/scene_geometry.h"

namespace stereobench::harness {

/// The truth of one stereo pair after the other. Each value is worked out when it is first asked for, and
/// kept while one camera is asked about: ask for all of one camera's, then for the other's.
/// Which truth a scenario has is what require_truth (truth_limits.h) says.
class FrameTruth {
 public:
  /// @param scenario, world as they are rendered; they outlive this
  /// @param read meshes, when truth is first asked for
  FrameTruth(const worlds::Scenario& scenario, const worlds::World& world, renderer::FormReader read);

  /// Takes up a pair. Pairs come in the order of their steps, each with its renderer.
  /// @param event outlives what is asked of it
  /// @throws std::runtime_error from here on when a mesh cannot be read
  void look_at(const FrameEvent& event);

  /// Surface, range and normal of each pixel.
  const renderer::PixelTruth& pixels(vision::Side side);

  /// The balls whose outlines meet the picture.
  std::vector<renderer::BallTruth> balls(vision::Side side);

  /// Where each pixel's point is in the other camera's picture.
  const renderer::Correspondence& to_other_camera(vision::Side side);

  /// Where each pixel's point is in the next step's picture of the same camera. The last step has none.
  const renderer::Correspondence& to_next_step(vision::Side side);

 private:
  using StereoIdBuffers = renderer::StereoIdBuffers;
  /// What is known of one camera's picture.
  struct Known {
    vision::Side side;
    std::optional<renderer::PixelTruth> pixels;
    std::optional<renderer::Correspondence> to_other_camera, to_next_step;
  };
  Known& known_of(vision::Side side);
  const renderer::SceneGeometry& scene();
  StereoIdBuffers id_buffers_of(const RowBand& band, std::size_t step, double late_s);
  const std::vector<StereoIdBuffers>& id_buffers_at(std::size_t step, double late_s);
  const std::vector<StereoIdBuffers>& id_buffers() { return id_buffers_at(event_->step, event_->late_s); }

  const worlds::Scenario& scenario_;
  const worlds::World& world_;
  renderer::FormReader read_;
  std::optional<renderer::SceneGeometry> scene_;
  const FrameEvent* event_ = nullptr;
  std::optional<Known> known_;
  std::map<std::size_t, std::vector<StereoIdBuffers>> buffers_;  ///< of this step and the next, by bands
};

}  // namespace stereobench::harness
