#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/text_file.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/scene/picture_pairs.h"
#include "harness/verify/readers/scene/scene_readers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

/// Where the parameters of a model of cameras stand; -1 is none.
struct CameraModel {
  std::string_view name;
  std::size_t count;
  int fx, fy, cx, cy, k1, k2, p1, p2, k3;
};

constexpr std::array kModels = {CameraModel{"SIMPLE_PINHOLE", 3, 0, 0, 1, 2, -1, -1, -1, -1, -1},
                                CameraModel{"PINHOLE", 4, 0, 1, 2, 3, -1, -1, -1, -1, -1},
                                CameraModel{"SIMPLE_RADIAL", 4, 0, 0, 1, 2, 3, -1, -1, -1, -1},
                                CameraModel{"RADIAL", 5, 0, 0, 1, 2, 3, 4, -1, -1, -1},
                                CameraModel{"OPENCV", 8, 0, 1, 2, 3, 4, 5, 6, 7, -1},
                                CameraModel{"FULL_OPENCV", 12, 0, 1, 2, 3, 4, 5, 6, 7, 8}};

/// A picture of images.txt.
struct ModelPicture {
  std::string name;
  std::string number;
  std::string camera;
  ViewPose pose;                     ///< world_from_camera
  std::vector<std::string> points;   ///< all, in order
  std::vector<ViewBallTruth> shown;  ///< of those that are points of the model
};

struct Model {
  fs::path place;  ///< of the three files, in the folder
  std::map<std::string, ViewCamera> cameras;
  std::vector<ModelPicture> pictures;
  std::map<std::string, int> points;  ///< their place in DatasetView::balls
  std::vector<std::string> numbers_of_poses;
};

std::vector<std::string> words_of_line(const std::string& line) {
  std::istringstream words(line);
  return {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()};
}

[[noreturn]] void refuse_line(const fs::path& file, long line, std::string_view expected) {
  throw std::runtime_error(fmt::format("{}: line {}: expected {}", file.string(), line, expected));
}

/// Words from one on as finite numbers.
std::vector<double> numbers_from(const std::vector<std::string>& words, std::size_t first, std::size_t count,
                                 const fs::path& file, long line) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < first + count; ++i) {
    std::istringstream word(i < words.size() ? words[i] : "");
    word.imbue(std::locale::classic());
    double number = 0.0;
    if (!(word >> number) || word.peek() != std::istringstream::traits_type::eof())
      refuse_line(file, line, fmt::format("a number as word {}", i + 1));
    numbers.push_back(number);
  }
  return numbers;
}

/// Lines of a file with their numbers; comments are left out.
std::vector<std::pair<long, std::string>> lines_in(const fs::path& file) {
  std::istringstream stream(read_text(file));
  std::vector<std::pair<long, std::string>> lines;
  long number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (!line.starts_with('#')) lines.emplace_back(number, line);
  }
  return lines;
}

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

ViewCamera camera_of(const CameraModel& model, const std::vector<double>& n, int width_px, int height_px) {
  const auto at = [&](int place) { return place < 0 ? 0.0 : n[static_cast<std::size_t>(place)]; };
  ViewCamera camera;
  camera.pinhole = {width_px, height_px, at(model.fx), at(model.cx) - kFirstPixel_px,
                    at(model.cy) - kFirstPixel_px};
  camera.lens = {
      .k1 = at(model.k1), .k2 = at(model.k2), .p1 = at(model.p1), .p2 = at(model.p2), .k3 = at(model.k3)};
  camera.lens.pixel_aspect = at(model.fy) / at(model.fx);
  return camera;
}

void read_cameras(DatasetView& view, const fs::path& file, Model& model) {
  for (const auto& [line, text] : lines_in(file)) {
    if (is_blank(text)) continue;
    const std::vector<std::string> words = words_of_line(text);
    if (words.size() < 4) refuse_line(file, line, "CAMERA_ID, MODEL, WIDTH, HEIGHT and parameters");
    const auto* const known = std::ranges::find(kModels, words[1], &CameraModel::name);
    const std::vector<double> size = numbers_from(words, 2, 2, file, line);
    const std::vector<double> n =
        numbers_from(words, 4, known == kModels.end() ? 0 : known->count, file, line);
    const bool is_known = known != kModels.end() && n[0] > 0.0 &&
                          std::ranges::all_of(n.begin() + std::min<std::ptrdiff_t>(9, std::ssize(n)), n.end(),
                                              [](double k) { return k == 0.0; });
    if (is_known) {
      model.cameras[words[0]] = camera_of(*known, n, static_cast<int>(size[0]), static_cast<int>(size[1]));
    } else {
      view.has_calibration = false;
      view.cannot.push_back(fmt::format("points against poses: the camera model {} is not read", words[1]));
      model.cameras[words[0]].pinhole.width_px = static_cast<int>(size[0]);
      model.cameras[words[0]].pinhole.height_px = static_cast<int>(size[1]);
    }
  }
}

ModelPicture picture_of(const std::string& text, const fs::path& file, long line, Model& model) {
  constexpr std::size_t kName = 9;
  const std::vector<std::string> words = words_of_line(text);
  if (words.size() <= kName) refuse_line(file, line, "IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME");
  const std::vector<double> n = numbers_from(words, 1, 7, file, line);
  model.numbers_of_poses.insert(model.numbers_of_poses.end(), words.begin() + 5, words.begin() + 8);
  ModelPicture picture;
  picture.number = words[0], picture.camera = words[8];
  picture.name = words[kName];
  for (std::size_t i = kName + 1; i < words.size(); ++i) picture.name += " " + words[i];
  const Eigen::Quaterniond turn(n[0], n[1], n[2], n[3]);
  picture.pose.quaternion_norm = turn.norm();
  if (!(turn.norm() > 0.0)) refuse_line(file, line, "a quaternion that is not 0");
  Eigen::Isometry3d camera_from_world = Eigen::Isometry3d::Identity();
  camera_from_world.linear() = turn.normalized().toRotationMatrix();
  camera_from_world.translation() << n[4], n[5], n[6];
  picture.pose.matrix = camera_from_world.inverse().matrix();
  picture.pose.line = line;
  return picture;
}

void read_pictures(const fs::path& file, Model& model) {
  const auto lines = lines_in(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_blank(lines[i].second)) continue;
    ModelPicture picture = picture_of(lines[i].second, file, lines[i].first, model);
    // The next line lists the points that it shows, and may be empty.
    if (++i < lines.size()) {
      const std::vector<std::string> words = words_of_line(lines[i].second);
      if (words.size() % 3 != 0) refuse_line(file, lines[i].first, "three words a point: X, Y, POINT3D_ID");
      for (std::size_t word = 0; word < words.size(); word += 3) {
        picture.points.push_back(words[word + 2]);
        const auto point = model.points.find(words[word + 2]);
        if (point == model.points.end()) continue;
        const std::vector<double> at = numbers_from(words, word, 2, file, lines[i].first);
        ViewBallTruth truth;
        truth.ball = point->second;
        truth.centre_px = {at[0] - kFirstPixel_px, at[1] - kFirstPixel_px};
        picture.shown.push_back(truth);
      }
    }
    model.pictures.push_back(std::move(picture));
  }
}

/// A point's track: which pictures show it, and where in their lists.
struct Track {
  std::string point;
  long line = 0;
  std::vector<std::pair<std::string, std::size_t>> places;
};

std::vector<Track> read_points(DatasetView& view, const fs::path& file, Model& model) {
  constexpr std::size_t kTrack = 8;
  constexpr double kUnknownError_px = 1.0;  // COLMAP writes -1 where it has not worked the error out
  std::vector<Track> tracks;
  for (const auto& [line, text] : lines_in(file)) {
    if (is_blank(text)) continue;
    const std::vector<std::string> words = words_of_line(text);
    if (words.size() < kTrack || words.size() % 2 != 0)
      refuse_line(file, line, "POINT3D_ID, X, Y, Z, R, G, B, ERROR and pairs of IMAGE_ID and POINT2D_IDX");
    const std::vector<double> n = numbers_from(words, 1, 7, file, line);
    model.points[words[0]] = static_cast<int>(view.balls.size());
    view.balls.push_back({{n[0], n[1], n[2]}, 0.0, n[6] < 0.0 ? kUnknownError_px : n[6]});
    model.numbers_of_poses.insert(model.numbers_of_poses.end(), words.begin() + 1, words.begin() + 4);
    tracks.push_back({words[0], line, {}});
    for (std::size_t i = kTrack; i < words.size(); i += 2)
      tracks.back().places.emplace_back(
          words[i], static_cast<std::size_t>(numbers_from(words, i + 1, 1, file, line)[0]));
  }
  return tracks;
}

/// Tracks against the lists of the pictures, in both directions.
void compare_tracks(DatasetView& view, const Model& model, const std::vector<Track>& tracks,
                    const std::string& pictures_file, const std::string& points_file) {
  std::map<std::string, const ModelPicture*> by_number;
  for (const ModelPicture& picture : model.pictures) by_number[picture.number] = &picture;
  std::map<std::string, std::size_t> tracked;
  std::set<std::string> missing, wrong;
  for (const Track& track : tracks)
    for (const auto& [number, place] : track.places) {
      const auto picture = by_number.find(number);
      if (picture == by_number.end()) {
        if (missing.insert(number).second)
          view.faults.push_back(
              {pictures_file, "",
               fmt::format("missing frame: line {} of {} says that picture {} shows a point", track.line,
                           points_file, number)});
        continue;
      }
      ++tracked[number];
      const std::vector<std::string>& points = picture->second->points;
      if ((place >= points.size() || points[place] != track.point) && wrong.insert(number).second)
        view.faults.push_back({points_file, picture->second->name,
                               fmt::format("line {}: point {} is not number {} of the picture's points in {}",
                                           track.line, track.point, place, pictures_file)});
    }
  for (const ModelPicture& picture : model.pictures) {
    const auto listed = static_cast<std::size_t>(
        std::ranges::count_if(picture.points, [](const std::string& point) { return point != "-1"; }));
    if (!wrong.contains(picture.number) && listed != tracked[picture.number])
      view.faults.push_back(
          {pictures_file, picture.name,
           fmt::format("line {}: it shows {} points, and {} tracks of {} lead to it", picture.pose.line + 1,
                       listed, tracked[picture.number], points_file)});
  }
  view.checked.push_back("tracks of points against the pictures that show them");
}

void add_frames(DatasetView& view, const Model& model) {
  std::vector<std::string> names;
  for (const ModelPicture& picture : model.pictures) names.push_back(picture.name);
  for (const PicturePair& pair : picture_pairs(names)) {
    ViewFrame frame = {.name = pair.name};
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const std::size_t i = index_of(side);
      if (!pair.place[i]) continue;
      const ModelPicture& picture = model.pictures[*pair.place[i]];
      const auto camera = model.cameras.find(picture.camera);
      if (camera == model.cameras.end())
        view.faults.push_back({view.poses_file, picture.name,
                               fmt::format("line {}: {} has no camera {}", picture.pose.line,
                                           view.calibration_file, picture.camera)});
      else
        frame.cameras[i] = camera->second;
      frame.world_from_body[i] = as_rigid(picture.pose.matrix);
      const std::string file = fmt::format("images/{}", picture.name);
      add_channel(view, frame, side, Channel::kPicture, file);
      if (fs::exists(view.folder / "images") && !fs::exists(view.folder / file))
        view.faults.push_back({file, pair.name, fmt::format("missing frame: {} lists it", view.poses_file)});
      frame.balls[i] = {view.poses_file, picture.shown};
    }
    view.frames.push_back(std::move(frame));
  }
}

/// The folder of a model, "sparse/0"; empty without one.
/// @param ending ".txt" or ".bin"
std::optional<fs::path> model_in(const fs::path& folder, const char* ending) {
  for (const char* place : {"sparse/0", "sparse", "."})
    if (fs::exists(folder / place / fmt::format("images{}", ending)) &&
        fs::exists(folder / place / fmt::format("cameras{}", ending)))
      return fs::path(place);
  return std::nullopt;
}

}  // namespace

bool looks_like_colmap(const fs::path& folder) {
  return model_in(folder, ".txt") || model_in(folder, ".bin");
}

DatasetView read_colmap_view(const fs::path& folder) {
  const auto place = model_in(folder, ".txt");
  if (!place)
    throw std::runtime_error(
        fmt::format("{}: expected a model as text, cameras.txt and images.txt: where it is one of bytes "
                    "(.bin), write it by "
                    "colmap model_converter --output_type TXT",
                    (folder / model_in(folder, ".bin").value_or("sparse/0")).string()));
  DatasetView view = {.format = "colmap", .folder = folder};
  const auto file = [&](const char* name) { return (*place / name).lexically_normal().string(); };
  view.calibration_file = file("cameras.txt");
  view.poses_file = file("images.txt");
  view.pictures_file = "images";
  view.poses_of = PosesOf::kEachCamera;
  view.poses_are_a_way = false;
  Model model;
  std::vector<Track> tracks;
  read_or_blame(view, view.calibration_file,
                [&] { read_cameras(view, folder / view.calibration_file, model); });
  const std::string points = file("points3D.txt");
  const bool has_points = fs::exists(folder / points);
  if (has_points) read_or_blame(view, points, [&] { tracks = read_points(view, folder / points, model); });
  read_or_blame(view, view.poses_file, [&] { read_pictures(folder / view.poses_file, model); });
  for (const ModelPicture& picture : model.pictures) {
    view.poses.push_back(picture.pose);
    view.poses.back().file = view.poses_file;
  }
  view.place_precision_m = precision_of(model.numbers_of_poses);
  if (has_points && !model.pictures.empty()) compare_tracks(view, model, tracks, view.poses_file, points);
  add_frames(view, model);
  view.cannot.push_back("depth, which the layout has not");
  return view;
}

}  // namespace stereobench::harness
