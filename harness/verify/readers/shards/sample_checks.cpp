#include "harness/verify/readers/shards/sample_checks.h"

#include <fmt/format.h>

#include "slam/math/elementary.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// Numbers are written exactly; products of poses round.
constexpr double kRounding = 1e-9;

std::string place_text(const Eigen::Vector3d& place_m) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", place_m.x(), place_m.y(), place_m.z());
}

bool is_same_pose(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  const double off = (one.matrix() - other.matrix()).cwiseAbs().maxCoeff();
  return off <= kRounding * (1.0 + one.translation().norm());
}

/// By how much a pose is off another one: "0.0012 m and 0.3 deg".
std::string difference(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  constexpr double kDegrees = 57.29577951308232;
  const Eigen::Isometry3d apart = other.inverse() * one;
  const Eigen::Quaterniond turn(apart.linear());
  return fmt::format("{:.3g} m and {:.2g} deg", apart.translation().norm(),
                     kDegrees * 2.0 * slam::arc_tangent(turn.vec().norm(), std::abs(turn.w())));
}

/// What a check says of a sample; empty where it is as it should be.
using SampleCheck = std::string (*)(const ShardSample& sample);

std::string wrong_right_pose(const ShardSample& sample) {
  const Eigen::Isometry3d right = sample.world_from_camera[0] *
                                  vision::robot_from_camera(sample.rig, Side::kLeft).inverse() *
                                  vision::robot_from_camera(sample.rig, Side::kRight);
  if (is_same_pose(sample.world_from_camera[1], right)) return {};
  const Eigen::Vector3d apart_m =
      (sample.world_from_camera[0].inverse() * sample.world_from_camera[1]).translation();
  return fmt::format(
      "world_from_right_camera is {} off where `rig` and world_from_left_camera put it: the "
      "right camera is {} m beside the left one, and baseline_m is {:.6g}",
      difference(sample.world_from_camera[1], right), place_text(apart_m), sample.rig.baseline_m);
}

std::string wrong_robot_pose(const ShardSample& sample) {
  const Eigen::Isometry3d left = sample.world_from_robot * vision::robot_from_camera(sample.rig, Side::kLeft);
  if (sample.is_late || is_same_pose(sample.world_from_camera[0], left)) return {};
  return fmt::format("world_from_left_camera is {} off where `rig` and world_from_robot put it",
                     difference(sample.world_from_camera[0], left));
}

/// Faults of one check: a line for each sample, or one for all where most are off.
void run_check(DatasetView& view, const std::vector<SampleOfFiles>& samples, SampleCheck check) {
  std::vector<Fault> faults;
  std::size_t all = 0;
  for (const SampleOfFiles& sample : samples) {
    if (!sample.said) continue;
    ++all;
    if (std::string wrong = check(*sample.said); !wrong.empty())
      faults.push_back({sample.files.place("json"), sample.files.key, std::move(wrong)});
  }
  if (faults.size() > 1 && 2 * faults.size() > all) {
    const Fault& first = faults.front();
    faults = {
        {view.poses_file, "",
         fmt::format("in {} of {} samples, first in {}: {}", faults.size(), all, first.frame, first.what)}};
  }
  view.faults.insert(view.faults.end(), faults.begin(), faults.end());
}

/// Names that end with a step, "bend_0_000002", and are of another one.
std::string wrong_name(const SampleOfFiles& sample) {
  const ShardSample& said = *sample.said;
  const std::string expected = fmt::format("{}_{}_{:06}", said.drive, said.seed, said.step);
  const bool is_ours = sample.files.key.starts_with(said.drive + "_");
  if (!is_ours || sample.files.key == expected) return {};
  return fmt::format("drive, seed and step are those of a sample {}", expected);
}

}  // namespace

BallPlaces balls_of_drives(DatasetView& view, const std::vector<SampleOfFiles>& samples) {
  BallPlaces places;
  std::map<int, std::pair<std::string, std::int64_t>> first;  // sample and colour, by place
  for (const SampleOfFiles& sample : samples) {
    if (!sample.said) continue;
    for (const SampleBall& ball : sample.said->balls) {
      const auto [known, is_new] = places.emplace(
          std::tuple(sample.said->drive, sample.said->seed, ball.ball), static_cast<int>(view.balls.size()));
      if (is_new) {
        view.balls.push_back(ball.in_world);
        first[known->second] = {sample.files.key, ball.colour};
        continue;
      }
      const ViewBall& other = view.balls[static_cast<std::size_t>(known->second)];
      const auto& [other_key, other_colour] = first[known->second];
      if (other.centre_m != ball.in_world.centre_m || other.radius_m != ball.in_world.radius_m ||
          other_colour != ball.colour)
        view.faults.push_back(
            {sample.files.place("json"), sample.files.key,
             fmt::format("ball {}: colour {}, radius {:.6g} m, centre {}, and in {} colour {}, {:.6g} m, {}",
                         ball.ball, ball.colour, ball.in_world.radius_m, place_text(ball.in_world.centre_m),
                         other_key, other_colour, other.radius_m, place_text(other.centre_m))});
    }
  }
  return places;
}

void check_samples(DatasetView& view, const std::vector<SampleOfFiles>& samples, bool right_is_late) {
  const SampleOfFiles* before = nullptr;
  for (const SampleOfFiles& sample : samples) {
    if (!sample.said) continue;
    if (std::string wrong = wrong_name(sample); !wrong.empty())
      view.faults.push_back({sample.files.place("json"), sample.files.key, std::move(wrong)});
    const bool is_same_drive = before != nullptr && before->said->drive == sample.said->drive &&
                               before->said->seed == sample.said->seed;
    if (is_same_drive && before->said->said_of_rig != sample.said->said_of_rig)
      view.faults.push_back({sample.files.place("json"), sample.files.key,
                             fmt::format("`rig` is not that of {}", before->files.key)});
    before = &sample;
  }
  run_check(view, samples, wrong_robot_pose);
  if (!right_is_late) run_check(view, samples, wrong_right_pose);
}

}  // namespace stereobench::harness
