#include "harness/dataset_import/imported_frames.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

bool has_picture(const ViewFrame& frame, Side side) {
  return find_channel(frame, side, Channel::kPicture) != nullptr;
}

const std::string& left_picture(const ViewFrame& frame) {
  return find_channel(frame, Side::kLeft, Channel::kPicture)->file;
}

bool is_called(const ViewFrame& frame, const std::string& only) {
  if (only.empty() || frame.name == only || frame.drive == only) return true;
  const fs::path folders = fs::path(left_picture(frame)).parent_path();
  return std::ranges::find(folders, fs::path(only)) != folders.end();
}

bool have_same_cameras(const ViewFrame& one, const ViewFrame& other) {
  for (std::size_t i = 0; i < 2; ++i) {
    const ViewCamera &a = one.cameras[i], &b = other.cameras[i];
    const vision::Intrinsics &p = a.pinhole, &q = b.pinhole;
    if (p.width_px != q.width_px || p.height_px != q.height_px || p.focal_px != q.focal_px ||
        p.cx_px != q.cx_px || p.cy_px != q.cy_px || !(a.lens == b.lens) ||
        a.body_from_camera.matrix() != b.body_from_camera.matrix())
      return false;
  }
  return true;
}

/// Whether the pictures behind a frame are of another drive. Pairs without times and poses are of none.
bool drive_ends_at(const ViewFrame& frame) {
  return !frame.drive_goes_on && (frame.stamp_ns[0] || frame.world_from_body[0]);
}

void require_one_drive(const DatasetView& view, const std::vector<ViewFrame>& frames) {
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    const bool ends = drive_ends_at(frames[i]);
    if (!ends && have_same_cameras(frames[i], frames[i + 1])) continue;
    throw std::runtime_error(
        fmt::format("{}: {} and {} are of {}; import one by --only, with the name of its folder or frame",
                    view.folder.string(), left_picture(frames[i]), left_picture(frames[i + 1]),
                    ends ? "two drives" : "two rigs"));
  }
}

/// The numbers that frames are named by, behind their folders; empty where they are not, or not in order.
std::vector<std::size_t> numbers_in_names(const std::vector<ViewFrame>& frames) {
  std::vector<std::size_t> numbers;
  for (const ViewFrame& frame : frames) {
    const std::string name = fs::path(frame.name).filename().string();
    const char* const end = name.data() + name.size();
    std::size_t number = 0;
    const auto [stop, error] = std::from_chars(name.data(), end, number);
    if (error != std::errc() || stop != end || (!numbers.empty() && number <= numbers.back())) return {};
    numbers.push_back(number);
  }
  return numbers;
}

void number_from_zero(ImportedFrames& imported) {
  imported.numbers.resize(imported.frames.size());
  std::iota(imported.numbers.begin(), imported.numbers.end(), std::size_t{0});
}

/// Names the layout's pictures, for somebody who looks for those that are missing.
[[noreturn]] void refuse_nothing(const DatasetView& view, const std::string& only) {
  throw std::runtime_error(
      fmt::format("{}: no frame {}has its pictures (format {}, {})", view.folder.string(),
                  only.empty() ? "" : fmt::format("of --only {} ", only), view.format, view.pictures_file));
}

}  // namespace

ImportedFrames frames_to_import(const DatasetView& view, const std::string& only) {
  ImportedFrames imported;
  std::vector<ViewFrame> chosen;
  for (const ViewFrame& frame : view.frames) {
    if (has_picture(frame, Side::kLeft) && is_called(frame, only))
      chosen.push_back(frame);
    else if (only.empty())
      ++imported.left_out;
  }
  imported.are_pairs =
      std::ranges::any_of(chosen, [](const ViewFrame& frame) { return has_picture(frame, Side::kRight); });
  require_one_drive(view, chosen);
  const bool times =
      std::ranges::any_of(chosen, [](const ViewFrame& frame) { return frame.stamp_ns[0].has_value(); });
  for (ViewFrame& frame : chosen) {
    const bool is_whole = (!imported.are_pairs || has_picture(frame, Side::kRight)) &&
                          (!times || frame.stamp_ns[0].has_value());
    if (is_whole)
      imported.frames.push_back(std::move(frame));
    else
      ++imported.left_out;
  }
  if (imported.frames.empty()) refuse_nothing(view, only);
  imported.have_times = times;
  if (!times) imported.numbers = numbers_in_names(imported.frames);
  if (imported.numbers.empty()) number_from_zero(imported);
  return imported;
}

void keep_frames_with_poses(const DatasetView& view, ImportedFrames& imported) {
  const auto refuse = [&](const std::string& why) {
    throw std::runtime_error(
        fmt::format("{}: --odometry-from-truth: {} (format {})", view.folder.string(), why, view.format));
  };
  if (!imported.have_times) refuse("there are no times");
  const auto has_pose = [](const ViewFrame& frame) { return frame.world_from_body[0].has_value(); };
  std::vector<ViewFrame>& frames = imported.frames;
  const std::size_t before = frames.size();
  const auto first = std::ranges::find_if(frames, has_pose);
  if (first == frames.end()) refuse("there are no true poses");
  frames.erase(frames.begin(), first);
  while (!has_pose(frames.back())) frames.pop_back();
  const auto gap = std::ranges::find_if_not(frames, has_pose);
  if (gap != frames.end())
    refuse(fmt::format("no true pose within 0.25 s of frame {}, between others that have one", gap->name));
  imported.left_out += before - frames.size();
  number_from_zero(imported);
}

}  // namespace stereobench::harness
