#include "harness/verify/readers/recording/recording_readers.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/recording/recorded_cameras.h"
#include "harness/verify/readers/recording/recorded_log.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr const char* kTruePose = "/ground_truth/pose";
constexpr const char* kPicture = "image_raw";

/// Headers end within so many bytes.
constexpr std::uint64_t kHeaderBytes = 4096;

/// Names of topics are part of what is said.
constexpr std::size_t kMostSaidOfPicture = 1000;

OpenRecording open_in(const fs::path& folder, const RecordingKind& kind) {
  const std::set<std::string> names = stems_in(folder, kind.ending);
  if (names.size() != 1)
    throw std::runtime_error(fmt::format(
        "{}: expected one file {} (got {}): a recording has a folder of its own", folder.string(),
        kind.ending, names.empty() ? "none" : fmt::format("{} and {}", *names.begin(), *names.rbegin())));
  return opened(kind.read(folder / (*names.begin() + kind.ending)));
}

/// A camera's pictures by their time.
using RecordedPictures = std::map<std::int64_t, const RecordedMessage*>;

std::string time_text(std::int64_t stamp_ns) {
  return fmt::format("{}", stamp_ns);
}

/// Messages that were counted when they were sent, and are not there. Recorders that count otherwise, or do
/// not, are left alone: their numbers hardly ever follow each other.
void find_gaps(OpenRecording& from, const std::string& topic,
               const std::vector<ReadMessage<ReadHeader>>& headers) {
  std::vector<std::size_t> gaps;
  const auto number = [&](std::size_t i) {
    const auto& [message, header] = headers[i];
    return std::int64_t{message->sequence.value_or(header.sequence)};
  };
  for (std::size_t i = 1; i < headers.size(); ++i)
    if (number(i) != number(i - 1) + 1) gaps.push_back(i);
  if (2 * gaps.size() >= headers.size()) return;
  for (const std::size_t i : gaps)
    from.faults.push_back({from.place_of(topic), time_text(headers[i].value.stamp_ns),
                           fmt::format("missing frame: the message before has the number {}, and this one {}",
                                       number(i - 1), number(i))});
}

/// @param frame is told in which frame they are
RecordedPictures recorded_pictures(OpenRecording& from, std::size_t side, std::string& frame) {
  RecordedPictures pictures;
  const std::string topic = from.cameras[side] + kPicture, info = from.cameras[side] + "camera_info";
  const auto headers = read_messages(from, topic, "sensor_msgs/Image", read_ros_header, kHeaderBytes);
  std::optional<std::int64_t> before_ns;
  for (const auto& [message, header] : headers) {
    if (before_ns && header.stamp_ns <= *before_ns)
      from.faults.push_back(
          {from.place_of(topic), time_text(header.stamp_ns),
           fmt::format("the time is not after that of the picture before, {} ns", *before_ns)});
    before_ns = header.stamp_ns;
    pictures[header.stamp_ns] = message;
    frame = header.frame;
  }
  find_gaps(from, topic, headers);
  for (const auto& [message, header] :
       read_messages(from, info, "sensor_msgs/CameraInfo", read_ros_header, kHeaderBytes))
    if (!pictures.contains(header.stamp_ns))
      from.faults.push_back({from.place_of(topic), time_text(header.stamp_ns),
                             fmt::format("missing frame: {} has a message of this time", info)});
  return pictures;
}

void add_recorded_picture(const OpenRecording& from, ViewFrame& frame, Side side,
                          const RecordedMessage& message) {
  const std::string file = from.place_of(from.cameras[index_of(side)] + kPicture);
  const RecordedFile place = {
      .file = from.recording.file, .topics = {}, .messages = {}, .faults = {}, .checked = {}};
  const fs::path path = from.recording.file.parent_path() / file;
  frame.channels[index_of(side)][Channel::kPicture] = {
      file, 0.0, [place, path, message, version = from.version_of(message)] {
        try {
          return read_ros_image(version, message_bytes(place, message));
        } catch (const std::runtime_error& error) {
          throw std::runtime_error(
              worlds::excerpt(fmt::format("{}: {}", path.string(), error.what()), kMostSaidOfPicture));
        }
      }};
}

void read_true_poses(OpenRecording& from, DatasetView& view) {
  std::size_t number = 0;
  for (const auto& [message, stamped] :
       read_messages(from, kTruePose, "geometry_msgs/PoseStamped", read_ros_pose)) {
    ViewPose pose = {.file = view.poses_file, .stamp_ns = stamped.header.stamp_ns};
    pose.name = fmt::format("message {}", ++number);
    pose.quaternion_norm = stamped.pose.turn.norm();
    pose.matrix = stamped.pose.rigid().matrix();
    view.poses.push_back(pose);
  }
}

/// The true path is told in the plane, too.
void compare_poses(OpenRecording& from, const DatasetView& view, const RecordedStreams& streams) {
  constexpr double kRounding = 1e-9;
  std::map<std::int64_t, const ViewPose*> in_space;
  for (const ViewPose& pose : view.poses) in_space[*pose.stamp_ns] = &pose;
  std::size_t compared = 0;
  for (const StampedPose& planar : streams.truth) {
    const auto pose = in_space.find(planar.stamp_ns);
    if (pose == in_space.end()) continue;
    ++compared;
    const double off = (pose->second->matrix - world_from_robot(planar.pose).matrix()).cwiseAbs().maxCoeff();
    if (!(off <= kRounding))
      from.faults.push_back({view.poses_file, time_text(planar.stamp_ns),
                             fmt::format("the pose is off that of {}_2d by {:.3g}", kTruePose, off)});
  }
  if (compared > 0)
    from.recording.checked.push_back(fmt::format("poses against those in the plane ({})", compared));
}

void add_recorded_frames(OpenRecording& from, const std::array<RecordedPictures, 2>& pictures,
                         const std::optional<RecordedCameras>& cameras, DatasetView& view) {
  std::set<std::int64_t> stamps_ns;
  for (const RecordedPictures& of_camera : pictures)
    for (const auto& [stamp_ns, message] : of_camera) stamps_ns.insert(stamp_ns);
  for (const std::int64_t stamp_ns : stamps_ns) {
    ViewFrame frame = {.name = time_text(stamp_ns), .stamp_ns = {stamp_ns, stamp_ns}};
    if (cameras) frame.cameras = cameras->cameras;
    if (cameras && cameras->are_on_body)
      frame.world_from_body[0] = frame.world_from_body[1] = pose_at(view.poses, stamp_ns);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const auto found = pictures[index_of(side)].find(stamp_ns);
      if (found != pictures[index_of(side)].end())
        add_recorded_picture(from, frame, side, *found->second);
      else
        from.faults.push_back({from.place_of(from.cameras[index_of(side)] + kPicture), frame.name,
                               "missing frame: the other camera has a picture of this time"});
    }
    view.frames.push_back(std::move(frame));
  }
}

DatasetView view_of(OpenRecording from, const fs::path& folder, const RecordingKind& kind) {
  DatasetView view = {.format = kind.format, .folder = folder};
  view.poses_of = PosesOf::kBody;
  view.calibration_file = fmt::format("{}: camera_info and /tf_static", from.name);
  view.poses_file = from.place_of(kTruePose);
  view.pictures_file = from.place_of(from.cameras[0] + kPicture);
  read_true_poses(from, view);
  std::array<std::string, 2> frames;
  std::array<RecordedPictures, 2> pictures;
  for (std::size_t side = 0; side < 2; ++side) pictures[side] = recorded_pictures(from, side, frames[side]);
  const std::optional<RecordedCameras> cameras = recorded_cameras(from, frames, view.cannot);
  view.has_calibration = cameras.has_value();
  add_recorded_frames(from, pictures, cameras, view);
  const RecordedStreams streams = recorded_streams(from);
  compare_poses(from, view, streams);
  view.checked = from.recording.checked;
  view.checked.push_back(
      fmt::format("{} odometry readings, {} sightings", streams.odometry.size(), streams.sightings.size()));
  view.cannot.push_back(
      "depth, which the layout has not: cameras, baseline and poses were held against corners of "
      "the pictures");
  if (cameras && !cameras->are_on_body)
    view.cannot.push_back(
        fmt::format("poses: no transform leads from {} to the cameras", worlds::excerpt(from.body)));
  view.faults = std::move(from.faults);
  return view;
}

}  // namespace

bool looks_like_recording(const fs::path& folder, const RecordingKind& kind) {
  return !stems_in(folder, kind.ending).empty();
}

DatasetView read_recording_view(const fs::path& folder, const RecordingKind& kind) {
  return view_of(open_in(folder, kind), folder, kind);
}

RecordedStreams read_recording_log(const fs::path& folder, const RecordingKind& kind) {
  OpenRecording from = open_in(folder, kind);
  return recorded_streams(from);
}

}  // namespace stereobench::harness
