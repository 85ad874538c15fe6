#include "harness/golden/golden_frame.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "harness/dataset/truth/frame_truth.h"
#include "harness/drive/recording.h"
#include "harness/frame_replay/frame_replay.h"
#include "harness/io/sha256.h"
#include "renderer/surfaces/primitives.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// Pictures are wanted, and nobody looks for balls in them.
std::vector<vision::BallObservation> look_for_nothing(const DetectorInput&) {
  return {};
}

/// Shows a listener the one frame.
/// @return whether there was one
bool look_at(const Experiment& experiment, const FrameName& frame, renderer::Backend backend,
             renderer::MeshCache& meshes, const std::function<void(const FrameEvent&)>& on_frame) {
  bool is_seen = false;
  Listeners listeners;
  listeners.is_wanted = [&](std::size_t step) { return step == frame.step; };
  listeners.on_frame = [&](const FrameEvent& event) {
    on_frame(event);
    is_seen = true;
  };
  record(experiment, frame.seed, listeners, backend, look_for_nothing, meshes.forms());
  return is_seen;
}

/// The same scene for a camera with fewer pixels that stores light without noise.
Experiment in_small(Experiment experiment) {
  worlds::Scenario& scenario = experiment.scenario;
  const int smaller = make_smaller(scenario.rig);
  make_smaller(scenario.believed_rig);
  scenario.camera.defocus_sd_px /= smaller;
  scenario.camera.noise_sd_levels = 0.0;
  scenario.camera.full_well_electrons = 0.0;  // no grains of light, and nothing is read with noise
  scenario.camera.read_noise_electrons = 0.0;
  return experiment;
}

cv::Mat in_16_bits(const cv::Mat& surfaces) {
  double most = 0.0;
  cv::minMaxLoc(surfaces, nullptr, &most);
  if (most > 65535.0)
    throw std::runtime_error(fmt::format("golden pictures know 65535 surfaces, and the world has {}", most));
  cv::Mat shown;
  surfaces.convertTo(shown, CV_16U);
  return shown;
}

void check(const worlds::Scenario& scenario, const FrameName& frame) {
  require_frame(scenario, frame);
  const bool has_lens = !(scenario.rig.distortion == vision::Distortion{});
  if (has_lens && scenario.shutter.readout_s != 0.0)
    throw std::runtime_error(
        fmt::format("{}: there are no golden pictures of a rolling shutter (shutter.readout_s) behind a lens "
                    "that distorts",
                    scenario.name));
}

}  // namespace

int make_smaller(vision::StereoRig& rig) {
  vision::Intrinsics& camera = rig.intrinsics;
  const int smaller = (camera.width_px + kGoldenWidth_px - 1) / kGoldenWidth_px;
  camera.width_px = camera.width_px / smaller;
  camera.height_px = std::max(1, camera.height_px / smaller);
  camera.focal_px /= smaller;
  camera.cx_px = (camera.cx_px + 0.5) / smaller - 0.5;  // pixel (0, 0) is a centre
  camera.cy_px = (camera.cy_px + 0.5) / smaller - 0.5;
  return smaller;
}

std::string pixels_sha256(const cv::Mat& picture) {
  Sha256 hash;
  hash.add(fmt::format("{} x {} of type {}\n", picture.cols, picture.rows, picture.type()));
  const std::size_t row_bytes = static_cast<std::size_t>(picture.cols) * picture.elemSize();
  for (int row = 0; row < picture.rows; ++row) {
    const auto* const bytes = picture.ptr<char>(row);
    hash.add({bytes, row_bytes});
  }
  return hash.hex();
}

GoldenFrame render_golden(const Experiment& experiment, const FrameName& frame, renderer::Backend backend,
                          renderer::MeshCache& meshes) {
  const worlds::Scenario& scenario = experiment.scenario;
  check(scenario, frame);
  GoldenFrame golden{.name = frame, .is_linear = scenario.camera.encoding == worlds::Encoding::kLinear};
  vision::StereoRig rig = scenario.rig;
  golden.smaller = make_smaller(rig);
  look_at(experiment, frame, backend, meshes, [&](const FrameEvent& event) {
    golden.left.seen_sha256 = pixels_sha256(event.pair.left);
    golden.right.seen_sha256 = pixels_sha256(event.pair.right);
  });
  const Experiment small = in_small(experiment);
  const worlds::World world = worlds::world_for_seed(scenario, frame.seed);
  FrameTruth truth(small.scenario, world, meshes.forms());
  const bool is_seen = look_at(small, frame, backend, meshes, [&](const FrameEvent& event) {
    truth.look_at(event);
    golden.first_mesh = renderer::first_mesh_primitive(event.world);
    golden.left.colour = event.pair.left.clone();
    golden.right.colour = event.pair.right.clone();
    golden.left.shown = in_16_bits(truth.pixels(Side::kLeft).surface);
    golden.right.shown = in_16_bits(truth.pixels(Side::kRight).surface);
  });
  if (!is_seen) refuse_dropped(frame);
  return golden;
}

}  // namespace stereobench::harness
