#include "harness/verify/readers/shards/shard_sample.h"

#include <cmath>

#include "harness/dataset/drive_json.h"
#include "harness/verify/readers/scene/scene_json.h"

namespace stereobench::harness {
namespace {

constexpr std::int64_t kMostCount = std::int64_t{1} << 31;

Eigen::Vector3d place_in(const JsonValue& value) {
  const std::vector<double> numbers = numbers_of(value, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Isometry3d rows_in(const JsonValue& value) {
  Eigen::Isometry3d pose;
  const auto rows = value.list(4, 4);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::vector<double> numbers = numbers_of(rows[row], 4);
    for (std::size_t column = 0; column < numbers.size(); ++column)
      pose.matrix()(static_cast<int>(row), static_cast<int>(column)) = numbers[column];
  }
  return pose;
}

SampleBall sample_ball(const JsonValue& json) {
  SampleBall ball = {.ball = static_cast<int>(json.at("ball_id").integer(0, kMostCount - 1)),
                     .colour = json.at("colour").integer(-1, kMostCount)};
  ball.in_world = {.centre_m = place_in(json.at("centre_in_world_m")),
                   .radius_m = json.at("radius_m").number(0.0, kMostNumber)};
  constexpr std::array kCameras = {"left", "right"};
  for (std::size_t side = 0; side < 2; ++side) {
    const JsonValue seen = json.at(kCameras[side]);
    ball.centre_in_camera_m[side] = place_in(seen.at("centre_in_camera_m"));
    ball.px_count_visib[side] = seen.at("px_count_visib").integer(0, kMostCount);
    ball.bbox_visib[side] = box_in(seen.at("bbox_visib"));
  }
  return ball;
}

}  // namespace

bool is_stereo_sample(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  return json.is_discarded() || (json.is_object() && json.contains("rig"));
}

ShardSample shard_sample(const std::string& text) {
  constexpr double kSecond = 1e9;
  const nlohmann::json whole = parse_line(text);
  const JsonValue json(whole, "");
  ShardSample sample = {.drive = json.at("drive").text(),
                        .seed = json.at("seed").natural_number(),
                        .step = static_cast<int>(json.at("step").integer(0, kMostCount - 1)),
                        .stamp_ns = std::llround(kSecond * json.at("t_s").number(0.0, kSecond)),
                        .is_late = number_of(json.at("late_s")) != 0.0,
                        .said_of_rig = {},
                        .rig = read_rig(json.at("rig")),
                        .believed_rig = read_rig(json.at(json.find("believed_rig") ? "believed_rig" : "rig")),
                        .world_from_robot = rows_in(json.at("world_from_robot")),
                        .world_from_camera = {rows_in(json.at("world_from_left_camera")),
                                              rows_in(json.at("world_from_right_camera"))}};
  sample.said_of_rig = whole.at("rig");
  constexpr std::size_t kMostBalls = 1 << 16;
  for (const JsonValue& ball : json.at("balls").list(0, kMostBalls))
    sample.balls.push_back(sample_ball(ball));
  return sample;
}

}  // namespace stereobench::harness
