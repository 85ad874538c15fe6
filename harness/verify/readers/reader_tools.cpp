#include "harness/verify/readers/reader_tools.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <fmt/format.h>

#include "harness/dataset/drive_json.h"
#include "harness/io/file_list.h"
#include "harness/io/json_file.h"
#include "harness/verify/channel_files.h"

namespace stereobench::harness {

namespace fs = std::filesystem;

void read_or_blame(DatasetView& view, const std::string& file, const std::function<void()>& read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    // The message begins with the file's path, which the fault names already.
    std::string what = error.what();
    const std::string path = (view.folder / file).string();
    if (what.starts_with(path)) what.erase(0, path.size());
    if (what.starts_with(": "))
      what.erase(0, 2);
    else if (what.starts_with(":"))  // a line's number follows
      what.replace(0, 1, "line ");
    view.faults.push_back({file, "", what});
  }
}

std::set<std::string> stems_in(const fs::path& folder, const std::string& ending) {
  std::set<std::string> stems;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name.ends_with(ending))
      stems.insert(name.substr(0, name.size() - ending.size()));
  }
  return stems;
}

void add_channel(DatasetView& view, ViewFrame& frame, vision::Side side, Channel channel,
                 const std::string& file, double step) {
  const fs::path path = view.folder / file;
  if (!fs::exists(path)) return;
  frame.channels[index_of(side)][channel] = {
      file, step, [path, channel, step] { return read_channel(path, channel, step); }};
}

std::set<std::string> complete_frames(DatasetView& view, const std::vector<std::string>& folders,
                                      const std::string& ending) {
  std::set<std::string> all;
  std::vector<std::pair<std::string, std::set<std::string>>> there;
  for (const std::string& folder : folders) {
    there.emplace_back(folder, stems_in(view.folder / folder, ending));
    if (there.back().second.empty()) there.pop_back();
  }
  for (const auto& [folder, stems] : there) all.insert(stems.begin(), stems.end());
  for (const auto& [folder, stems] : there)
    for (const std::string& stem : all)
      if (!stems.contains(stem)) {
        const auto other =
            std::ranges::find_if(there, [&](const auto& one) { return one.second.contains(stem); });
        view.faults.push_back({fmt::format("{}/{}{}", folder, stem, ending), stem,
                               fmt::format("missing frame: there is {}/{}{}", other->first, stem, ending)});
      }
  return all;
}

Eigen::Matrix4d matrix_in(const NumberTable& table, const TableRow& row, std::size_t column,
                          std::size_t count) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; i < count; ++i)
    matrix(static_cast<int>(i / 4), static_cast<int>(i % 4)) = number_in(table, row, column + i);
  return matrix;
}

ViewPose pose_in(const NumberTable& table, const TableRow& row, std::size_t column, bool w_is_first) {
  std::array<double, 7> at{};
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = number_in(table, row, column + i);
  const Eigen::Quaterniond turn = w_is_first ? Eigen::Quaterniond(at[3], at[4], at[5], at[6])
                                             : Eigen::Quaterniond(at[6], at[3], at[4], at[5]);
  ViewPose pose = {.file = {}, .line = row.line, .stamp_ns = {}};
  pose.quaternion_norm = turn.norm();
  if (pose.quaternion_norm > 0.0) pose.matrix.topLeftCorner<3, 3>() = turn.normalized().toRotationMatrix();
  pose.matrix.topRightCorner<3, 1>() << at[0], at[1], at[2];
  return pose;
}

double precision_of(std::span<const std::string> numbers) {
  int decimals = 0;
  for (const std::string& number : numbers) {
    const std::size_t exponent = number.find_first_of("eE"), point = number.find('.');
    if (point == std::string::npos) continue;
    const std::size_t end = std::min(exponent, number.size());
    int places = static_cast<int>(end - point) - 1;
    if (exponent != std::string::npos) places -= std::atoi(number.c_str() + exponent + 1);
    decimals = std::max(decimals, places);
  }
  double unit = 0.5;
  for (int i = 0; i < decimals; ++i) unit /= 10.0;
  return decimals == 0 ? 0.0 : unit;
}

double precision_of(const NumberTable& table, std::size_t first_column, std::size_t count) {
  double unit = 0.0;
  for (const TableRow& row : table.rows) {
    const double of_row = precision_of(std::span(row.cells).subspan(first_column, count));
    if (of_row > 0.0) unit = unit == 0.0 ? of_row : std::min(unit, of_row);
  }
  return unit;
}

std::optional<Eigen::Isometry3d> pose_at(const std::vector<ViewPose>& poses, std::int64_t stamp_ns) {
  constexpr std::int64_t kLongestGap_ns = 250'000'000;
  const auto after = std::ranges::find_if(
      poses, [&](const ViewPose& pose) { return pose.stamp_ns && *pose.stamp_ns >= stamp_ns; });
  if (after == poses.end()) return std::nullopt;
  if (*after->stamp_ns == stamp_ns) return as_rigid(after->matrix);
  if (after == poses.begin()) return std::nullopt;
  const ViewPose& from = *(after - 1);
  if (!from.stamp_ns || *after->stamp_ns - *from.stamp_ns > kLongestGap_ns) return std::nullopt;
  const double share =
      static_cast<double>(stamp_ns - *from.stamp_ns) / static_cast<double>(*after->stamp_ns - *from.stamp_ns);
  const Eigen::Isometry3d first = as_rigid(from.matrix), last = as_rigid(after->matrix);
  Eigen::Isometry3d between = Eigen::Isometry3d::Identity();
  between.linear() =
      Eigen::Quaterniond(first.linear()).slerp(share, Eigen::Quaterniond(last.linear())).toRotationMatrix();
  between.translation() = (1.0 - share) * first.translation() + share * last.translation();
  return between;
}

Eigen::Isometry3d as_rigid(const Eigen::Matrix4d& matrix) {
  Eigen::Isometry3d pose;
  pose.matrix() = matrix;
  return pose;
}

double said_of_shutter(const fs::path& folder, std::string_view key) {
  if (!fs::exists(folder / kDatasetJson)) return 0.0;
  constexpr double kMost = 1e9;
  return read_json_file(folder / kDatasetJson, [&](const JsonValue& json) {
    const auto drive = json.find(kDrive);
    const auto shutter = drive ? drive->find("shutter") : std::nullopt;
    const auto value = shutter ? shutter->find(key) : std::nullopt;
    return value ? value->number(-kMost, kMost) : 0.0;
  });
}

std::string place_of(const ViewPose& pose) {
  return fmt::format("{}:{}", pose.file, pose.line);
}

}  // namespace stereobench::harness
