/// Draws balls: ray-cast quads, blended over what lies behind them.
#pragma once

#include <optional>
#include <vector>

#include "renderer/balls/ball_outline.h"
#include "renderer/balls/ball_shader.h"
#include "renderer/gl/gl_objects.h"

namespace stereobench::renderer {

/// Owns the programs and the stream of outlines.
class BallPainter {
 public:
  BallPainter(const Gl& gl, const worlds::World& world);

  /// The balls that the camera can see, what is behind another first.
  std::vector<BallOutline> outlines(const CameraView& view) const;

  /// Draws balls over a picture whose surfaces are already there.
  /// @param outlines as above
  void draw(const CameraView& view, const std::vector<BallOutline>& outlines);

  /// Draws those that the camera can see with the numbers of primitives (primitives.h) in place of colours.
  void draw_primitives(const CameraView& view);

 private:
  struct Part {
    Program program;
    GLint towards_light;
  };
  Part make_part(const Gl& gl, BallPart which) const;
  void prepare(const Part& part, const CameraView& view) const;
  void upload(const std::vector<BallOutline>& outlines);
  void draw_boxes(std::size_t count) const;

  const Gl* gl_;
  std::vector<worlds::Ball> balls_;
  worlds::Light light_;
  VertexArray stream_;
  Part core_;
  Part rim_;
  std::optional<Part> primitive_;  // once somebody asked
};

}  // namespace stereobench::renderer
