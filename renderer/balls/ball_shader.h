/// The GLSL programs that draw balls.
#pragma once

#include <string>

namespace stereobench::renderer {

/// Which pixels of a ball a program draws. They need different depth writes, hence two programs.
enum class BallPart {
  kCore,       ///< whose centre sees the ball: colour blended by coverage, identity and depth written
  kRim,        ///< whose centre just misses it: colour blended by coverage, nothing else touched
  kPrimitive,  ///< the core with its identity alone, as the lowest of the primitive's four bytes
               ///< (primitives.h)
};

std::string ball_vertex_shader();
std::string ball_fragment_shader(BallPart part);

}  // namespace stereobench::renderer
