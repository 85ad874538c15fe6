#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/json_file.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/scene/picture_pairs.h"
#include "harness/verify/readers/scene/run_lengths.h"
#include "harness/verify/readers/scene/scene_json.h"
#include "harness/verify/readers/scene/scene_readers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr std::size_t kMostEntries = 100'000'000;
constexpr std::int64_t kMostId = std::int64_t{1} << 52;

/// An entry of `images`.
struct ListedPicture {
  std::int64_t id = 0;
  std::string name;
  cv::Size size;
  std::vector<ViewBallTruth> shown;
};

/// What a list of instances says.
struct Instances {
  std::string file;
  std::vector<ListedPicture> pictures;
  std::map<std::int64_t, std::size_t> place_of_id;
  std::set<std::int64_t> categories;
};

cv::Rect2d box_of(const JsonValue& list) {
  const std::vector<double> n = numbers_of(list, 4);
  return {n[0], n[1], n[2], n[3]};
}

cv::Rect whole_box(const cv::Rect2d& box) {
  if (!(box.width > 0.0 && box.height > 0.0)) return {};
  const cv::Point first(cvRound(box.x), cvRound(box.y));
  const cv::Point last(cvRound(box.x + box.width), cvRound(box.y + box.height));
  return {first, last};
}

void read_picture_list(DatasetView& view, const JsonValue& json, Instances& all) {
  constexpr std::int64_t kMostSize = 1 << 20;
  for (const JsonValue& entry : json.at("images").list(0, kMostEntries)) {
    ListedPicture picture;
    picture.id = entry.at("id").integer(0, kMostId);
    picture.name = entry.at("file_name").text();
    if (entry.find("width") && entry.find("height"))
      picture.size = {static_cast<int>(entry.at("width").integer(1, kMostSize)),
                      static_cast<int>(entry.at("height").integer(1, kMostSize))};
    if (!all.place_of_id.emplace(picture.id, all.pictures.size()).second)
      view.faults.push_back({all.file, picture.name, fmt::format("image {} is there twice", picture.id)});
    all.pictures.push_back(std::move(picture));
  }
  if (const auto categories = json.find("categories"))
    for (const JsonValue& category : categories->list(0, kMostEntries))
      all.categories.insert(category.at("id").integer(0, kMostId));
}

/// The greatest distance between the sides of a box and those of its polygons, px.
double off_polygons(const JsonValue& polygons, const cv::Rect2d& box) {
  cv::Point2d first(kMostNumber, kMostNumber), last(-kMostNumber, -kMostNumber);
  for (const JsonValue& polygon : polygons.list(1, kMostEntries)) {
    const auto numbers = polygon.list(2, kMostEntries);
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      const double u = number_of(numbers[i]), v = number_of(numbers[i + 1]);
      first = {std::min(first.x, u), std::min(first.y, v)};
      last = {std::max(last.x, u), std::max(last.y, v)};
    }
  }
  return std::max({std::abs(first.x - box.x), std::abs(first.y - box.y), std::abs(last.x - box.x - box.width),
                   std::abs(last.y - box.y - box.height)});
}

/// What the segmentation says; a mask is worked out when it is looked at.
/// @return what is wrong with it; empty where nothing is
std::string read_segmentation(const JsonValue& segmentation, const Instances& all,
                              const ListedPicture& picture, const cv::Rect2d& box, const std::string& what,
                              ViewBallTruth& truth) {
  constexpr double kPolygonSlack_px = 2.0;
  if (!segmentation.find("counts")) {
    if (segmentation.list(0, kMostEntries).empty()) return {};
    const double off_px = off_polygons(segmentation, box);
    return off_px > kPolygonSlack_px ? fmt::format("bbox is {:.3g} px off its polygons", off_px) : "";
  }
  const RunLengths runs = run_lengths_of(segmentation);
  if (!picture.size.empty() && runs.size != picture.size)
    return fmt::format("segmentation is of {} x {} pixels, and the picture of {} x {}", runs.size.width,
                       runs.size.height, picture.size.width, picture.size.height);
  if (runs.pixels() != static_cast<std::int64_t>(runs.size.area()))
    return fmt::format("the runs of its segmentation have {} pixels: expected {} ({} x {})", runs.pixels(),
                       runs.size.area(), runs.size.width, runs.size.height);
  if (truth.px_count_visib == 0) truth.px_count_visib = runs.pixels_of_mask();  // area is left out
  truth.visible_mask = {fmt::format("{}: {}", all.file, what), [runs] { return mask_of(runs); }};
  return {};
}

/// What COCO's own keys and those of BOP say of the same.
std::string contradiction(const JsonValue& entry, const ViewBallTruth& truth) {
  if (const auto visible = entry.find("bbox_visib");
      visible && whole_box(box_of(*visible)) != truth.bbox_visib)
    return "bbox and bbox_visib are two boxes";
  if (const auto count = entry.find("px_count_visib");
      count && count->integer(0, kMostId) != truth.px_count_visib)
    return fmt::format("area is {}, and px_count_visib {}", truth.px_count_visib, count->integer(0, kMostId));
  return {};
}

void read_annotation(DatasetView& view, const JsonValue& entry, Instances& all, std::set<std::int64_t>& ids) {
  const std::int64_t id = entry.at("id").integer(0, kMostId),
                     image = entry.at("image_id").integer(0, kMostId);
  const auto blame = [&](const std::string& frame, const std::string& what) {
    if (!what.empty()) view.faults.push_back({all.file, frame, fmt::format("annotation {}: {}", id, what)});
  };
  if (!ids.insert(id).second) blame("", "its id is there twice");
  const auto place = all.place_of_id.find(image);
  if (place == all.place_of_id.end())
    return blame("", fmt::format("missing frame: there is no image {}", image));
  ListedPicture& picture = all.pictures[place->second];
  const std::int64_t category = entry.at("category_id").integer(0, kMostId);
  if (!all.categories.empty() && !all.categories.contains(category))
    blame(picture.name, fmt::format("there is no category {}", category));
  const auto bbox = entry.find("bbox");
  if (!bbox) return;
  const cv::Rect2d box = box_of(*bbox);
  constexpr double kSlack_px = 1.0;
  if (!(box.width > 0.0 && box.height > 0.0)) blame(picture.name, "an empty bbox");
  if (!picture.size.empty() &&
      (box.x < -kSlack_px || box.y < -kSlack_px || box.x + box.width > picture.size.width + kSlack_px ||
       box.y + box.height > picture.size.height + kSlack_px))
    blame(picture.name,
          fmt::format("bbox [{:g}, {:g}, {:g}, {:g}] reaches out of the picture of {} x {}", box.x, box.y,
                      box.width, box.height, picture.size.width, picture.size.height));
  ViewBallTruth truth;
  const auto ball = entry.find("ball_id");
  truth.ball = static_cast<int>(ball ? ball->integer(0, 1 << 20) : std::ssize(picture.shown));
  truth.bbox_visib = whole_box(box);
  truth.px_count_visib = std::llround(number_or(entry, "area", 0.0));
  truth.box_slack_px = 1;
  if (entry.find("px_count_all")) {
    truth.px_count_all = entry.at("px_count_all").integer(0, kMostId);
    if (const auto share = entry.find("visib_fract")) truth.visib_fract = number_of(*share);
  }
  if (ball && std::ranges::count(picture.shown, truth.ball, &ViewBallTruth::ball) > 0)
    blame(picture.name, fmt::format("ball {} is there twice", truth.ball));
  blame(picture.name, contradiction(entry, truth));
  const auto segmentation = entry.find("segmentation");
  if (segmentation && !segmentation->is_null())
    blame(picture.name,
          read_segmentation(*segmentation, all, picture, box, fmt::format("annotation {}", id), truth));
  picture.shown.push_back(std::move(truth));
}

Instances instances_in(DatasetView& view, const std::string& file) {
  Instances all = {.file = file, .pictures = {}, .place_of_id = {}, .categories = {}};
  read_json_file(view.folder / file, [&](const JsonValue& json) {
    read_picture_list(view, json, all);
    std::set<std::int64_t> ids;
    for (const JsonValue& entry : json.at("annotations").list(0, kMostEntries))
      read_annotation(view, entry, all, ids);
    return 0;
  });
  return all;
}

/// Where the pictures of a list are: COCO has them beside annotations/, in a folder that ends the list's
/// name.
std::optional<std::string> pictures_of(const fs::path& folder, const Instances& all) {
  const std::string stem = fs::path(all.file).stem().string();
  const std::string named = stem.substr(stem.find('_') == std::string::npos ? 0 : stem.find('_') + 1);
  for (const std::string& place : {std::string("images"), named, "images/" + named, std::string(".")})
    for (const ListedPicture& picture : all.pictures)
      if (fs::exists(folder / place / picture.name)) return place;
  return std::nullopt;
}

void add_coco_frames(DatasetView& view, const Instances& all) {
  std::vector<std::string> names;
  for (const ListedPicture& picture : all.pictures) names.push_back(picture.name);
  const std::vector<PicturePair> pairs = picture_pairs(names);
  for (const auto& [missing, there] : missing_halves(pairs, names))
    view.faults.push_back({all.file, "", fmt::format("missing frame: {} (there is {})", missing, there)});
  const auto place = pictures_of(view.folder, all);
  if (!place) view.cannot.push_back(fmt::format("pictures: none of {} is beside it", all.file));
  for (const PicturePair& pair : pairs) {
    ViewFrame frame = {.name = pair.name};
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const std::size_t i = index_of(side);
      if (!pair.place[i]) continue;
      const ListedPicture& picture = all.pictures[*pair.place[i]];
      frame.cameras[i].pinhole.width_px = picture.size.width;
      frame.cameras[i].pinhole.height_px = picture.size.height;
      frame.balls[i] = {all.file, picture.shown};
      if (!place) continue;
      const std::string file = (fs::path(*place) / picture.name).lexically_normal().string();
      add_channel(view, frame, side, Channel::kPicture, file);
      if (!fs::exists(view.folder / file))
        view.faults.push_back({file, pair.name, fmt::format("missing frame: {} lists it", all.file)});
    }
    view.frames.push_back(std::move(frame));
  }
}

/// Lists of instances: those of annotations/, else those beside the pictures that have their keys.
std::vector<std::string> lists_in(const fs::path& folder) {
  std::vector<std::string> lists;
  for (const std::string& stem : stems_in(folder / "annotations", ".json"))
    lists.push_back(fmt::format("annotations/{}.json", stem));
  for (const char* name : {"_annotations.coco.json", "instances.json", "annotations.json"})
    if (lists.empty() && fs::exists(folder / name)) lists.emplace_back(name);
  const auto is_of_instances = [](const std::string& list) {
    return list.find("instances") != std::string::npos;
  };
  if (std::ranges::any_of(lists, is_of_instances))  // captions and key points are of the same pictures
    std::erase_if(lists, [&](const std::string& list) { return !is_of_instances(list); });
  return lists;
}

}  // namespace

bool looks_like_coco(const fs::path& folder) {
  return !lists_in(folder).empty();
}

DatasetView read_coco_view(const fs::path& folder) {
  DatasetView view = {.format = "coco", .folder = folder};
  view.has_calibration = false;
  view.pictures_file = "images";
  std::size_t annotations = 0;
  for (const std::string& list : lists_in(folder)) {
    const Instances all = instances_in(view, list);
    for (const ListedPicture& picture : all.pictures) annotations += picture.shown.size();
    add_coco_frames(view, all);
  }
  view.checked.push_back(fmt::format("{} annotations", annotations));
  view.cannot.push_back("cameras, depth and poses, which the layout has not");
  return view;
}

}  // namespace stereobench::harness
