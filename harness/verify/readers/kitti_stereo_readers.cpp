#include <cmath>

#include <fmt/format.h>

#include "harness/verify/channel_files.h"
#include "harness/verify/readers/kitti_calibration.h"
#include "harness/verify/readers/kitti_readers.h"
#include "harness/verify/readers/reader_tools.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;
using Numbers = std::map<std::string, std::vector<double>>;

constexpr double kDisparityLevel_px = 1.0 / 256.0, kFlowLevel_px = 1.0 / 64.0;
constexpr const char* kEnding = "_10.png";

/// The layout's folders.
struct KittiFolders {
  std::string_view format;
  std::array<std::string, 2> pictures;
  std::vector<std::string> others;  ///< that have a file a frame, where they are there
  std::string disparity;
};

const KittiFolders k2015 = {"kitti-stereo",
                            {"image_2", "image_3"},
                            {"disp_noc_0", "disp_occ_0", "disp_occ_1", "disp_noc_1"},
                            "disp_occ_0"};
const KittiFolders kSceneFlow = {
    "kitti-scene-flow",
    {"image_2", "image_3"},
    {"disp_noc_0", "disp_occ_0", "disp_occ_1", "disp_noc_1", "flow_occ", "flow_noc"},
    "disp_occ_0"};
const KittiFolders k2012 = {"kitti-stereo-2012",
                            {"colored_0", "colored_1"},
                            {"disp_noc", "disp_occ", "image_0", "image_1"},
                            "disp_occ"};

/// What pixels have that the other picture shows too, and what all have.
constexpr std::array kParts = {std::pair("disp_noc", "disp_occ"), std::pair("disp_noc_0", "disp_occ_0"),
                               std::pair("disp_noc_1", "disp_occ_1"), std::pair("flow_noc", "flow_occ")};

void add_part(const DatasetView& view, ViewFrame& frame, const std::string& part, const std::string& whole) {
  const auto file_of = [&](const std::string& kind) {
    const std::string file = fmt::format("{}/{}{}", kind, frame.name, kEnding);
    const bool is_flow = kind.starts_with("flow");
    const double step = is_flow ? kFlowLevel_px : kDisparityLevel_px;
    return ChannelFile{file, step, [path = view.folder / file, is_flow, step] {
                         return read_channel(path, is_flow ? Channel::kFlow : Channel::kDisparity, step);
                       }};
  };
  std::pair<ChannelFile, ChannelFile> files = {file_of(part), file_of(whole)};
  if (fs::exists(view.folder / files.first.file) && fs::exists(view.folder / files.second.file))
    frame.parts.push_back(std::move(files));
}

fs::path root_of(const fs::path& folder) {
  return fs::is_directory(folder / "training") ? folder / "training" : folder;
}

bool is_nothing(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return number == 0.0; });
}

/// calib_cam_to_cam/ against calib/, and within itself what two cameras without lenses and turns say twice.
void compare_calibrations(DatasetView& view, const std::string& file, const ViewFrame& frame) {
  constexpr double kRounding = 1e-5;
  const Numbers numbers = keyed_numbers(view.folder / file);
  for (std::size_t i = 0; i < 2; ++i) {
    const ViewCamera other = projected_camera(view.folder / file, numbers, fmt::format("P_rect_0{}", i + 2));
    const ViewCamera& camera = frame.cameras[i];
    if (std::abs(other.pinhole.focal_px - camera.pinhole.focal_px) > kRounding * camera.pinhole.focal_px ||
        std::abs(other.pinhole.cx_px - camera.pinhole.cx_px) > kRounding * camera.pinhole.focal_px)
      view.faults.push_back(
          {file, frame.name,
           fmt::format("P_rect_0{}: focal length {} px and principal point {} px, and {} px and {} px "
                       "in {}",
                       i + 2, other.pinhole.focal_px, other.pinhole.cx_px, camera.pinhole.focal_px,
                       camera.pinhole.cx_px, view.calibration_file)});
  }
  const auto lens = numbers.find("D_03"), place = numbers.find("T_03"), left = numbers.find("T_02");
  if (lens == numbers.end() || !is_nothing(lens->second)) return;
  if (place == numbers.end() || place->second.size() != 3 || left == numbers.end() ||
      left->second.size() != 3)
    return;
  const double by_place_m = left->second[0] - place->second[0];
  const double by_projection_m =
      (frame.cameras[1].body_from_camera.translation() - frame.cameras[0].body_from_camera.translation()).x();
  if (std::abs(by_place_m - by_projection_m) > kRounding * std::abs(by_place_m))
    view.faults.push_back(
        {view.calibration_file, frame.name,
         fmt::format("baseline: {:.6g} m by P3, {:.6g} m by T_03 of {}: {:+.3g} %", by_projection_m,
                     by_place_m, file, 100.0 * (by_projection_m / by_place_m - 1.0))});
}

void read_calibration_of(DatasetView& view, ViewFrame& frame) {
  const std::string own = fmt::format("calib/{}.txt", frame.name);
  const std::string all = fmt::format("calib_cam_to_cam/{}.txt", frame.name);
  const bool has_own = fs::exists(view.folder / own), has_all = fs::exists(view.folder / all);
  if (!has_own && !has_all) {
    view.faults.push_back({own, frame.name, "missing calibration of a frame"});
    return;
  }
  view.calibration_file = has_own ? own : all;
  read_or_blame(view, view.calibration_file, [&] {
    const Numbers numbers = keyed_numbers(view.folder / view.calibration_file);
    for (std::size_t i = 0; i < 2; ++i)
      frame.cameras[i] = projected_camera(view.folder / view.calibration_file, numbers,
                                          fmt::format("{}{}", has_own ? "P" : "P_rect_0", i + 2));
  });
  if (has_own && has_all) read_or_blame(view, all, [&] { compare_calibrations(view, all, frame); });
}

DatasetView read_layout(const fs::path& folder, const KittiFolders& layout) {
  DatasetView view = {.format = std::string(layout.format), .folder = root_of(folder)};
  view.depth_file = layout.disparity;
  view.pictures_file = layout.pictures[0];
  std::vector<std::string> folders(layout.pictures.begin(), layout.pictures.end());
  folders.insert(folders.end(), layout.others.begin(), layout.others.end());
  std::set<std::string> names = complete_frames(view, folders, kEnding);
  if (layout.format == kSceneFlow.format) {
    const std::set<std::string> seconds =
        complete_frames(view, {layout.pictures.begin(), layout.pictures.end()}, "_11.png");
    for (const std::string& name : names)
      if (!seconds.contains(name))
        view.faults.push_back(
            {fmt::format("{}/{}_11.png", layout.pictures[0], name), name, "missing frame: the second pair"});
  }
  for (const std::string& name : names) {
    ViewFrame frame = {.name = name};
    frame.drive_goes_on = false;
    read_calibration_of(view, frame);
    for (const Side side : {Side::kLeft, Side::kRight})
      add_channel(view, frame, side, Channel::kPicture,
                  fmt::format("{}/{}{}", layout.pictures[index_of(side)], name, kEnding));
    const auto add = [&](Channel channel, const std::string& kind, double step) {
      add_channel(view, frame, Side::kLeft, channel, fmt::format("{}/{}{}", kind, name, kEnding), step);
    };
    add(Channel::kDisparity, layout.disparity, kDisparityLevel_px);
    if (&layout != &k2012) add(Channel::kNextDisparity, "disp_occ_1", kDisparityLevel_px);
    if (&layout == &kSceneFlow) {
      add(Channel::kFlow, "flow_occ", kFlowLevel_px);
      for (const Side side : {Side::kLeft, Side::kRight})
        add_channel(view, frame, side, Channel::kNextPicture,
                    fmt::format("{}/{}_11.png", layout.pictures[index_of(side)], name));
    }
    for (const auto& [part, whole] : kParts) add_part(view, frame, part, whole);
    view.frames.push_back(std::move(frame));
  }
  if (fs::exists(view.folder / "calib_cam_to_cam"))
    view.checked.push_back("calib_cam_to_cam/ against calib/");
  view.cannot.push_back(
      "depth in metres: the layout has no second source of the baseline but calib_cam_to_cam/, "
      "and no poses");
  return view;
}

}  // namespace

bool looks_like_kitti_stereo(const fs::path& folder) {
  return fs::is_directory(root_of(folder) / "image_2") && fs::is_directory(root_of(folder) / "image_3");
}

DatasetView read_kitti_stereo_view(const fs::path& folder) {
  return read_layout(folder, k2015);
}

bool looks_like_kitti_stereo_2012(const fs::path& folder) {
  return fs::is_directory(root_of(folder) / "colored_0");
}

DatasetView read_kitti_stereo_2012_view(const fs::path& folder) {
  return read_layout(folder, k2012);
}

bool looks_like_kitti_scene_flow(const fs::path& folder) {
  return looks_like_kitti_stereo(folder) && fs::is_directory(root_of(folder) / "flow_occ");
}

DatasetView read_kitti_scene_flow_view(const fs::path& folder) {
  return read_layout(folder, kSceneFlow);
}

}  // namespace stereobench::harness
