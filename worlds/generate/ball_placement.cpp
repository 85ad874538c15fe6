#include "worlds/generate/ball_placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "slam/math/elementary.h"
#include "slam/math/random.h"
#include "slam/models/measurement.h"
#include "vision/palette.h"
#include "worlds/visibility/occluders.h"
#include "worlds/visibility/visibility.h"

namespace stereobench::worlds {
namespace {

constexpr std::uint64_t kDraws = (std::uint64_t{1} << 20U) + 16;  // of the world's stream
constexpr int kTries = 2000;
constexpr std::uint64_t kStarts =
    8;  // anew, where balls that came first leave no place for one that is needed
constexpr double kNearest_m = 0.5;

/// One drive being furnished.
class Placement {
 public:
  Placement(Scenario& scenario, const PlacementRules& rules, std::uint64_t start)
      : scenario_(scenario),
        rules_(rules),
        slack_m_(std::numbers::sqrt2 * scenario.placement_jitter_m),
        draws_(rules.seed, slam::Stream::kWorld, kDraws + start),
        occluders_(scenario.world) {}

  void fill() {
    for (const Eigen::Vector2d& at : rules_.first_m)
      if (!put(at))
        throw std::invalid_argument(
            fmt::format("expected room for a ball at ({:.2f}, {:.2f}) m", at.x(), at.y()));
    for (int i = 0; i < rules_.scattered; ++i) scatter();
    for (const PathStep& step : scenario_.path) in_view_.push_back(count_at(step.pose));
    for (std::size_t k = 0; k < scenario_.path.size(); ++k)
      while (in_view_[k] < rules_.in_view) add_for(k);
  }

 private:
  std::vector<Ball>& balls() { return scenario_.world.balls; }
  int count_at(const slam::Pose& pose) const {
    return static_cast<int>(balls_in_view(scenario_, scenario_.world, pose, slack_m_).size());
  }

  /// A ball at this place, if its rules allow one.
  std::optional<Ball> ball_at(const Eigen::Vector2d& at, double first_colour) const {
    const std::optional<int> colour = is_clear(at) ? colour_for(at, first_colour) : std::nullopt;
    if (!colour) return std::nullopt;
    return Ball{{at.x(), at.y(), rules_.radius_m}, rules_.radius_m, *colour, {}, true};
  }

  bool put(const Eigen::Vector2d& at) {
    const std::optional<Ball> ball = ball_at(at, draws_.uniform());
    if (ball) balls().push_back(*ball);
    return ball.has_value();
  }

  void scatter() {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const double x = draws_.uniform();
      const double y = draws_.uniform();
      if (put(rules_.field_m.min() + rules_.field_m.sizes().cwiseProduct(Eigen::Vector2d(x, y)))) return;
    }
    throw std::invalid_argument(fmt::format(
        "expected fewer balls: no room for number {} was found in {} tries", balls().size() + 1, kTries));
  }

  /// How far, and how much to each side, balls are worth a try.
  double reach_m() const {
    if (scenario_.sensor == SensorKind::kOracle) return scenario_.oracle.max_range_m;
    return scenario_.rig.intrinsics.focal_px * rules_.radius_m / kLeastRadius_px;
  }
  double half_angle_rad() const {
    if (scenario_.sensor == SensorKind::kOracle) return scenario_.oracle.field_of_view_rad / 2.0;
    return slam::arc_tangent(0.5 * scenario_.rig.intrinsics.width_px, scenario_.rig.intrinsics.focal_px);
  }

  void add_for(std::size_t step) {
    if (static_cast<int>(balls().size()) >= rules_.most_balls)
      fail(step, "more balls than it may have are needed");
    const slam::Pose& pose = scenario_.path[step].pose;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const double range_m = kNearest_m + (reach_m() - kNearest_m) * std::sqrt(draws_.uniform());
      const double bearing_rad = half_angle_rad() * (2.0 * draws_.uniform() - 1.0);
      const double first_colour = draws_.uniform();
      const std::optional<Ball> ball = ball_at(slam::locate(pose, {range_m, bearing_rad}), first_colour);
      if (ball && try_ball(*ball, step)) return;
    }
    fail(step, fmt::format("no place for another was found in {} tries", kTries));
  }

  [[noreturn]] void fail(std::size_t step, const std::string& why) const {
    const slam::Pose& pose = scenario_.path[step].pose;
    throw std::invalid_argument(fmt::format("expected {} balls in view at step {}, at ({:.2f}, {:.2f}) m: {}",
                                            rules_.in_view, step, pose.x_m, pose.y_m, why));
  }

  bool is_clear(const Eigen::Vector2d& at) const {
    const double own_m = rules_.radius_m + slack_m_;
    const World& world = scenario_.world;
    return std::ranges::none_of(
               world.walls,
               [&](const Wall& wall) { return distance_m(at, wall) < own_m + rules_.wall_gap_m; }) &&
           std::ranges::none_of(world.balls,
                                [&](const Ball& ball) {
                                  return (ball.centre_m.head<2>() - at).norm() <
                                         2.0 * slack_m_ + rules_.radius_m + ball.radius_m + 0.01;
                                }) &&
           std::ranges::none_of(scenario_.path,
                                [&](const PathStep& step) {
                                  return (Eigen::Vector2d(step.pose.x_m, step.pose.y_m) - at).norm() <
                                         own_m + rules_.clearance_m;
                                }) &&
           !occluders_.meet(upright_cylinder(at, own_m + rules_.wall_gap_m, kRim * rules_.radius_m,
                                             2.0 * rules_.radius_m)) &&
           is_outside_of_occluders(at);
  }

  /// Whether some of the drive could see a ball here, were it not for walls and distance: within a closed
  /// mesh nothing can.
  bool is_outside_of_occluders(const Eigen::Vector2d& at) const {
    const Sphere ball{{at.x(), at.y(), rules_.radius_m}, rules_.radius_m};
    return std::ranges::any_of(scenario_.path, [&](const PathStep& step) {
      const Eigen::Vector3d camera_m(step.pose.x_m, step.pose.y_m, scenario_.rig.height_m);
      return !occluders_.meet(visibility_volume(camera_m, ball, slack_m_));
    });
  }

  /// A colour that nobody near has, in the order from `first` on.
  std::optional<int> colour_for(const Eigen::Vector2d& at, double first) const {
    const auto colours = static_cast<int>(vision::kPalette.size());
    for (int i = 0; i < colours; ++i) {
      const int colour = (static_cast<int>(first * colours) + i) % colours;
      if (std::ranges::none_of(scenario_.world.balls,
                               [&](const Ball& ball) { return look_alike(ball, at, colour); }))
        return colour;
    }
    return std::nullopt;
  }
  bool look_alike(const Ball& ball, const Eigen::Vector2d& at, int colour) const {
    if (ball.colour != colour && scenario_.identity != Identity::kNone) return false;
    if (scenario_.identity == Identity::kKnown) return scenario_.sensor == SensorKind::kStereo;
    return (ball.centre_m.head<2>() - at).norm() - 2.0 * slack_m_ < scenario_.colour_spacing_m + 1e-6;
  }

  /// Keeps the ball if it is seen from the step and takes from no step what it needs.
  bool try_ball(const Ball& ball, std::size_t step) {
    balls().push_back(ball);
    const int now = count_at(scenario_.path[step].pose);
    if (now <= in_view_[step]) return balls().pop_back(), false;
    std::vector<int> counts = in_view_;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const slam::Pose& pose = scenario_.path[k].pose;
      if ((Eigen::Vector2d(pose.x_m, pose.y_m) - ball.centre_m.head<2>()).norm() > reach_m() + 1.0) continue;
      counts[k] = count_at(pose);
      if (counts[k] < std::min(in_view_[k], rules_.in_view)) return balls().pop_back(), false;
    }
    in_view_ = std::move(counts);
    return true;
  }

  Scenario& scenario_;
  const PlacementRules& rules_;
  double slack_m_;
  slam::RandomStream draws_;
  Occluders occluders_;
  std::vector<int> in_view_;  ///< by step
};

}  // namespace

void place_balls(Scenario& scenario, const PlacementRules& rules) {
  const std::vector<Ball> before = scenario.world.balls;
  for (std::uint64_t start = 0;; ++start) {
    try {
      return Placement(scenario, rules, start).fill();
    } catch (const std::invalid_argument&) {
      scenario.world.balls = before;
      if (start + 1 == kStarts) throw;
    }
  }
}

}  // namespace stereobench::worlds
