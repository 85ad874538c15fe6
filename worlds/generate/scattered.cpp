#include "worlds/generate/scattered.h"

#include <algorithm>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "slam/models/measurement.h"
#include "vision/palette.h"
#include "worlds/generate/paint.h"
#include "worlds/visibility/drive_visibility.h"
#include "worlds/visibility/occluders.h"
#include "worlds/visibility/visibility.h"

namespace stereobench::worlds {
namespace {

constexpr double kGap_m = 0.02;  // between things
constexpr std::uint64_t kScatterTries = 300;

Wall line_between(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  return {from_m, to_m};
}

/// A thing's outline on the floor is within a circle.
double floor_radius_m(const MeshInstance& thing) {
  const Eigen::Vector2d size_m = thing.scale.head<2>();
  return thing.shape == MeshShape::kBall ? 0.5 * size_m.x() : 0.5 * size_m.norm();
}

/// One world being scattered with things.
class Scattering {
 public:
  Scattering(const Scenario& scenario, World& world, KeyedSampler& draws)
      : scenario_(scenario), world_(world), draws_(draws), visibility_(scenario, world), occluders_(world) {}

  void scatter(const Distractors& distractors) {
    for_each("distractors", distractors.scattered,
             [&](const std::string& name) { return distractor(name, distractors); });
  }
  void scatter(const Clutter& clutter) {
    for_each("clutter", clutter.scattered, [&](const std::string& name) { return box(name, clutter); });
  }
  std::vector<std::string> left_out() const { return left_out_; }

 private:
  template <typename Make>
  void for_each(const std::string& group, const Scattered& rules, Make make) {
    const int count = draws_.whole(group + ".count", static_cast<int>(rules.count.least),
                                   static_cast<int>(rules.count.most));
    for (int i = 0; i < count; ++i) {
      const std::string name = fmt::format("{}[{}]", group, i);
      MeshInstance thing = make(name);
      if (!place(name, rules, thing)) {
        left_out_.push_back(name);
        continue;
      }
      world_.meshes.push_back(std::move(thing));
      visibility_.put(sphere_of(world_.meshes.back()));
    }
  }

  MeshInstance distractor(const std::string& name, const Distractors& rules) {
    MeshInstance thing{.material = Material::kPaint};
    thing.shape = draw_shape(draws_, name + ".shape", rules.shapes);
    thing.scale = Eigen::Vector3d::Constant(draws_.number(name + ".size_m", rules.scattered.size_m));
    thing.heading_rad = draws_.number(name + ".heading_deg", {0.0, 360.0}) * slam::kRadPerDegree;
    const int colour = draws_.whole(name + ".colour", 0, static_cast<int>(vision::kPalette.size()) - 1);
    thing.tint_rgb = draw_paint(draws_, name, colour, rules.shade, rules.tint);
    return thing;
  }

  MeshInstance box(const std::string& name, const Clutter& rules) {
    MeshInstance thing{.shape = MeshShape::kBox};
    for (const auto& [axis, side] : {std::pair{0, ".width_m"}, {1, ".depth_m"}, {2, ".height_m"}})
      thing.scale[axis] = draws_.number(name + side, rules.scattered.size_m);
    thing.heading_rad = draws_.number(name + ".heading_deg", {0.0, 360.0}) * slam::kRadPerDegree;
    thing.material = draw_material(draws_, name, rules.looks);
    thing.tint_rgb = draw_tint(draws_, name, rules.looks);
    return thing;
  }

  /// Draws places until one will do.
  bool place(const std::string& name, const Scattered& rules, MeshInstance& thing) {
    for (std::uint64_t attempt = 0; attempt < kScatterTries; ++attempt) {
      const std::size_t before = draws_.size();
      const auto step = static_cast<std::size_t>(
          draws_.whole(name + ".step", 0, static_cast<int>(scenario_.path.size()) - 1, attempt));
      const double range_m = draws_.number(name + ".range_m", rules.range_m, attempt);
      const double bearing_rad =
          draws_.number(name + ".bearing_deg", rules.bearing_deg, attempt) * slam::kRadPerDegree;
      const slam::Pose& pose = scenario_.path[step].pose;
      thing.position_m.head<2>() = slam::locate(pose, {range_m, bearing_rad});
      if (is_clear(thing, rules, {pose.x_m, pose.y_m}) &&
          visibility_.allows(sphere_of(thing), scenario_.randomise.balls_in_view))
        return true;
      draws_.forget_from(before);
    }
    return false;
  }

  static Sphere sphere_of(const MeshInstance& thing) {
    World alone;
    alone.meshes = {thing};
    return spheres_around_shapes(alone).front();
  }

  /// @param from where the drive looks at it from
  bool is_clear(const MeshInstance& thing, const Scattered& rules, const Eigen::Vector2d& from) const {
    const Eigen::Vector2d at = thing.position_m.head<2>();
    const double own_m = floor_radius_m(thing);
    return is_clear_of_walls(at, own_m, from) && is_clear_of_drive(at, own_m + rules.clearance_m) &&
           is_clear_of_occluders(thing, from) &&
           std::ranges::none_of(world_.balls,
                                [&](const Ball& ball) {
                                  return (ball.centre_m.head<2>() - at).norm() <
                                         own_m + ball.radius_m + kGap_m;
                                }) &&
           std::ranges::none_of(world_.meshes, [&](const MeshInstance& other) {
             return other.shape != MeshShape::kFile &&
                    (other.position_m.head<2>() - at).norm() < own_m + floor_radius_m(other) + kGap_m;
           });
  }

  bool is_clear_of_walls(const Eigen::Vector2d& at, double own_m, const Eigen::Vector2d& from) const {
    return std::ranges::none_of(world_.walls, [&](const Wall& wall) {
      return distance_m(at, wall) < own_m + kGap_m || segments_meet(from, at, wall.from_m, wall.to_m);
    });
  }

  /// Mesh files that reach no higher than the gap are what things stand on.
  bool is_clear_of_occluders(const MeshInstance& thing, const Eigen::Vector2d& from) const {
    const Sphere middle{thing.position_m + Eigen::Vector3d(0.0, 0.0, 0.5 * thing.scale.z()), kGap_m};
    const Eigen::Vector3d camera_m(from.x(), from.y(), scenario_.rig.height_m);
    return !occluders_.meet(upright_cylinder(thing.position_m.head<2>(), floor_radius_m(thing) + kGap_m,
                                             kGap_m, thing.scale.z())) &&
           !occluders_.meet(visibility_volume(camera_m, middle, 0.0));
  }

  bool is_clear_of_drive(const Eigen::Vector2d& at, double least_m) const {
    const auto place_of = [](const PathStep& step) { return Eigen::Vector2d(step.pose.x_m, step.pose.y_m); };
    for (std::size_t k = 0; k < scenario_.path.size(); ++k) {
      const Eigen::Vector2d here = place_of(scenario_.path[k]);
      const Eigen::Vector2d next = place_of(scenario_.path[std::min(k + 1, scenario_.path.size() - 1)]);
      const double away_m = here == next ? (here - at).norm() : distance_m(at, line_between(here, next));
      if (away_m < least_m) return false;
    }
    return true;
  }

  const Scenario& scenario_;
  World& world_;
  KeyedSampler& draws_;
  DriveVisibility visibility_;
  Occluders occluders_;
  std::vector<std::string> left_out_;
};

}  // namespace

std::vector<std::string> scatter(const Scenario& scenario, World& world, KeyedSampler& draws) {
  const Randomisation& rules = scenario.randomise;
  if (!rules.distractors && !rules.clutter) return {};
  Scattering scattering(scenario, world, draws);
  if (rules.distractors) scattering.scatter(*rules.distractors);
  if (rules.clutter) scattering.scatter(*rules.clutter);
  return scattering.left_out();
}

}  // namespace stereobench::worlds
