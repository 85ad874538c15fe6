#include "renderer/balls/ball_shader.h"

#include <fmt/format.h>

namespace stereobench::renderer {
namespace {

constexpr const char* kVertex = R"glsl(#version 450 core
layout(location = 0) in vec4 a_centre;
layout(location = 1) in vec4 a_shape;
layout(location = 2) in vec4 a_ray;
layout(location = 3) in vec4 a_ball;
layout(location = 4) in vec4 a_colour;
layout(location = 5) in vec4 a_bounds;
flat out vec4 f_centre, f_shape, f_ray, f_ball, f_colour;

void main() {
  f_centre = a_centre; f_shape = a_shape; f_ray = a_ray; f_ball = a_ball; f_colour = a_colour;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(a_bounds.xy, a_bounds.zw, corner), 0.5, 1.0);
}
)glsl";

// The colour is blended by the weight of a second output (dual-source blending), which leaves alpha free for
// the ball's identity.
constexpr const char* kFragmentHead = R"glsl(#version 450 core
flat in vec4 f_centre, f_shape, f_ray, f_ball, f_colour;
layout(location = 0, index = 0) out vec4 o_colour;  // blue, green, red, identity
layout(location = 0, index = 1) out vec4 o_weight;
uniform vec3 u_towards_light;  // camera frame, unit length
uniform vec2 u_light;          // ambient, diffuse
uniform float u_near;

// Area of the unit square around the pixel's centre on the inner side of an edge, in closed form. size: the
// edge's unit normal, absolute values; outside: signed distance of the centre beyond the edge's nearest
// point, where it has this curvature. Between its ends the edge is replaced by the line that cuts off the
// same area: it bends away from its tangent by curvature t^2 / 2, t running along the chord within the
// square.
float covered_area(vec2 size, float outside, float curvature) {
  float a = max(size.x, size.y), b = max(min(size.x, size.y), 1e-6);
  float corner = max(0.5 * (a + b) - abs(outside), 0.0);  // what the line leaves of the way to the far corner
  bool cuts_corner = corner < b;
  float chord = cuts_corner ? corner / (a * b) : 1.0 / a;
  float middle = cuts_corner ? 0.5 * (a - b) * (1.0 - corner * (a + b) / (a * b)) : b * outside / a;
  outside += 0.5 * curvature * (chord * chord / 12.0 + middle * middle);
  float depth = abs(outside);
  corner = max(0.5 * (a + b) - depth, 0.0);
  float beyond = corner < b ? 0.5 * corner * corner / (a * b) : 0.5 - depth / a;
  return outside > 0.0 ? beyond : 1.0 - beyond;
}

// gradient: S q; level: sqrt(q' S q), 1 on the outline. Distance to first order along the gradient, which is
// exact for circles.
float coverage(vec2 gradient, float level) {
  float steepness = max(length(gradient), 1e-9);
  vec2 normal = gradient / steepness;
  vec2 along = vec2(-normal.y, normal.x);
  float curvature = level * (f_shape.x * along.x * along.x + 2.0 * f_shape.y * along.x * along.y
                             + f_shape.z * along.y * along.y) / steepness;
  return covered_area(abs(normal), (level - 1.0) * level / steepness, curvature);
}

void main() {
  vec2 q = (gl_FragCoord.xy - f_centre.xy) - f_centre.zw;
  vec2 gradient = vec2(f_shape.x * q.x + f_shape.y * q.y, f_shape.y * q.x + f_shape.z * q.y);
  float inside = 1.0 - dot(q, gradient);
)glsl";

constexpr const char* kCoreTest = R"glsl(
  if (inside <= 0.0) discard;
  float weight = coverage(gradient, sqrt(1.0 - inside));
  float root = sqrt(f_shape.w * inside);
)glsl";

constexpr const char* kRimTest = R"glsl(
  if (inside > 0.0) discard;
  float weight = coverage(gradient, sqrt(1.0 - inside));
  if (weight <= 0.0) discard;
  float root = 0.0;
)glsl";

constexpr const char* kPrimitiveTest = R"glsl(
  if (inside <= 0.0) discard;
  float root = sqrt(f_shape.w * inside);
)glsl";

constexpr const char* kDepth = R"glsl(
  vec3 sight = vec3(f_ray.xy + q * f_ray.w, 1.0);
  float along = f_ray.z + f_ray.w * dot(q, f_ball.xy);
  float distance = (along - root) / dot(sight, sight);
  gl_FragDepth = u_near / distance;
)glsl";

constexpr const char* kColour = R"glsl(
  vec3 normal = normalize(sight * distance - f_ball.xyz);
  float light = u_light.x + u_light.y * max(dot(normal, u_towards_light), 0.0);
  o_colour = vec4(f_colour.bgr * light, f_colour.a);
  o_weight = vec4(weight);
}
)glsl";

constexpr const char* kPrimitive = R"glsl(
  o_colour = vec4(f_colour.a, 0.0, 0.0, 0.0);
}
)glsl";

}  // namespace

std::string ball_vertex_shader() {
  return kVertex;
}

std::string ball_fragment_shader(BallPart part) {
  if (part == BallPart::kPrimitive)
    return fmt::format("{}{}{}{}", kFragmentHead, kPrimitiveTest, kDepth, kPrimitive);
  return fmt::format("{}{}{}{}", kFragmentHead, part == BallPart::kCore ? kCoreTest : kRimTest, kDepth,
                     kColour);
}

}  // namespace stereobench::renderer
