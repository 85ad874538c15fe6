#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/io/json_file.h"
#include "harness/io/picture_reader.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/scene/scene_json.h"
#include "harness/verify/readers/scene/scene_readers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr double kMetres = 1e-3;
constexpr std::size_t kMostObjects = 10'000;
constexpr std::int64_t kMostCount = std::int64_t{1} << 40;

/// An object in a picture.
struct SeenObject {
  std::int64_t object = 0;
  ViewBallTruth truth;
};

/// A picture of a scene.
struct ScenePicture {
  ViewCamera camera;
  double depth_step_m = 0.0;
  std::optional<Eigen::Isometry3d> world_from_camera;
  std::vector<SeenObject> objects;
};

/// A scene of one split: SPLIT/000000/.
struct Scene {
  std::string folder;
  std::map<int, ScenePicture> pictures;
};

/// Calls a function for each entry of a file whose keys are numbers of pictures.
template <class Read>
void for_each_picture(const fs::path& file, const Read& read) {
  read_json_file(file, [&](const JsonValue& json) {
    for (const auto& [key, value] : json.entries()) {
      if (key.empty() || key.find_first_not_of("0123456789") != std::string::npos || key.size() > 9)
        value.refuse("a number of a picture as key");
      read(std::stoi(key), value);
    }
    return 0;
  });
}

void read_camera(const JsonValue& json, ScenePicture& picture, std::vector<std::string>& digits) {
  const std::vector<double> k = numbers_of(json.at("cam_K"), 9);
  if (!(k[0] > 0.0)) json.at("cam_K").refuse("a focal length first");
  picture.camera.pinhole = {0, 0, k[0], k[2], k[5]};
  picture.camera.lens.pixel_aspect = k[4] / k[0];
  picture.depth_step_m = kMetres * number_or(json, "depth_scale", 1.0);
  const auto turn = json.find("cam_R_w2c"), place = json.find("cam_t_w2c");
  if (!turn || !place) return;
  picture.world_from_camera = pose_of(numbers_of(*turn, 9), numbers_of(*place, 3, &digits)).inverse();
  picture.world_from_camera->translation() *= kMetres;
}

void read_objects(const JsonValue& json, ScenePicture& picture) {
  for (const JsonValue& entry : json.list(0, kMostObjects)) {
    SeenObject object;
    object.object = entry.at("obj_id").integer(0, kMostCount);
    const std::vector<double> place = numbers_of(entry.at("cam_t_m2c"), 3);
    object.truth.centre_in_camera_m = kMetres * Eigen::Vector3d(place[0], place[1], place[2]);
    object.truth.box_slack_px = 1;
    picture.objects.push_back(std::move(object));
  }
}

cv::Rect box_of(const JsonValue& json, const char* key) {
  const auto list = json.find(key);
  if (!list) return {};
  const std::vector<double> n = numbers_of(*list, 4);
  if (!(n[2] > 0.0 && n[3] > 0.0)) return {};
  return {cvRound(n[0]), cvRound(n[1]), cvRound(n[2]), cvRound(n[3])};
}

void read_numbers(const JsonValue& json, ViewBallTruth& truth) {
  truth.px_count_all = json.at("px_count_all").integer(0, kMostCount);
  truth.px_count_visib = json.at("px_count_visib").integer(0, kMostCount);
  truth.visib_fract = number_of(json.at("visib_fract"));
  truth.bbox_obj = box_of(json, "bbox_obj");
  truth.bbox_visib = box_of(json, "bbox_visib");
}

/// A picture of 0 and 255.
std::optional<ViewMask> mask_in(const DatasetView& view, const std::string& file) {
  const fs::path path = view.folder / file;
  if (!fs::exists(path)) return std::nullopt;
  return ViewMask{file, [path] {
                    cv::Mat mask = read_levels(path);
                    if (mask.type() == CV_8UC3) cv::cvtColor(mask, mask, cv::COLOR_BGR2GRAY);
                    return mask;
                  }};
}

/// scene_gt_info.json and masks, entry by entry with scene_gt.json.
void read_infos(DatasetView& view, Scene& scene) {
  const std::string file = scene.folder + "/scene_gt_info.json";
  if (!fs::exists(view.folder / file)) return;
  read_or_blame(view, file, [&] {
    std::set<int> there;
    for_each_picture(view.folder / file, [&](int number, const JsonValue& json) {
      there.insert(number);
      std::vector<SeenObject>& objects = scene.pictures[number].objects;
      const auto entries = json.list(0, kMostObjects);
      if (entries.size() != objects.size())
        view.faults.push_back(
            {file, fmt::format("{:06}", number),
             fmt::format("{} objects, and {} in scene_gt.json", entries.size(), objects.size())});
      for (std::size_t i = 0; i < std::min(entries.size(), objects.size()); ++i) {
        ViewBallTruth& truth = objects[i].truth;
        read_numbers(entries[i], truth);
        const std::string mask = fmt::format("{:06}_{:06}.png", number, i);
        truth.visible_mask = mask_in(view, fmt::format("{}/mask_visib/{}", scene.folder, mask));
        truth.whole_mask = mask_in(view, fmt::format("{}/mask/{}", scene.folder, mask));
        for (const auto& [folder, is_there] : {std::pair("mask_visib", truth.visible_mask.has_value()),
                                               std::pair("mask", truth.whole_mask.has_value())})
          if (!is_there && fs::exists(view.folder / scene.folder / folder))
            view.faults.push_back({fmt::format("{}/{}/{}", scene.folder, folder, mask),
                                   fmt::format("{:06}", number), "missing mask: scene_gt.json lists it"});
      }
    });
    for (const auto& [number, picture] : scene.pictures)
      if (!there.contains(number))
        view.faults.push_back(
            {file, fmt::format("{:06}", number), "missing frame: scene_camera.json lists it"});
  });
}

Scene scene_in(DatasetView& view, const std::string& folder, std::vector<std::string>& digits) {
  Scene scene = {.folder = folder, .pictures = {}};
  const std::string cameras = folder + "/scene_camera.json", poses = folder + "/scene_gt.json";
  view.calibration_file = view.poses_file = cameras;
  read_or_blame(view, cameras, [&] {
    for_each_picture(view.folder / cameras, [&](int number, const JsonValue& json) {
      read_camera(json, scene.pictures[number], digits);
    });
  });
  if (fs::exists(view.folder / poses))
    read_or_blame(view, poses, [&] {
      for_each_picture(view.folder / poses, [&](int number, const JsonValue& json) {
        const auto picture = scene.pictures.find(number);
        if (picture == scene.pictures.end())
          view.faults.push_back(
              {cameras, fmt::format("{:06}", number), "missing frame: scene_gt.json lists it"});
        else
          read_objects(json, picture->second);
      });
      read_infos(view, scene);
    });
  return scene;
}

/// The radii of objects that are spheres: round about three axes.
std::map<std::int64_t, double> radii_in(DatasetView& view) {
  const std::string file = "models/models_info.json";
  std::map<std::int64_t, double> radii;
  if (fs::exists(view.folder / file))
    read_or_blame(view, file, [&] {
      for_each_picture(view.folder / file, [&](int object, const JsonValue& json) {
        const auto symmetries = json.find("symmetries_continuous");
        if (symmetries && symmetries->list(0, kMostObjects).size() == 3)
          radii[object] = 0.5 * kMetres * number_of(json.at("diameter"));
      });
    });
  return radii;
}

/// The file of a picture, whose ending the layout leaves open. @return empty without one
std::string find_file(const DatasetView& view, const std::string& folder, const char* kind,
                      const std::string& name) {
  for (const char* ending : {".png", ".jpg", ".tif"}) {
    std::string file = fmt::format("{}/{}/{}{}", folder, kind, name, ending);
    if (fs::exists(view.folder / file)) return file;
  }
  return {};
}

/// Which pixel shows which object: its number in DatasetView::balls and one.
/// @param shown numbers and masks; of two that overlap, the last one counts
cv::Mat identities_of(const std::vector<std::pair<int, ViewMask>>& shown) {
  cv::Mat ids;
  for (const auto& [ball, mask] : shown) {
    const cv::Mat pixels = mask.read();
    if (ids.empty()) ids = cv::Mat::zeros(pixels.size(), CV_8UC1);
    if (pixels.size() == ids.size()) ids.setTo(ball + 1, pixels);
  }
  return ids;
}

/// Objects by their numbers in DatasetView::balls. One that a picture shows twice has no number: nobody says
/// which of the two is which in another picture.
class ObjectNumbers {
 public:
  ObjectNumbers(DatasetView& view) : view_(&view), radii_(radii_in(view)) {}

  void number(std::vector<SeenObject>& objects) {
    for (SeenObject& object : objects) {
      object.truth.ball = static_cast<int>(&object - objects.data());
      if (std::ranges::count(objects, object.object, &SeenObject::object) > 1) object.truth.ball = -1;
    }
    for (SeenObject& object : objects)
      if (object.truth.ball >= 0) object.truth.ball = number_of_object(object.object);
  }

 private:
  int number_of_object(std::int64_t object) {
    const auto [known, is_new] = numbers_.try_emplace(object, static_cast<int>(view_->balls.size()));
    if (is_new) {
      const auto radius = radii_.find(object);
      view_->balls.push_back({Eigen::Vector3d::Zero(), radius == radii_.end() ? 0.0 : radius->second, 0.0});
    }
    return known->second;
  }

  DatasetView* view_;
  std::map<std::int64_t, double> radii_;
  std::map<std::int64_t, int> numbers_;
};

void add_identities(const DatasetView& view, ViewFrame& frame, Side side, const ScenePicture& picture) {
  constexpr int kMostLevels = 255;
  std::vector<std::pair<int, ViewMask>> shown;
  for (const SeenObject& object : picture.objects) {
    const int ball = object.truth.ball;
    if (ball >= 0 && ball < kMostLevels && object.truth.visible_mask &&
        view.balls[static_cast<std::size_t>(ball)].radius_m > 0.0)
      shown.emplace_back(ball, *object.truth.visible_mask);
  }
  if (shown.empty()) return;
  frame.channels[index_of(side)][Channel::kBallId] = {shown.front().second.file, 0.0,
                                                      [shown] { return identities_of(shown); }};
}

void add_picture(DatasetView& view, const Scene& scene, int number, Side side, ViewFrame& frame) {
  const ScenePicture& picture = scene.pictures.at(number);
  const std::size_t i = index_of(side);
  const std::string name = fmt::format("{:06}", number);
  frame.cameras[i] = picture.camera;
  frame.world_from_body[i] = picture.world_from_camera;
  std::string file = find_file(view, scene.folder, "rgb", name);
  if (file.empty()) file = find_file(view, scene.folder, "gray", name);
  if (!file.empty()) add_channel(view, frame, side, Channel::kPicture, file);
  const std::string depth = find_file(view, scene.folder, "depth", name);
  if (depth.ends_with(".png")) add_channel(view, frame, side, Channel::kDepth, depth, picture.depth_step_m);
  for (const auto& [kind, found] : {std::pair("rgb", file), std::pair("depth", depth)})
    if (found.empty() && fs::exists(view.folder / scene.folder / kind))
      view.faults.push_back({fmt::format("{}/{}/{}.png", scene.folder, kind, name), frame.name,
                             "missing frame: scene_camera.json lists it"});
  frame.balls[i] = {scene.folder + "/scene_gt_info.json", {}};
  for (const SeenObject& object : picture.objects) frame.balls[i]->balls.push_back(object.truth);
  add_identities(view, frame, side, picture);
  if (!picture.world_from_camera) return;
  view.poses.push_back({.file = scene.folder + "/scene_camera.json", .line = 0, .stamp_ns = {}});
  view.poses.back().name = name;
  view.poses.back().matrix = picture.world_from_camera->matrix();
}

/// @param scenes the left camera's, and the right one's, whose folder is empty where there is none
void add_scene(DatasetView& view, std::array<Scene, 2>& scenes, ObjectNumbers& objects) {
  std::set<int> numbers;
  for (Scene& scene : scenes)
    for (auto& [number, picture] : scene.pictures) {
      numbers.insert(number);
      objects.number(picture.objects);
    }
  for (const int number : numbers) {
    ViewFrame frame = {.name =
                           fmt::format("{}/{:06}", fs::path(scenes[0].folder).filename().string(), number)};
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Scene& scene = scenes[index_of(side)];
      if (scene.pictures.contains(number))
        add_picture(view, scene, number, side, frame);
      else if (!scene.folder.empty())
        view.faults.push_back({scene.folder + "/scene_camera.json", frame.name,
                               "missing frame: the other camera's scene has it"});
    }
    view.frames.push_back(std::move(frame));
  }
  if (!view.frames.empty()) view.frames.back().drive_goes_on = false;
}

/// The scenes of a split, "000000".
std::set<std::string> scenes_of(const fs::path& split) {
  std::set<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(split, none))
    if (fs::exists(entry.path() / "scene_camera.json")) names.insert(entry.path().filename().string());
  return names;
}

std::map<std::string, std::set<std::string>> splits_of(const fs::path& folder) {
  std::map<std::string, std::set<std::string>> splits;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.is_directory())
      if (std::set<std::string> scenes = scenes_of(entry.path()); !scenes.empty())
        splits[entry.path().filename().string()] = std::move(scenes);
  return splits;
}

}  // namespace

bool looks_like_bop(const fs::path& folder) {
  return !splits_of(folder).empty();
}

DatasetView read_bop_view(const fs::path& folder) {
  DatasetView view = {.format = "bop", .folder = folder};
  view.poses_of = PosesOf::kEachCamera;
  view.poses_are_a_way = false;
  view.balls_have_places = false;
  view.depth_file = "depth";
  view.pictures_file = "rgb";
  const std::string kLeft = "_left", kRight = "_right";
  std::vector<std::string> digits;
  ObjectNumbers objects(view);
  const auto splits = splits_of(folder);
  const auto mate_of = [&](const std::string& split, const std::string& from, const std::string& to) {
    const bool is_one = split.ends_with(from);
    const std::string mate = is_one ? split.substr(0, split.size() - from.size()) + to : "";
    return is_one && splits.contains(mate) ? mate : std::string();
  };
  for (const auto& [split, names] : splits) {
    if (!mate_of(split, kRight, kLeft).empty()) continue;
    const std::string mate = mate_of(split, kLeft, kRight);
    for (const std::string& name : names) {
      std::array<Scene, 2> scenes = {scene_in(view, fmt::format("{}/{}", split, name), digits), Scene()};
      if (!mate.empty() && splits.at(mate).contains(name))
        scenes[1] = scene_in(view, fmt::format("{}/{}", mate, name), digits);
      add_scene(view, scenes, objects);
    }
  }
  view.place_precision_m = kMetres * precision_of(digits);
  if (view.balls.empty()) view.cannot.push_back("places of objects: there is no scene_gt.json");
  return view;
}

}  // namespace stereobench::harness
