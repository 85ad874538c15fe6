#include "harness/dataset/formats/odometry/euroc_format.h"

#include <gmock/gmock.h>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;
using vision::Side;

// The numbers in the brackets behind a key.
std::vector<double> numbers_behind(const std::string& yaml, const std::string& key) {
  const std::size_t from = yaml.find(key + ": [");
  if (from == std::string::npos) return {};
  const std::size_t begin = yaml.find('[', from) + 1;
  return as_numbers(words_of(yaml.substr(begin, yaml.find(']', begin) - begin)).at(0));
}

// Law: the pose of the body times that of the sensor on it says where a picture shows a ball. Mutations: the
// transform from the body to the sensor; q with w last; both cameras at the left one's place.
TEST(EurocFormat, HasThePosesOfBothCameras) {
  const WrittenDrive drive("euroc");
  const auto states = words_of(drive.text("mav0/state_groundtruth_estimate0/data.csv"));
  ASSERT_EQ(states.size(), 3U);
  for (const auto& [camera, side] : {std::pair("cam0", Side::kLeft), std::pair("cam1", Side::kRight)}) {
    const std::string yaml = drive.text(std::string("mav0/") + camera + "/sensor.yaml");
    const std::vector<double> transform = numbers_behind(yaml, "data");
    ASSERT_EQ(transform.size(), 16U);
    for (std::size_t step = 0; step < 3; ++step) {
      const std::vector<double> n = as_numbers(states[step]);
      ASSERT_EQ(n.size(), 17U);
      const Eigen::Isometry3d body = pose_of({n[1], n[2], n[3]}, n[4], n[5], n[6], n[7]);
      EXPECT_LT((drive.ball_px(body * pose_of(transform)) - drive.true_ball_px(step, side)).norm(), 1e-6);
    }
  }
}

// Law: places change by speed times time. Mutation: speeds in the robot's frame.
TEST(EurocFormat, HasSpeedsThatLeadFromPlaceToPlace) {
  const WrittenDrive drive("euroc");
  const auto states = words_of(drive.text("mav0/state_groundtruth_estimate0/data.csv"));
  for (std::size_t step = 1; step < 3; ++step) {
    const std::vector<double> before = as_numbers(states[step - 1]), now = as_numbers(states[step]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(now[1 + axis], before[1 + axis] + 0.1 * now[8 + axis], 1e-12);
  }
}

// Mutations: focal length for both axes; coefficients in another order.
TEST(EurocFormat, HasTheLens) {
  worlds::Scenario scenario = tilted_drive();
  scenario.rig.distortion = {.k1 = -0.1, .k2 = 0.02, .p1 = 0.001, .p2 = -0.002, .pixel_aspect = 1.25};
  scenario.believed_rig = scenario.rig;
  const std::string yaml = WrittenDrive("euroc", scenario).text("mav0/cam0/sensor.yaml");
  EXPECT_EQ(numbers_behind(yaml, "intrinsics"), (std::vector<double>{140.0, 175.0, 76.25, 63.5}));
  EXPECT_EQ(numbers_behind(yaml, "distortion_coefficients"),
            (std::vector<double>{-0.1, 0.02, 0.001, -0.002}));
  EXPECT_EQ(numbers_behind(yaml, "resolution"), (std::vector<double>{160, 120}));
}

// Pictures of a pair have one name in both folders, and names sort by time. Mutations: no epoch; the right
// picture on both sides.
TEST(EurocFormat, HasOneNameForBothPictures) {
  const WrittenDrive drive("euroc");
  const renderer::StereoFrame frame = drive.frame(1);
  const auto lefts = words_of(drive.text("mav0/cam0/data.csv")),
             rights = words_of(drive.text("mav0/cam1/data.csv"));
  ASSERT_EQ(lefts.size(), 3U);
  EXPECT_EQ(lefts, rights);
  EXPECT_EQ(lefts[1], (std::vector<std::string>{"1500000000100000000", "1500000000100000000.png"}));
  EXPECT_EQ(words_of(drive.text("mav0/state_groundtruth_estimate0/data.csv"))[1][0], lefts[1][0]);
  for (const auto& [camera, picture] :
       {std::pair("cam0", frame.left.colour), std::pair("cam1", frame.right.colour)})
    EXPECT_EQ(cv::norm(drive.picture(std::string("mav0/") + camera + "/data/" + lefts[1][1]), picture,
                       cv::NORM_INF),
              0.0);
}

// Law: pictures have the rate of those that there are. Mutation: that of all steps.
TEST(EurocFormat, HasTheRateOfItsPictures) {
  const worlds::Scenario scenario = tilted_drive();
  const auto sensor_of = [&](const FrameChoice& frames) {
    const DatasetDrive drive = drive_of(scenario, scenario.world, 0, frames);
    const auto files = euroc_writer(drive)->drive_files({});
    return std::ranges::find(files, "mav0/cam1/sensor.yaml", &DatasetFile::name)->bytes();
  };
  EXPECT_THAT(sensor_of({}), HasSubstr("rate_hz: 10\n"));
  EXPECT_THAT(sensor_of({.first = 0, .last = 2, .stride = 2}), HasSubstr("rate_hz: 5\n"));
  EXPECT_THAT(sensor_of({.first = 1, .last = 1}), Not(HasSubstr("rate_hz")));
}

// Mutation: each line of the check left out.
TEST(EurocFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"rig.distortion.k3", [](worlds::Scenario& scenario) { scenario.rig.distortion.k3 = 0.1; }},
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.right_delay_s", [](worlds::Scenario& scenario) { scenario.shutter.right_delay_s = 0.01; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }},
      {"shutter.late_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.1; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_euroc_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format euroc has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
