#include "harness/dataset/truth/frame_truth.h"

#include <utility>

#include "renderer/camera/sensor_model.h"
#include "renderer/truth/distorted_ids.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

using renderer::Correspondence;
using renderer::IdBuffer;
using renderer::PixelTruth;
using vision::Side;

const IdBuffer& side_of(const renderer::StereoIdBuffers& ids, Side side) {
  return side == Side::kLeft ? ids.left : ids.right;
}

Side other(Side side) {
  return side == Side::kLeft ? Side::kRight : Side::kLeft;
}

}  // namespace

FrameTruth::FrameTruth(const worlds::Scenario& scenario, const worlds::World& world,
                       renderer::FormReader read, std::optional<std::uint64_t> linear16_seed)
    : scenario_(scenario), world_(world), read_(std::move(read)), linear16_seed_(linear16_seed) {}

void FrameTruth::look_at(const FrameEvent& event) {
  buffers_.erase(buffers_.begin(), buffers_.lower_bound(event.step));
  known_ = {};
  event_ = &event;
}

cv::Mat FrameTruth::picture(Side side) {
  if (linear16_seed_)
    return renderer::develop_linear16(image(side).colour, scenario_.camera, *linear16_seed_,
                                      2 * event_->step + static_cast<std::uint64_t>(side));
  return side == Side::kLeft ? event_->pair.left : event_->pair.right;
}

const renderer::RenderedImage& FrameTruth::image(Side side) const {
  return side == Side::kLeft ? event_->frame.left : event_->frame.right;
}

FrameTruth::Known& FrameTruth::known_of(Side side) {
  return known_[static_cast<std::size_t>(side)];
}

const renderer::SceneGeometry& FrameTruth::scene() {
  if (!scene_) scene_.emplace(world_, read_);
  return *scene_;
}

renderer::StereoIdBuffers FrameTruth::id_buffers_of(const RowBand& band, std::size_t step, double late_s) {
  renderer::Renderer& renderer = *event_->renderer;
  const double offset_s = late_s + band.offset_s;
  const slam::Pose left = worlds::pose_near(scenario_.path, step, offset_s);
  const slam::Pose right =
      worlds::pose_near(scenario_.path, step, offset_s + scenario_.shutter.right_delay_s);
  if (scenario_.rig.distortion == vision::Distortion{}) return renderer.id_buffers(left, right, band.rows);
  const StereoIdBuffers undistorted = renderer.id_buffers(left, right);
  return {renderer::distorted_ids(scene(), undistorted.left, scenario_.rig),
          renderer::distorted_ids(scene(), undistorted.right, scenario_.rig)};
}

/// What the cameras look at, by bands of rows; one where all rows look at once.
const std::vector<renderer::StereoIdBuffers>& FrameTruth::id_buffers_at(std::size_t step, double late_s) {
  const auto [known, is_new] = buffers_.try_emplace(step);
  if (!is_new) return known->second;
  for (const RowBand& band : row_bands(scenario_.shutter, scenario_.rig.intrinsics.height_px))
    known->second.push_back(id_buffers_of(band, step, late_s));
  return known->second;
}

const PixelTruth& FrameTruth::pixels(Side side) {
  std::optional<PixelTruth>& known = known_of(side).pixels;
  if (known) return *known;
  known.emplace();
  for (const StereoIdBuffers& band : id_buffers()) {
    const PixelTruth rows = renderer::pixel_truth(scene(), side_of(band, side));
    known->surface.push_back(rows.surface);
    known->range_m.push_back(rows.range_m);
    known->normal.push_back(rows.normal);
  }
  return *known;
}

std::vector<renderer::BallTruth> FrameTruth::balls(Side side) {
  return renderer::ball_truths(world_, side_of(id_buffers().front(), side).view, ball_id(side));
}

const Correspondence& FrameTruth::to_other_camera(Side side) {
  std::optional<Correspondence>& known = known_of(side).to_other_camera;
  if (!known) {
    const StereoIdBuffers& ids = id_buffers().front();
    known = renderer::correspond(scene(), side_of(ids, side), side_of(ids, other(side)));
  }
  return *known;
}

const Correspondence& FrameTruth::to_next_step(Side side) {
  std::optional<Correspondence>& known = known_of(side).to_next_step;
  if (!known) {
    const StereoIdBuffers& next = id_buffers_at(event_->step + 1, 0.0).front();
    known = renderer::correspond(scene(), side_of(id_buffers().front(), side), side_of(next, side));
  }
  return *known;
}

}  // namespace stereobench::harness
