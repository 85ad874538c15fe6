#include "harness/trajectories/trajectory_file.h"

#include <cmath>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "harness/io/number_table.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

constexpr const char* kOurHeader = "t_s,x_m,y_m,theta_rad";

/// By how much the length of a quaternion may miss one; it is made one.
constexpr double kQuaternionTolerance = 0.02;

/// By how much a matrix may miss a rotation; it stays as it is, as in other programs.
constexpr double kMatrixTolerance = 1e-3;

/// Stamps up to so much have differences that fit.
constexpr std::int64_t kMostStamp_ns = 4'000'000'000'000'000'000;

/// A row of nanoseconds lasts longer.
constexpr std::int64_t kLeastStep_ns = 1000;

Eigen::Vector3d position_in(const NumberTable& table, const TableRow& row, std::size_t column) {
  return {number_in(table, row, column), number_in(table, row, column + 1),
          number_in(table, row, column + 2)};
}

/// @param w, x the columns of the real part and of the first of the others
Eigen::Matrix3d rotation_in(const NumberTable& table, const TableRow& row, std::size_t w, std::size_t x) {
  const Eigen::Quaterniond q(number_in(table, row, w), number_in(table, row, x), number_in(table, row, x + 1),
                             number_in(table, row, x + 2));
  if (std::abs(q.norm() - 1.0) > kQuaternionTolerance)
    refuse(table, row, w, "expected a quaternion of length 1");
  return q.normalized().toRotationMatrix();
}

Trajectory tum_from(const NumberTable& table) {
  Trajectory trajectory;
  for (const TableRow& row : table.rows) {
    trajectory.stamps_ns.push_back(stamp_ns_in(table, row, 0));
    trajectory.poses.push_back({rotation_in(table, row, 7, 4), position_in(table, row, 1)});
  }
  return trajectory;
}

Trajectory euroc_from(const NumberTable& table) {
  Trajectory trajectory;
  for (const TableRow& row : table.rows) {
    trajectory.stamps_ns.push_back(nanoseconds_in(table, row, 0));
    trajectory.poses.push_back({rotation_in(table, row, 4, 5), position_in(table, row, 1)});
  }
  const auto steps = static_cast<std::int64_t>(table.rows.size()) - 1;
  if (steps > 0 && trajectory.stamps_ns.back() - trajectory.stamps_ns.front() < kLeastStep_ns * steps)
    refuse(table, table.rows.back(), 0, "expected nanoseconds (EuRoC), more than a thousand from row to row");
  return trajectory;
}

Trajectory kitti_from(const NumberTable& table) {
  Trajectory trajectory;
  for (const TableRow& row : table.rows) {
    PoseInSpace pose;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(4 * i);
      pose.rotation.row(i) = position_in(table, row, at);
      pose.position_m(i) = number_in(table, row, at + 3);
    }
    if (!(pose.rotation * pose.rotation.transpose()).isIdentity(kMatrixTolerance) ||
        pose.rotation.determinant() < 0)
      refuse(table, row, 0, "expected a rotation in columns 1-3 of the matrix");
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

Trajectory ours_from(const NumberTable& table) {
  Trajectory trajectory{.is_planar = true};
  for (const TableRow& row : table.rows) {
    trajectory.stamps_ns.push_back(stamp_ns_in(table, row, 0));
    const auto [sine, cosine] = slam::sine_cosine(number_in(table, row, 3));
    PoseInSpace pose;
    pose.rotation.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
    pose.position_m = Eigen::Vector3d(number_in(table, row, 1), number_in(table, row, 2), 0.0);
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

std::size_t count_of_words(const std::string& line) {
  std::istringstream words(line);
  return static_cast<std::size_t>(std::distance(std::istream_iterator<std::string>(words), {}));
}

struct TableOfPoses {
  NumberTable table;
  Trajectory trajectory;
};

TableOfPoses read_poses(const std::filesystem::path& file) {
  const std::string first = first_row(file);
  const auto with = [](NumberTable table, Trajectory (*from)(const NumberTable&)) {
    Trajectory trajectory = from(table);
    return TableOfPoses{std::move(table), std::move(trajectory)};
  };
  if (first.starts_with("t_s,")) return with(read_csv_table(file, {kOurHeader}), ours_from);
  if (first.find(',') != std::string::npos)
    return with(read_comma_separated_table(file, {"time", "x", "y", "z", "qw", "qx", "qy", "qz"}),
                euroc_from);
  if (count_of_words(first) == 12)
    return with(read_blank_separated_table(
                    file, {"r11", "r12", "r13", "x", "r21", "r22", "r23", "y", "r31", "r32", "r33", "z"}),
                kitti_from);
  if (count_of_words(first) == 8)
    return with(read_blank_separated_table(file, {"time", "x", "y", "z", "qx", "qy", "qz", "qw"}), tum_from);
  throw std::runtime_error(
      fmt::format("{}: expected a trajectory: 8 numbers a line (TUM), 12 (KITTI), 8 or more separated by "
                  "commas (EuRoC), or the header '{}'",
                  file.string(), kOurHeader));
}

}  // namespace

Trajectory read_trajectory(const std::filesystem::path& path) {
  const std::filesystem::path file = require_plain_or_gz(path);
  if (!std::filesystem::is_regular_file(file))
    throw std::runtime_error(fmt::format("{}: expected a file, not a folder or a pipe", file.string()));
  auto [table, trajectory] = read_poses(file);
  if (trajectory.poses.empty())
    throw std::runtime_error(fmt::format("{}: expected at least one pose", file.string()));
  for (std::size_t i = 0; i < trajectory.stamps_ns.size(); ++i) {
    if (std::abs(trajectory.stamps_ns[i]) > kMostStamp_ns)
      refuse(table, table.rows[i], 0, "expected a time within 4e9 seconds");
    if (i > 0 && trajectory.stamps_ns[i] <= trajectory.stamps_ns[i - 1])
      refuse(table, table.rows[i], 0, "expected a time after the line above");
  }
  return trajectory;
}

}  // namespace stereobench::harness
