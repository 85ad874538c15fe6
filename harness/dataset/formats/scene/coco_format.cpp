#include "harness/dataset/formats/scene/coco_format.h"

#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/truth/bop_numbers.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using vision::Side;

/// Lengths of runs, columns first: of other pixels, of those of the identity, and so on.
Json run_lengths(const cv::Mat& ball_id, int identity) {
  Json runs = Json::array();
  long length = 0;
  bool in_ball = false;
  for (int column = 0; column < ball_id.cols; ++column)
    for (int row = 0; row < ball_id.rows; ++row, ++length) {
      if ((ball_id.at<std::uint8_t>(row, column) == identity) == in_ball) continue;
      runs.push_back(length);
      length = 0;
      in_ball = !in_ball;
    }
  runs.push_back(length);
  return runs;
}

Json categories_of(const worlds::World& world) {
  std::set<int> colours;
  for (const worlds::Ball& ball : world.balls) colours.insert(ball.colour);
  Json categories = Json::array();
  for (const int colour : colours)
    categories.push_back(
        {{"id", colour + 1}, {"name", fmt::format("ball_{}", colour)}, {"supercategory", "ball"}});
  return categories;
}

class CocoWriter final : public DatasetWriter {
 public:
  explicit CocoWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    std::vector<DatasetFile> files;
    for (const Side side : kBothSides) {
      const std::string name =
          fmt::format("{}/{:06}.png", side == Side::kLeft ? "left" : "right", pair.step());
      add_picture(pair, side, name);
      files.push_back(camera_file("images/" + name, pair, side));
    }
    return files;
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override {
    const std::string name = fmt::format("annotations/instances_{}_{}.json", drive_.name, drive_.seed);
    return {text_file(
        name, json_text({{"info", {{"description", fmt::format("{}, seed {}", drive_.name, drive_.seed)}}},
                         {"licenses", Json::array()},
                         {"categories", categories_of(drive_.world)},
                         {"images", pictures_},
                         {"annotations", annotations_}}))};
  }

 private:
  void add_picture(DatasetPair& pair, Side side, const std::string& name) const;
  Json annotation(const renderer::BallTruth& truth, const cv::Mat& ball_id, std::size_t picture) const;

  const DatasetDrive& drive_;
  /// Of the pairs so far: COCO has one list of all.
  mutable Json pictures_ = Json::array(), annotations_ = Json::array();
};

void CocoWriter::add_picture(DatasetPair& pair, Side side, const std::string& name) const {
  const vision::Intrinsics& camera = drive_.rig.intrinsics;
  const std::size_t picture = 2 * pair.step() + (side == Side::kLeft ? 1 : 2);
  pictures_.push_back(
      {{"id", picture}, {"file_name", name}, {"width", camera.width_px}, {"height", camera.height_px}});
  const cv::Mat ball_id = pair.ball_id(side);
  for (const renderer::BallTruth& truth : pair.balls(side))
    if (truth.px_count_visib > 0) annotations_.push_back(annotation(truth, ball_id, picture));
}

Json CocoWriter::annotation(const renderer::BallTruth& truth, const cv::Mat& ball_id,
                            std::size_t picture) const {
  const int colour = drive_.world.balls[static_cast<std::size_t>(truth.ball)].colour;
  Json json = {{"id", annotations_.size() + 1},
               {"image_id", picture},
               {"category_id", colour + 1},
               {"bbox", bop_box(truth.bbox_visib)},
               {"area", truth.px_count_visib},
               {"iscrowd", 0},
               {"segmentation",
                {{"size", {ball_id.rows, ball_id.cols}}, {"counts", run_lengths(ball_id, truth.ball + 1)}}},
               {"ball_id", truth.ball}};
  json.update(bop_numbers(truth));
  json["truncated"] = truth.truncated;
  return json;
}

}  // namespace

void check_coco_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"coco", "balls whose outlines are ellipses"};
  limits.require_undistorted(drive);
  limits.require_whole_pictures(drive);
}

std::unique_ptr<DatasetWriter> coco_writer(const DatasetDrive& drive) {
  return std::make_unique<CocoWriter>(drive);
}

}  // namespace stereobench::harness
