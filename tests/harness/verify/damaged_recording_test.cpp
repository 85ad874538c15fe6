/// Recordings that are whole, and say what cannot be: small ones, which are made up message by message.
#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/dataset/formats/container/bag_file.h"
#include "harness/dataset/formats/container/mcap_file.h"
#include "harness/dataset/formats/container/ros_schema.h"
#include "harness/verify/verify_dataset.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr std::int64_t kStamp_ns = 1'500'000'000'000'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std::string kLeft = "/stereo/left/", kRight = "/stereo/right/";

/// A recording of ROS 2, with one message a topic.
class SmallRecording {
 public:
  explicit SmallRecording(bool has_pictures = true) {
    rig.intrinsics = {8, 6, 7.0, 3.5, 2.5};
    if (!has_pictures) return;
    for (const std::string& camera : {kLeft, kRight})
      add(camera + "image_raw", RosType::kImage,
          ros_image(RosVersion::kTwo, header, cv::Mat::zeros(6, 8, CV_8UC3)));
  }

  void add(const std::string& topic, RosType type, std::string message) {
    const RosSchema schema = ros_schema(type, RosVersion::kTwo);
    channels_.push_back({topic, schema.name, schema.definition});
    messages_.push_back(std::move(message));
  }

  void add_cameras() {
    for (const vision::Side side : {vision::Side::kLeft, vision::Side::kRight})
      add((side == vision::Side::kLeft ? kLeft : kRight) + "camera_info", RosType::kCameraInfo,
          ros_camera_info(RosVersion::kTwo, header, rig, side));
  }

  void write() const {
    AtomicFile file(folder_.path() / "drive.mcap");
    McapFile mcap(file, channels_);
    for (std::size_t i = 0; i < messages_.size(); ++i) mcap.add(i, 0, kStamp_ns, messages_[i]);
    mcap.finish();
    file.move_into_place();
  }
  std::string bytes() const { return folder_.read("drive.mcap"); }
  void write(const std::string& bytes) const { folder_.write("drive.mcap", bytes); }

  DatasetView view() const { return dataset_reader("mcap").read(folder_.path()); }
  std::vector<std::string> faults() const {
    std::vector<std::string> lines;
    for (const Fault& fault : view().faults) lines.push_back(line_of(fault));
    return lines;
  }
  /// What ends the reading; empty where nothing does.
  std::string refusal() const {
    try {
      view();
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  RosHeader header = {0, kStamp_ns, "camera"};
  vision::StereoRig rig;

 private:
  TestFolder folder_;
  std::vector<McapChannel> channels_;
  std::vector<std::string> messages_;
};

TEST(DamagedRecording, IsReadWhereItIsNone) {
  SmallRecording recording;
  recording.write();
  EXPECT_THAT(recording.faults(), testing::IsEmpty());
  EXPECT_EQ(recording.view().frames.size(), 1U);
}

// Each end has a checksum of all before it: of thousands of ends, reading would never come to the last one.
// Mutation: any number of ends.
TEST(DamagedRecording, EndsOnce) {
  SmallRecording recording;
  recording.write();
  std::string bytes = recording.bytes();
  const std::string head("\x0f\x04\0\0\0\0\0\0\0", 9);
  const std::size_t end = bytes.find(head);
  ASSERT_NE(end, std::string::npos);
  recording.write(bytes.insert(end, bytes.substr(end, head.size() + 4)));
  EXPECT_THAT(recording.refusal(), HasSubstr(": expected one end of the data (got a second one)"));
}

// Mutation: NaN is a place.
TEST(DamagedRecording, HasPosesOfNumbers) {
  for (const double value : {kNan, std::numeric_limits<double>::infinity(), -1e300}) {
    SmallRecording recording;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().y() = value;
    recording.add("/ground_truth/pose", RosType::kPose, ros_pose(RosVersion::kTwo, recording.header, pose));
    recording.write();
    EXPECT_THAT(recording.faults(),
                Contains(fmt::format("drive.mcap/ground_truth/pose: message 1: expected numbers up to 1e+12 "
                                     "(got {:g})",
                                     value)));
    EXPECT_TRUE(recording.view().poses.empty());
  }
}

// Mutation: a width of more than 2^31 columns becomes a negative one.
TEST(DamagedRecording, HasCamerasOfPixelsAndNumbers) {
  const std::string place = "drive.mcap/stereo/left/camera_info: message 1: expected ";
  const vision::Intrinsics no_width = {-8, 6, 7.0, 3.5, 2.5}, no_middle = {8, 6, 7.0, kNan, 2.5};
  for (const auto& [camera, expected] :
       {std::pair(no_width, "sides of at most 1048576 pixels (got 4294967288)"),
        std::pair(no_middle, "numbers up to 1e+12 (got nan)")}) {
    SmallRecording recording;
    recording.rig.intrinsics = camera;
    recording.add_cameras();
    recording.write();
    EXPECT_THAT(recording.faults(), Contains(place + expected));
    EXPECT_FALSE(recording.view().has_calibration);
  }
}

// A focal length of next to nothing makes a baseline that is infinite. Mutation: any positive one.
TEST(DamagedRecording, HasCamerasThatSee) {
  SmallRecording recording;
  recording.rig.intrinsics.focal_px = 1e-300;
  recording.add_cameras();
  recording.write();
  EXPECT_THAT(recording.faults(),
              Contains("drive.mcap/stereo/left/camera_info: expected positive focal lengths in K"));
}

// Names are the file's own, whatever is in them. Mutations: names as they are; all of them.
TEST(DamagedRecording, IsRefusedInOneLine) {
  SmallRecording recording(false);
  for (int i = 0; i < 1000; ++i)
    recording.add(fmt::format("/pose\n{}", i), RosType::kPlanarPose, ros_planar_pose(RosVersion::kTwo, {}));
  recording.write();
  const std::string refusal = recording.refusal();
  EXPECT_THAT(refusal, HasSubstr("drive.mcap: expected sensor_msgs/Image as .../left/image_raw and "
                                 ".../right/image_raw (got /pose 0 geometry_msgs/Pose2D, /pose 1 "));
  EXPECT_EQ(std::ranges::count(refusal, '\n'), 0);
  EXPECT_LT(refusal.size(), 3000U);
}

/// A bag whose only chunk is followed by many empty indices.
std::string bag_of_many_indices() {
  constexpr std::size_t kMessages = 15'000, kIndices = 60'000;  // all in one chunk
  const TestFolder folder;
  const RosSchema schema = ros_schema(RosType::kImage, RosVersion::kOne);
  AtomicFile file(folder.path() / "a.bag");
  BagFile bag(file, {{kLeft + "image_raw", schema.name, schema.md5, "", false}});
  for (std::size_t i = 0; i < kMessages; ++i) bag.add(0, kStamp_ns, "");
  bag.finish();
  file.move_into_place();
  std::string bytes = folder.read("a.bag");
  const std::string op("\x04\0\0\0op=\x04", 8), connection("\x09\0\0\0conn=\0\0\0\0", 13);
  const std::string fields = op + connection;
  std::string index = std::string("\x15\0\0\0", 4) + fields + std::string(4, '\0'), all;
  for (std::size_t i = 0; i < kIndices; ++i) all += index;
  return bytes += all;
}

// Each is a fault. Sorting the chunk's messages for each of them took a hundred times as long.
TEST(DamagedRecording, MayHaveManyIndices) {
  const TestFolder folder;
  folder.write("a.bag", bag_of_many_indices());
  EXPECT_GT(dataset_reader("rosbag").read(folder.path()).faults.size(), 50'000U);
}

TEST(FaultLine, IsOneLine) {
  const Fault fault = {"a\nb.tar", "c\rd", "e\n" + std::string(5000, 'x')};
  const std::string line = line_of(fault);
  EXPECT_THAT(line, testing::StartsWith("a b.tar: frame c d: e xxx"));
  EXPECT_LT(line.size(), 1100U);
}

}  // namespace
}  // namespace stereobench::harness
