#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "harness/verify/checks/checks.h"

namespace stereobench::harness {
namespace {

/// "line 7", as messages name a pose.
std::string place_in_file(const ViewPose& pose) {
  return pose.name.empty() ? fmt::format("line {}", pose.line) : pose.name;
}

/// Whether a pose follows the one that is listed before it: files of several drives or robots do not.
bool is_next(const std::vector<ViewPose>& poses, std::size_t i) {
  return poses[i].file == poses[i - 1].file;
}

/// How far a matrix is from a rotation.
double skew_of(const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix3d turn = matrix.topLeftCorner<3, 3>();
  return (turn.transpose() * turn - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

void check_rigid(const DatasetView& view, Margins& margins, std::vector<Fault>& faults) {
  // Nine numbers of d decimals make products that are off by some of their last units.
  const double tolerance = 1e-6 + 8.0 * view.turn_precision;
  for (const ViewPose& pose : view.poses) {
    if (margins.is_beyond("length of a quaternion", std::abs(pose.quaternion_norm - 1.0), tolerance))
      faults.push_back({pose.file, "",
                        fmt::format("{}: the quaternion has length {:.6g}: expected 1", place_in_file(pose),
                                    pose.quaternion_norm)});
    if (margins.is_beyond("rotation that is none", skew_of(pose.matrix), tolerance))
      faults.push_back(
          {pose.file, "",
           fmt::format("{}: the rotation is none: its columns are off a unit or a right angle by "
                       "{:.3g}",
                       place_in_file(pose), skew_of(pose.matrix))});
    else if (pose.matrix.topLeftCorner<3, 3>().determinant() < 0.0)
      faults.push_back({pose.file, "", fmt::format("{}: the axes are left-handed", place_in_file(pose))});
  }
}

/// A way that is much longer than its neighbours in both directions: there and back.
void check_continuous(const DatasetView& view, Margins& margins, std::vector<Fault>& faults) {
  constexpr double kLeap = 50.0, kLeast_m = 1.0;
  std::vector<double> ways_m;
  for (std::size_t i = 0; i + 1 < view.poses.size(); ++i)
    ways_m.push_back((view.poses[i + 1].matrix - view.poses[i].matrix).topRightCorner<3, 1>().norm());
  if (ways_m.size() < 4) return;
  std::vector<double> sorted = ways_m;
  std::ranges::sort(sorted);
  const double usual_m = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < ways_m.size(); ++i)
    if (is_next(view.poses, i + 1) &&
        margins.is_beyond("leap of poses", ways_m[i], std::max(kLeast_m, kLeap * usual_m)))
      faults.push_back({view.poses[i + 1].file, "",
                        fmt::format("{}: the pose leaps by {:.3g} m, where {:.3g} m are usual",
                                    place_in_file(view.poses[i + 1]), ways_m[i], usual_m)});
}

}  // namespace

std::vector<Fault> check_poses(const DatasetView& view, Margins& margins) {
  std::vector<Fault> faults;
  check_rigid(view, margins, faults);
  if (view.poses_are_a_way) check_continuous(view, margins, faults);
  return faults;
}

std::vector<Fault> check_stamps(const DatasetView& view) {
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < view.frames.size(); ++i) {
    const ViewFrame& frame = view.frames[i];
    const auto& stamps = frame.stamp_ns;
    if (stamps[0] && stamps[1] && *stamps[0] != *stamps[1])
      faults.push_back(
          {view.pictures_file, frame.name,
           fmt::format("the right picture is of {} ns, the left one of {} ns", *stamps[1], *stamps[0])});
    if (i > 0 && view.frames[i - 1].drive_goes_on && stamps[0] && view.frames[i - 1].stamp_ns[0] &&
        *stamps[0] <= *view.frames[i - 1].stamp_ns[0])
      faults.push_back({view.pictures_file, frame.name,
                        fmt::format("time {} ns is not after that of the frame before, {} ns", *stamps[0],
                                    *view.frames[i - 1].stamp_ns[0])});
  }
  for (std::size_t i = 1; i < view.poses.size(); ++i)
    if (is_next(view.poses, i) && view.poses[i].stamp_ns && view.poses[i - 1].stamp_ns &&
        *view.poses[i].stamp_ns <= *view.poses[i - 1].stamp_ns)
      faults.push_back({view.poses[i].file, "",
                        fmt::format("{}: time {} ns is not after that of the one before",
                                    place_in_file(view.poses[i]), *view.poses[i].stamp_ns)});
  return faults;
}

}  // namespace stereobench::harness
