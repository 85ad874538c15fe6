#include "harness/dataset/formats/container/ros_drive.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/container/pair_parts.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/io/picture_reader.h"
#include "harness/logs/measurement_log_writer.h"
#include "slam/models/motion.h"
#include "vision/camera/rig.h"
#include "vision/palette.h"
#include "worlds/generate/paint.h"

namespace stereobench::harness {
namespace {

using vision::Side;

constexpr std::string_view kMap = "map", kOdom = "odom", kRobot = "base_link";

constexpr std::string_view camera_frame(Side side) {
  return side == Side::kLeft ? "left_camera_optical" : "right_camera_optical";
}

/// The place of a topic in the list. @param name one of kRosTopics
std::size_t topic_of(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kRosTopics, name, &RosTopic::name) - kRosTopics.begin());
}

std::string colour_name(int colour) {
  return colour == slam::kUnknown ? "ball" : fmt::format("ball_{}", colour);
}

bool is_of_palette(int colour) {
  return colour >= 0 && static_cast<std::size_t>(colour) < vision::kPalette.size();
}

/// Where something is seen, from the robot: m, x to the front, y to the left.
Eigen::Vector2d place_from_robot(const slam::RangeBearing& seen) {
  const slam::SineCosine turn = slam::sine_cosine(seen.bearing_rad);
  return {seen.range_m * turn.cosine, seen.range_m * turn.sine};
}

class RosPlayer {
 public:
  RosPlayer(const DatasetDrive& drive, const MeasurementLog& log, RosVersion version,
            const std::filesystem::path& folder, const std::function<void(const RosEvent&)>& on_message)
      : drive_(drive),
        log_(log),
        version_(version),
        folder_(folder),
        on_message_(on_message),
        readings_(odometry_readings(log)),
        dead_reckoned_(log.start),
        taken_(steps_with_pictures(drive)) {}

  void play() {
    play_rig();
    play_landmarks();
    play_odometry(log_.steps.front().stamp_ns, {});
    for (std::size_t step = 0; step < log_.steps.size(); ++step) {
      play_readings(log_.steps[step].stamp_ns);
      play_truth(log_.steps[step]);
      if (drive_.steps[step].pictures) play_pair(step);
      play_sightings(log_.steps[step]);
    }
  }

 private:
  RosHeader header(std::string_view topic, std::int64_t stamp_ns, std::string_view frame) const {
    return {sequences_[topic_of(topic)], kEpoch_ns + stamp_ns, frame};
  }
  void send(std::string_view topic, std::int64_t stamp_ns, std::string message) {
    const std::size_t index = topic_of(topic);
    on_message_({index, sequences_[index]++, kEpoch_ns + stamp_ns, std::move(message)});
  }

  void play_rig();
  void play_landmarks();
  void play_readings(std::int64_t until_ns);
  void play_odometry(std::int64_t stamp_ns, const OdometryReading& reading);
  void play_truth(const LogStep& step);
  void play_pair(std::size_t step);
  void play_picture(std::size_t step, Side side);
  void play_balls(std::size_t step);
  void play_sightings(const LogStep& step);
  std::int64_t until_next_pair_ns(std::size_t step) const;

  const DatasetDrive& drive_;
  const MeasurementLog& log_;
  RosVersion version_;
  const std::filesystem::path& folder_;
  const std::function<void(const RosEvent&)>& on_message_;
  std::vector<OdometryReading> readings_;
  std::size_t next_reading_ = 0;
  slam::Pose dead_reckoned_;
  std::vector<std::size_t> taken_;
  std::array<std::uint32_t, kRosTopics.size()> sequences_ = {};
};

void RosPlayer::play_rig() {
  const std::int64_t stamp_ns = log_.steps.front().stamp_ns;
  std::vector<RosTransform> cameras;
  for (const Side side : {Side::kLeft, Side::kRight})
    cameras.push_back({header("/tf_static", stamp_ns, kRobot), camera_frame(side),
                       vision::robot_from_camera(drive_.rig, side)});
  send("/tf_static", stamp_ns, ros_transforms(version_, cameras));
}

void RosPlayer::play_landmarks() {
  const std::string_view topic = "/ground_truth/landmarks";
  const std::int64_t stamp_ns = log_.steps.front().stamp_ns;
  std::vector<RosPoint> points;
  for (const LandmarkTruth& landmark : log_.landmarks)
    points.push_back({landmark.position_m,
                      {static_cast<double>(landmark.landmark_id), landmark.position_m.x(),
                       landmark.position_m.y(), static_cast<double>(landmark.colour_class)}});
  send(topic, stamp_ns, ros_points(version_, header(topic, stamp_ns, kMap), kLandmarkColumns, points));
}

/// All readings that end until then: one lasts until the next one, the last until the last step.
void RosPlayer::play_readings(std::int64_t until_ns) {
  for (; next_reading_ < readings_.size(); ++next_reading_) {
    const OdometryReading& reading = readings_[next_reading_];
    const std::int64_t end_ns = next_reading_ + 1 < readings_.size() ? readings_[next_reading_ + 1].stamp_ns
                                                                     : log_.steps.back().stamp_ns;
    if (end_ns > until_ns) return;
    if (end_ns <= reading.stamp_ns) continue;
    const double duration_s =
        static_cast<double>(end_ns - reading.stamp_ns) / static_cast<double>(kSecond_ns);
    dead_reckoned_ = slam::advance(
        dead_reckoned_, {.v_mps = reading.v_mps, .w_radps = reading.w_radps, .duration_s = duration_s});
    play_odometry(end_ns, reading);
  }
}

void RosPlayer::play_odometry(std::int64_t stamp_ns, const OdometryReading& reading) {
  const RosTransform pose = {header("/odom", stamp_ns, kOdom), kRobot, world_from_robot(dead_reckoned_)};
  send("/odom", stamp_ns, ros_odometry(version_, pose, reading.v_mps, reading.w_radps));
}

void RosPlayer::play_truth(const LogStep& step) {
  const Eigen::Isometry3d pose = world_from_robot(step.truth.value());
  const std::array robot = {RosTransform{header("/tf", step.stamp_ns, kMap), kRobot, pose}};
  send("/tf", step.stamp_ns, ros_transforms(version_, robot));
  send("/ground_truth/pose", step.stamp_ns,
       ros_pose(version_, header("/ground_truth/pose", step.stamp_ns, kMap), pose));
  send("/ground_truth/pose_2d", step.stamp_ns, ros_planar_pose(version_, *step.truth));
}

void RosPlayer::play_pair(std::size_t step) {
  for (const Side side : {Side::kLeft, Side::kRight}) play_picture(step, side);
  play_balls(step);
}

void RosPlayer::play_picture(std::size_t step, Side side) {
  const std::string place = fmt::format("/stereo/{}/", side == Side::kLeft ? "left" : "right");
  const std::string picture = place + "image_raw", info = place + "camera_info";
  const std::int64_t stamp_ns = drive_.steps[step].stamp_ns;
  send(picture, stamp_ns,
       ros_image(version_, header(picture, stamp_ns, camera_frame(side)),
                 read_picture(picture_part(folder_, step, side))));
  send(info, stamp_ns,
       ros_camera_info(version_, header(info, stamp_ns, camera_frame(side)), drive_.rig, side));
}

/// What was measured, seen from the robot and on the floor, since the height of a ball is not measured; and
/// the balls that a picture shows, as they are.
void RosPlayer::play_balls(std::size_t step) {
  const std::int64_t stamp_ns = drive_.steps[step].stamp_ns, lifetime_ns = until_next_pair_ns(step);
  std::vector<RosSphere> detected, true_balls;
  for (const slam::RangeBearing& seen : log_.steps[step].measurements) {
    const Eigen::Vector2d place_m = place_from_robot(seen);
    const int colour = seen.colour_class;
    detected.push_back({colour_name(colour),
                        static_cast<int>(detected.size()),
                        {place_m.x(), place_m.y(), 0.0},
                        drive_.world.ball_radius_m(),
                        is_of_palette(colour) ? worlds::palette_rgb(colour) : Eigen::Vector3d::Ones()});
  }
  send("/detections", stamp_ns,
       ros_spheres(version_, header("/detections", stamp_ns, kRobot), detected, lifetime_ns));
  for (const nlohmann::ordered_json& seen : visible_balls_part(folder_, step)) {
    const int id = seen.at("ball_id").get<int>();
    const worlds::Ball& ball = drive_.world.balls.at(static_cast<std::size_t>(id));
    true_balls.push_back(
        {colour_name(ball.colour), id, ball.centre_m, ball.radius_m, worlds::paint_of(ball)});
  }
  send("/ground_truth/balls", stamp_ns,
       ros_spheres(version_, header("/ground_truth/balls", stamp_ns, kMap), true_balls, lifetime_ns));
}

/// What was measured, as numbers that filters are given. Nothing is sent where nothing was seen.
void RosPlayer::play_sightings(const LogStep& step) {
  if (step.measurements.empty()) return;
  std::vector<RosPoint> points;
  for (const slam::RangeBearing& seen : step.measurements)
    points.push_back({place_from_robot(seen),
                      {static_cast<double>(seen.landmark_id), seen.range_m, seen.bearing_rad,
                       static_cast<double>(seen.colour_class), seen.covariance(0, 0), seen.covariance(0, 1),
                       seen.covariance(1, 1)}});
  send("/sightings", step.stamp_ns,
       ros_points(version_, header("/sightings", step.stamp_ns, kRobot), kSightingColumns, points));
}

/// 0 for the last pair.
std::int64_t RosPlayer::until_next_pair_ns(std::size_t step) const {
  const auto next = std::ranges::upper_bound(taken_, step);
  return next == taken_.end() ? 0 : drive_.steps[*next].stamp_ns - drive_.steps[step].stamp_ns;
}

}  // namespace

void check_ros_drive(const DatasetDrive& drive, std::string_view format) {
  const FormatLimits limits = {format, "pairs of one instant, of cameras side by side, in time"};
  if (!drive.rig.right_turn_rad.isZero(0.0)) limits.refuse("rig.right_turn_deg");
  limits.require_believed(drive);
  limits.require_one_instant(drive);
  limits.require_in_time(drive);
}

void play_ros_drive(const DatasetDrive& drive, const MeasurementLog& log, RosVersion version,
                    const std::filesystem::path& folder,
                    const std::function<void(const RosEvent&)>& on_message) {
  RosPlayer(drive, log, version, folder, on_message).play();
}

}  // namespace stereobench::harness
