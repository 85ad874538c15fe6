/// Truth beyond identity and depth, beside the pictures of a rendered data set.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "harness/dataset/truth_request.h"
#include "harness/drive/recording.h"
#include "harness/drive/shutter.h"
#include "renderer/renderer.h"
#include "renderer/truth/pixel_truth.h"
#include "renderer/truth/scene_geometry.h"

namespace stereobench::harness {

/// Adds to a data set's folder, for the left camera and likewise for the right one, what was asked for of:
///
///     left_balls/000000.jsonl      a line for each ball whose outline meets the picture (ball_lines.h)
///     left_surface/000000.png      16 bits, surface_id of surfaces.csv, 0 = nothing left_range/000000.pfm
///     metres along the ray, +inf = nothing left_normal/000000.pfm       red, green, blue: x, y, z in the
///     camera frame, 0 = nothing left_disparity/000000.pfm    px, u in the left picture minus u in the right
///     one, +inf = nothing left_match/000000.pfm        red, green: shift to the other camera's picture in
///     px; blue: 1 = seen there left_flow/000000.pfm         the same to the next step's picture of this
///     camera; the last step has none left_disparity_fate/ left_match_fate/ left_flow_fate/000000.png
///                                  0 = nothing, 85 = outside of the other picture, 170 = hidden there, 255 =
///                                  seen
///
/// In KITTI's format disparity, match and flow are PNGs (truth_pictures.h).
class RenderedTruth {
 public:
  /// @param folder of the data set, which exists
  /// @param scenario, world as they are rendered; they outlive this
  /// @param read meshes
  /// @throws std::runtime_error as require_truth, when the folder cannot be written, a mesh cannot be read,
  /// or there are more surfaces
  ///   than 16 bits can number
  RenderedTruth(std::filesystem::path folder, TruthRequest request, const worlds::Scenario& scenario,
                const worlds::World& world, const renderer::FormReader& read);

  /// Writes a step's files that are not there yet. Steps come in order, each with its renderer.
  void write(const FrameEvent& event);

  /// Writes surfaces.csv, where surfaces were asked for.
  void finish() const;

 private:
  struct ImageEvent;
  bool wants(TruthKind kind) const;
  std::filesystem::path file(std::size_t step, vision::Side side, TruthKind kind) const;
  bool has_all(const ImageEvent& event) const;
  renderer::StereoIdBuffers id_buffers_of(renderer::Renderer& renderer, const RowBand& band, std::size_t step,
                                          double late_s) const;
  const std::vector<renderer::StereoIdBuffers>& id_buffers_at(renderer::Renderer& renderer, std::size_t step,
                                                              double late_s);
  renderer::PixelTruth truth_of(const ImageEvent& event);
  void write_side(const ImageEvent& event);
  void write_pictures(const ImageEvent& event);
  void write_shift(const ImageEvent& event, TruthKind kind, const renderer::IdBuffer& other) const;

  std::filesystem::path folder_;
  TruthRequest request_;
  const worlds::Scenario& scenario_;
  const worlds::World& world_;
  renderer::SceneGeometry scene_;
  std::map<std::size_t, std::vector<renderer::StereoIdBuffers>>
      buffers_;  // of this step and the next, by bands
};

}  // namespace stereobench::harness
