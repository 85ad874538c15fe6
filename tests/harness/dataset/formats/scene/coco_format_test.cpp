#include "harness/dataset/formats/scene/coco_format.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* kInstances = "annotations/instances_room_0.json";

/// The mask that runs stand for, by COCO's specification: columns first, zeros first.
cv::Mat decoded(const nlohmann::json& segmentation) {
  const int rows = segmentation.at("size").at(0), columns = segmentation.at("size").at(1);
  std::vector<std::uint8_t> levels;
  for (std::size_t i = 0; i < segmentation.at("counts").size(); ++i)
    levels.insert(levels.end(), segmentation.at("counts")[i].get<std::size_t>(), i % 2 == 0 ? 0 : 255);
  if (levels.size() != static_cast<std::size_t>(rows * columns)) return {};
  return cv::Mat(columns, rows, CV_8UC1, levels.data()).t();  // a row of this is a column of the picture
}

/// A second ball that is seen in part, and one that is hidden.
worlds::Scenario crowded_drive() {
  worlds::Scenario scenario = tilted_drive();
  scenario.world.balls[1] = {{2.6, 0.2, 0.3}, 0.1, 5};
  scenario.world.balls.push_back({{5.0, 0.0, 0.3}, 0.1, 1});
  return scenario;
}

// Law: the masks are the pixels of the identity pictures, and boxes and areas are those of the masks; what no
// pixel shows is not annotated.
TEST(CocoFormat, MasksAreThePixelsThatShowTheBall) {
  const WrittenDrive drive("coco", crowded_drive());
  const auto json = nlohmann::json::parse(drive.text(kInstances));
  std::size_t shown = 0;
  for (int picture = 1; picture <= 6; ++picture) {
    const renderer::StereoFrame frame = drive.frame(static_cast<std::size_t>(picture - 1) / 2);
    const cv::Mat& ids = picture % 2 == 1 ? frame.left.ball_id : frame.right.ball_id;
    for (int ball = 0; ball < 3; ++ball) shown += cv::countNonZero(ids == ball + 1) > 0 ? 1U : 0U;
    for (const auto& annotation : json.at("annotations")) {
      if (annotation.at("image_id") != picture) continue;
      const cv::Mat mask = decoded(annotation.at("segmentation"));
      ASSERT_EQ(mask.size(), ids.size());
      const int ball = annotation.at("ball_id");
      EXPECT_EQ(cv::norm(mask, ids == ball + 1, cv::NORM_INF), 0.0);
      const cv::Rect box = cv::boundingRect(mask);
      EXPECT_EQ(annotation.at("bbox"), nlohmann::json({box.x, box.y, box.width, box.height}));
      EXPECT_EQ(annotation.at("area"), cv::countNonZero(mask));
      EXPECT_EQ(annotation.at("iscrowd"), 0);
    }
  }
  EXPECT_EQ(json.at("annotations").size(), shown);
  EXPECT_GE(shown, 9U);
  EXPECT_LE(shown, 12U) << "the third ball is behind the wall";
}

TEST(CocoFormat, EachIdentityIsThereOnce) {
  const WrittenDrive drive("coco", crowded_drive());
  const auto json = nlohmann::json::parse(drive.text(kInstances));
  EXPECT_EQ(json.at("categories").size(), 3U);
  ASSERT_EQ(json.at("images").size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& picture = json.at("images")[i];
    EXPECT_EQ(picture.at("id"), i + 1);
    EXPECT_EQ(picture.at("width"), 160);
    EXPECT_EQ(picture.at("height"), 120);
    const renderer::StereoFrame frame = drive.frame(i / 2);
    const cv::Mat stored = drive.picture("images/" + picture.at("file_name").get<std::string>());
    EXPECT_EQ(cv::norm(stored, i % 2 == 0 ? frame.left.colour : frame.right.colour, cv::NORM_INF), 0.0);
  }
  for (std::size_t i = 0; i < json.at("annotations").size(); ++i) {
    const auto& annotation = json.at("annotations")[i];
    EXPECT_EQ(annotation.at("id"), i + 1);
    const auto colour = drive.scenario().world.balls[annotation.at("ball_id").get<std::size_t>()].colour;
    EXPECT_EQ(annotation.at("category_id"), colour + 1);
    const bool is_partly_hidden = annotation.at("px_count_visib") < annotation.at("px_count_all");
    EXPECT_EQ(is_partly_hidden, annotation.at("visib_fract") < 1.0);
    EXPECT_EQ(annotation.at("bbox_visib"), annotation.at("bbox"));
  }
}

TEST(CocoFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"rig.distortion", [](worlds::Scenario& scenario) { scenario.rig.distortion.k1 = 0.1; }},
      {"rig.pixel_aspect", [](worlds::Scenario& scenario) { scenario.rig.distortion.pixel_aspect = 1.1; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_coco_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format coco has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
