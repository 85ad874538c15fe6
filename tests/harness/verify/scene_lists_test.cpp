#include <gmock/gmock.h>

#include "harness/io/picture_file.h"
#include "tests/harness/verify/planted_scene.h"

namespace stereobench::harness {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

constexpr const char* kInstances = "annotations/instances_bend_0.json";

/// One of COCO's annotations, of a ball that is seen well.
void change_annotation(const PlantedSet& set, const std::function<void(ordered_json&)>& change) {
  change_json(set, kInstances, [&](ordered_json& json) { change(json["annotations"][2]); });
}
void widen_box(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) {
    one["bbox"][2] = one["bbox"][2].get<int>() + 3;
    one["bbox_visib"] = one["bbox"];
  });
}
void empty_mask(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) { one["segmentation"]["counts"] = {320 * 240}; });
}
void turn_mask(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) { one["segmentation"]["size"] = {320, 240}; });
}
void lengthen_runs(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) {
    one["segmentation"]["counts"][0] = one["segmentation"]["counts"][0].get<int>() + 240;
  });
}
void move_mask(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) {
    auto& counts = one["segmentation"]["counts"];
    counts[0] = counts[0].get<int>() - 5 * 240;
    counts.back() = counts.back().get<int>() + 5 * 240;
  });
}
void miscount(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) { one["area"] = one["area"].get<int>() + 1; });
}
void miscount_visible_share(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) { one["visib_fract"] = 0.5; });
}
void annotate_twice(const PlantedSet& set) {
  change_json(set, kInstances, [](ordered_json& json) {
    json["annotations"].push_back(json["annotations"][2]);
    json["annotations"].back()["id"] = 5000;
  });
}
void forget_an_image(const PlantedSet& set) {
  change_json(set, kInstances, [](ordered_json& json) { json["images"].erase(3); });
}
void reach_out(const PlantedSet& set) {
  change_annotation(set, [](ordered_json& one) { one["bbox"] = {300, 100, 40, 20}; });
}
void shrink_listed_size(const PlantedSet& set) {
  change_json(set, kInstances, [](ordered_json& json) { json["images"][3]["width"] = 640; });
}

/// The first ball of BOP's picture 4, left.
void change_info(const PlantedSet& set, const std::function<void(ordered_json&)>& change) {
  change_json(set, "test_left/000000/scene_gt_info.json", [&](ordered_json& json) { change(json["4"][0]); });
}
void move_visible_box(const PlantedSet& set) {
  change_info(set, [](ordered_json& one) { one["bbox_visib"][0] = one["bbox_visib"][0].get<int>() + 4; });
}
void move_whole_box(const PlantedSet& set) {
  change_info(set, [](ordered_json& one) { one["bbox_obj"][1] = one["bbox_obj"][1].get<int>() + 4; });
}
void misstate_share(const PlantedSet& set) {
  change_info(set, [](ordered_json& one) { one["visib_fract"] = 0.25; });
}
void hide_ball(const PlantedSet& set) {
  set.write("test_left/000000/mask_visib/000004_000000.png",
            encoded(".png", cv::Mat::zeros(240, 320, CV_8UC1)));
}
void cut_whole_mask(const PlantedSet& set) {
  set.write("test_left/000000/mask/000004_000000.png", encoded(".png", cv::Mat::zeros(240, 320, CV_8UC1)));
}
void forget_an_object(const PlantedSet& set) {
  change_json(set, "test_left/000000/scene_gt.json", [](ordered_json& json) { json["4"].erase(0); });
}
void forget_a_camera(const PlantedSet& set) {
  change_json(set, "test_right/000000/scene_camera.json", [](ordered_json& json) { json.erase("4"); });
}

class PlantedInSceneList : public testing::TestWithParam<SceneCase> {};

// Law: what two lists, or a list and a mask, say of one thing is the same.
TEST_P(PlantedInSceneList, IsFoundAndNamed) {
  const PlantedSet set(GetParam().format);
  GetParam().plant(set);
  EXPECT_THAT(set.faults(), HasSubstr(GetParam().cause));
}

constexpr SceneCase kListCases[] = {
    {"box", "coco", widen_box, "bbox_visib is ["},
    {"box_out_of_picture", "coco", reach_out, "reaches out of the picture of 320 x 240"},
    {"hidden", "coco", empty_mask, "of a hidden ball"},
    {"turned_mask", "coco", turn_mask, "segmentation is of 240 x 320 pixels, and the picture of 320 x 240"},
    {"runs", "coco", lengthen_runs, "the runs of its segmentation have 77040 pixels: expected 76800"},
    {"moved_mask", "coco", move_mask, "bbox_visib is ["},
    {"area", "coco", miscount, "px_count_visib"},
    {"share", "coco", miscount_visible_share, "visib_fract is 0.5"},
    {"twice", "coco", annotate_twice, "is there twice"},
    {"lost_image", "coco", forget_an_image, "missing frame: there is no image"},
    {"lost_half", "coco", forget_an_image, "missing frame: right/000003.png (there is left/000003.png)"},
    {"size", "coco", shrink_listed_size, "expected 640 x 240 pixels (got 320 x 240)"},
    {"box", "bop", move_visible_box, "bbox_visib is ["},
    {"whole_box", "bop", move_whole_box, "bbox_obj is ["},
    {"share", "bop", misstate_share, "visib_fract is 0.25"},
    {"hidden", "bop", hide_ball, "of a hidden ball"},
    {"whole_mask", "bop", cut_whole_mask, "outside of its whole mask"},
    {"lost_object", "bop", forget_an_object, "in scene_gt.json"},
    {"lost_camera", "bop", forget_a_camera, "frame 000004: missing frame: scene_gt.json lists it"},
};

INSTANTIATE_TEST_SUITE_P(Faults, PlantedInSceneList, testing::ValuesIn(kListCases), [](const auto& test) {
  return std::string(test.param.name) + "_in_" + test.param.format;
});

}  // namespace
}  // namespace stereobench::harness
