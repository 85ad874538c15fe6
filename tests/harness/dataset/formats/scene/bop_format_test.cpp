#include "harness/dataset/formats/scene/bop_format.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::Side;

/// A second ball that is hidden in part.
worlds::Scenario occluded_drive() {
  worlds::Scenario scenario = tilted_drive();
  scenario.world.balls[1] = {{2.6, 0.2, 0.3}, 0.1, 5};
  return scenario;
}

Eigen::Matrix3d matrix_in(const nlohmann::json& json) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = json.at(static_cast<std::size_t>(i)).get<double>();
  return matrix;
}

Eigen::Vector3d vector_in(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

std::string scene_of(Side side) {
  return side == Side::kLeft ? "test_left/000000/" : "test_right/000000/";
}

// Law: a ball's pose in the camera, K, and the camera's pose in the world say where the centre is.
TEST(BopFormat, HasThePosesOfBallsAndCameras) {
  const WrittenDrive drive("bop", occluded_drive());
  for (const Side side : kBothSides) {
    const auto cameras = nlohmann::json::parse(drive.text(scene_of(side) + "scene_camera.json"));
    const auto poses = nlohmann::json::parse(drive.text(scene_of(side) + "scene_gt.json"));
    for (std::size_t step = 0; step < 3; ++step) {
      const auto& camera = cameras.at(std::to_string(step));
      const auto& ball = poses.at(std::to_string(step)).at(0);
      const Eigen::Vector3d at_mm = vector_in(ball.at("cam_t_m2c"));
      const Eigen::Vector2d px = (matrix_in(camera.at("cam_K")) * at_mm).hnormalized();
      EXPECT_LT((px - drive.true_ball_px(step, side)).norm(), 1e-9);
      const Eigen::Vector3d centre_mm = 1000.0 * drive.scenario().world.balls[0].centre_m;
      const Eigen::Matrix3d turn = matrix_in(camera.at("cam_R_w2c"));
      EXPECT_LT((turn * centre_mm + vector_in(camera.at("cam_t_w2c")) - at_mm).norm(), 1e-9);
      EXPECT_LT((matrix_in(ball.at("cam_R_m2c")) - turn).norm(), 1e-12);
      EXPECT_EQ(ball.at("obj_id"), 1);
    }
  }
}

// Law: a mask within the outline holds the pixels whose sight lines meet the sphere, and the visible one
// those of the identity picture; counts and boxes are of the masks.
TEST(BopFormat, MasksAreTheWholeBallAndWhatIsSeenOfIt) {
  const WrittenDrive drive("bop", occluded_drive());
  const auto infos = nlohmann::json::parse(drive.text("test_left/000000/scene_gt_info.json"));
  const auto poses = nlohmann::json::parse(drive.text("test_left/000000/scene_gt.json"));
  const cv::Mat ids = drive.frame(1).left.ball_id;
  for (std::size_t ball = 0; ball < 2; ++ball) {
    const auto& info = infos.at("1").at(ball);
    const std::string name = fmt::format("000001_{:06}.png", ball);
    const cv::Mat whole = drive.picture("test_left/000000/mask/" + name);
    const cv::Mat seen = drive.picture("test_left/000000/mask_visib/" + name);
    EXPECT_EQ(cv::norm(seen, ids == static_cast<double>(ball + 1), cv::NORM_INF), 0.0);
    const Eigen::Vector3d centre_m = 1e-3 * vector_in(poses.at("1").at(ball).at("cam_t_m2c"));
    cv::Mat met = cv::Mat::zeros(whole.size(), CV_8UC1);
    for (int row = 0; row < met.rows; ++row)
      for (int column = 0; column < met.cols; ++column) {
        const Eigen::Vector3d ray =
            vision::pixel_ray(drive.scenario().rig.intrinsics, Eigen::Vector2d(column, row)).normalized();
        if (ray.cross(centre_m).norm() <= 0.1) met.at<std::uint8_t>(row, column) = 255;
      }
    EXPECT_EQ(cv::norm(whole, met, cv::NORM_INF), 0.0);
    EXPECT_EQ(info.at("px_count_all"), cv::countNonZero(met));
    EXPECT_EQ(info.at("px_count_valid"), cv::countNonZero(met));
    EXPECT_EQ(info.at("px_count_visib"), cv::countNonZero(seen));
    const cv::Rect all = cv::boundingRect(met), visible = cv::boundingRect(seen);
    EXPECT_EQ(info.at("bbox_obj"), nlohmann::json({all.x, all.y, all.width, all.height}));
    EXPECT_EQ(info.at("bbox_visib"), nlohmann::json({visible.x, visible.y, visible.width, visible.height}));
    EXPECT_EQ(info.at("visib_fract") == 1.0, ball == 0);
  }
}

// Law: level x depth_scale is the depth in mm.
TEST(BopFormat, HasDepthOfBothCameras) {
  const WrittenDrive drive("bop");
  const auto camera = nlohmann::json::parse(drive.text("camera.json"));
  const double scale = camera.at("depth_scale");
  const cv::Size size = drive.picture(scene_of(Side::kLeft) + "rgb/000002.png").size();
  EXPECT_EQ(cv::Size(camera.at("width"), camera.at("height")), size);  // mutation: the width for the height
  for (const Side side : kBothSides) {
    const renderer::StereoFrame frame = drive.frame(2);
    const cv::Mat levels = drive.picture(scene_of(side) + "depth/000002.png");
    ASSERT_EQ(levels.type(), CV_16UC1);
    cv::Mat depth_mm;
    levels.convertTo(depth_mm, CV_32F, scale);
    const cv::Mat& depth_m = side == Side::kLeft ? frame.left.depth_m : frame.right.depth_m;
    cv::Mat error_mm = cv::abs(depth_mm - 1000.0 * depth_m);
    error_mm.setTo(0.0, levels == 0);
    EXPECT_LE(cv::norm(error_mm, cv::NORM_INF), 0.101);
    EXPECT_GT(cv::countNonZero(levels), levels.rows * levels.cols / 2);
  }
}

// Law: corners lie on the sphere, and the triangles' volume is nearly the ball's.
TEST(BopFormat, ModelsAreSpheresOfTheBallsSize) {
  worlds::Scenario scenario = tilted_drive();
  scenario.world.balls.push_back(scenario.world.balls[1]);  // the same object again
  scenario.world.balls.back().centre_m.y() = -0.3;
  const WrittenDrive drive("bop", scenario);
  EXPECT_EQ(nlohmann::json::parse(drive.text("models/models_info.json")).size(), 2U);
  const std::string ply = drive.text("models/obj_000002.ply");
  const auto lines = words_of(ply.substr(ply.find("end_header\n") + 11));
  ASSERT_EQ(lines.size(), 2562U + 5120U);
  std::vector<Eigen::Vector3d> corners;
  double volume = 0.0;
  for (const auto& line : lines) {
    const std::vector<double> n = as_numbers(line);
    if (n.size() == 9) {
      corners.push_back({n[0], n[1], n[2]});
      EXPECT_NEAR(corners.back().norm(), 100.0, 1e-4);
    } else {
      const auto corner = [&](std::size_t i) { return corners.at(static_cast<std::size_t>(n.at(i))); };
      volume += corner(1).dot(corner(2).cross(corner(3))) / 6.0;
    }
  }
  EXPECT_NEAR(volume / (4.0 / 3.0 * 3.14159265358979 * 1e6), 1.0, 0.003);
}

TEST(BopFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"rig.distortion", [](worlds::Scenario& scenario) { scenario.rig.distortion.k1 = 0.1; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_bop_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format bop has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
