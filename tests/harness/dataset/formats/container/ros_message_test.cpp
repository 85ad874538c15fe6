/// Messages of both versions of ROS as bytes; tests/readers/ has readers of whole recordings.
#include "harness/dataset/formats/container/ros_message.h"

#include <cstring>
#include <sstream>

#include <gmock/gmock.h>

#include "harness/dataset/formats/container/ros_schema.h"

namespace stereobench::harness {
namespace {

constexpr std::int64_t kStamp_ns = 1'500'000'002'000'000'003;

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number = {};
  std::memcpy(&number, bytes.substr(at).data(), sizeof(number));
  return number;
}

Eigen::Isometry3d shifted() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 1.5, -2.5, 3.5;
  return pose;
}

// seq, seconds, nanoseconds, length and letters of the frame, then seven numbers. Meant to catch: no
// sequence.
TEST(RosMessage, OfRos1HasValuesOneAfterTheOther) {
  const std::string bytes = ros_pose(RosVersion::kOne, {9, kStamp_ns, "odom"}, shifted());
  ASSERT_EQ(bytes.size(), 4U + 8U + 4U + 4U + 7U * 8U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 0), 9U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 4), 1'500'000'002U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), 3U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 12), 4U);
  EXPECT_EQ(bytes.substr(16, 4), "odom");
  EXPECT_EQ(number_at<double>(bytes, 20), 1.5);
  EXPECT_EQ(number_at<double>(bytes, bytes.size() - 8), 1.0);  // w
}

// The numbers begin at a multiple of 8 after the first four bytes: "odom" and its zero end at 17. Mutations:
// not aligned; aligned from the file's first byte on; no zero.
TEST(RosMessage, OfRos2IsAligned) {
  const std::string bytes = ros_pose(RosVersion::kTwo, {9, kStamp_ns, "odom"}, shifted());
  ASSERT_EQ(bytes.size(), 4U + 24U + 7U * 8U);
  EXPECT_EQ(bytes.substr(0, 4), std::string("\0\1\0\0", 4));
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 4), 1'500'000'002U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 12), 5U);
  EXPECT_EQ(bytes.substr(16, 5), std::string("odom\0", 5));
  EXPECT_EQ(number_at<double>(bytes, 28), 1.5);
}

// A picture that is a part of a larger one has rows that do not touch. Meant to catch: its memory as it lies.
TEST(RosMessage, HasThePixelsOfAPictureRowByRow) {
  cv::Mat large(4, 5, CV_8UC3);
  for (int i = 0; i < 60; ++i) large.data[i] = static_cast<std::uint8_t>(i);
  const std::string bytes = ros_image(RosVersion::kOne, {}, large(cv::Rect(1, 1, 2, 2)));
  const std::string pixels = bytes.substr(bytes.size() - 12);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(pixels[i], static_cast<char>(18 + i + (i < 6 ? 0 : 9))) << i;
}

// Every type that a definition names is defined in it.
TEST(RosSchema, IsWhole) {
  for (const RosVersion version : {RosVersion::kOne, RosVersion::kTwo})
    for (const RosType type :
         {RosType::kImage, RosType::kCameraInfo, RosType::kOdometry, RosType::kPose, RosType::kPlanarPose,
          RosType::kTransforms, RosType::kSpheres, RosType::kTable}) {
      const RosSchema schema = ros_schema(type, version);
      std::istringstream words(schema.definition);
      for (std::string word; words >> word;) {
        const std::string name = word.substr(0, word.find('['));
        if (name.find('/') != std::string::npos) {
          EXPECT_THAT(schema.definition, testing::HasSubstr("MSG: " + name + "\n")) << schema.name;
        }
      }
      EXPECT_EQ(schema.md5.size(), version == RosVersion::kOne ? 32U : 0U);
    }
}

}  // namespace
}  // namespace stereobench::harness
