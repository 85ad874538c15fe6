#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/verify/readers/kitti_calibration.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/stereo_readers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;
using Numbers = std::map<std::string, std::vector<double>>;

/// Where the layout has a pair's files: {folder of pictures, folder of truth, names of the disparities}.
struct PairFolders {
  std::string_view format;
  std::string pictures, truth;
  std::array<std::string, 2> disparity;
};

const PairFolders kMiddlebury = {"middlebury", "", "", {"disp0.pfm", "disp1.pfm"}};
const PairFolders kEth3d = {
    "eth3d", "two_view_training/", "two_view_training_gt/", {"disp0GT.pfm", "disp1GT.pfm"}};

double number_of(const fs::path& file, const Numbers& numbers, const char* key) {
  const auto found = numbers.find(key);
  if (found == numbers.end() || found->second.size() != 1)
    throw std::runtime_error(fmt::format("{}: {}: expected a number", file.string(), key));
  return found->second[0];
}

void read_pair_calibration(DatasetView& view, const std::string& name, ViewFrame& frame) {
  constexpr double kMm = 1000.0, kRounding_px = 1e-3;
  const fs::path file = view.folder / name;
  const Numbers numbers = keyed_numbers(file, '=');
  for (std::size_t i = 0; i < 2; ++i) {
    const auto matrix = numbers.find(i == 0 ? "cam0" : "cam1");
    if (matrix == numbers.end() || matrix->second.size() != 9 || !(matrix->second[0] > 0.0))
      throw std::runtime_error(
          fmt::format("{}: cam{}: expected 9 numbers, a focal length first", file.string(), i));
    const std::vector<double>& k = matrix->second;
    frame.cameras[i].pinhole = {static_cast<int>(number_of(file, numbers, "width")),
                                static_cast<int>(number_of(file, numbers, "height")), k[0], k[2], k[5]};
    frame.cameras[i].lens.pixel_aspect = k[4] / k[0];
  }
  frame.cameras[1].body_from_camera.translation().x() =
      shortest_quotient(number_of(file, numbers, "baseline"), kMm);
  const double shift_px = frame.cameras[1].pinhole.cx_px - frame.cameras[0].pinhole.cx_px;
  const double doffs = number_of(file, numbers, "doffs");
  if (std::abs(doffs - shift_px) > kRounding_px)
    view.faults.push_back(
        {name, frame.name,
         fmt::format("principal point: doffs is {} px, and cam1 has its principal point {} px right of "
                     "cam0's",
                     doffs, shift_px)});
  if (std::abs(frame.cameras[1].pinhole.focal_px - frame.cameras[0].pinhole.focal_px) > kRounding_px)
    view.faults.push_back(
        {name, frame.name,
         fmt::format("focal length: {} px of cam0, {} px of cam1: a rectified pair has one",
                     frame.cameras[0].pinhole.focal_px, frame.cameras[1].pinhole.focal_px)});
}

/// Each file that some pairs have and others not.
void find_missing_files(DatasetView& view, const std::string& folder, const std::set<std::string>& names) {
  std::set<std::string> known;
  for (const std::string& name : names)
    for (const std::string& file : stems_in(view.folder / (folder + name), "")) known.insert(file);
  for (const std::string& name : names)
    for (const std::string& file : known)
      if (!fs::exists(view.folder / (folder + name) / file))
        view.faults.push_back(
            {fmt::format("{}{}/{}", folder, name, file), name, "missing frame: other pairs have this file"});
}

std::set<std::string> pairs_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (fs::exists(entry.path() / "calib.txt") || fs::exists(entry.path() / "im0.png"))
      names.insert(entry.path().filename().string());
  return names;
}

DatasetView read_pairs(const fs::path& folder, const PairFolders& layout) {
  DatasetView view = {.format = std::string(layout.format), .folder = folder};
  const std::set<std::string> names = pairs_in(folder / layout.pictures);
  find_missing_files(view, layout.pictures, names);
  if (!layout.truth.empty()) find_missing_files(view, layout.truth, names);
  for (const std::string& name : names) {
    ViewFrame frame = {.name = name};
    frame.drive_goes_on = false;
    const std::string calibration = fmt::format("{}{}/calib.txt", layout.pictures, name);
    read_or_blame(view, calibration, [&] { read_pair_calibration(view, calibration, frame); });
    for (const Side side : {Side::kLeft, Side::kRight}) {
      add_channel(view, frame, side, Channel::kPicture,
                  fmt::format("{}{}/im{}.png", layout.pictures, name, index_of(side)));
      add_channel(view, frame, side, Channel::kDisparity,
                  fmt::format("{}{}/{}", layout.truth, name, layout.disparity[index_of(side)]));
    }
    view.calibration_file = calibration;
    view.depth_file = fmt::format("{}*/{}", layout.truth, layout.disparity[0]);
    view.pictures_file = fmt::format("{}*/im0.png", layout.pictures);
    view.frames.push_back(std::move(frame));
  }
  view.checked.push_back("doffs and focal lengths of calib.txt");
  view.cannot.push_back("baseline and focal length: the layout has neither depth in metres nor poses");
  return view;
}

}  // namespace

bool looks_like_middlebury(const fs::path& folder) {
  return !pairs_in(folder).empty();
}

DatasetView read_middlebury_view(const fs::path& folder) {
  return read_pairs(folder, kMiddlebury);
}

bool looks_like_eth3d(const fs::path& folder) {
  return !pairs_in(folder / "two_view_training").empty();
}

DatasetView read_eth3d_view(const fs::path& folder) {
  return read_pairs(folder, kEth3d);
}

}  // namespace stereobench::harness
