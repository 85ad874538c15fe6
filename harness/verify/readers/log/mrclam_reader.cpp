#include "harness/verify/readers/log/mrclam_reader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/file_list.h"
#include "harness/io/number_table.h"
#include "harness/verify/geometry/link_statistics.h"
#include "harness/verify/readers/log/mrclam_log.h"
#include "harness/verify/readers/reader_tools.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// The instants at which a robot saw something.
void add_instants(DatasetView& view, const MrclamRobot& robot) {
  const std::size_t first = view.frames.size();
  for (const MrclamSighting& sighting : robot.sightings) {
    const bool is_new = view.frames.size() == first || view.frames.back().stamp_ns[0] != sighting.stamp_ns;
    if (is_new)
      view.frames.push_back({.name = sighting.time, .stamp_ns = {sighting.stamp_ns, {}}, .cameras = {}});
  }
  if (view.frames.size() > first) view.frames.back().drive_goes_on = false;
}

void add_path(DatasetView& view, const MrclamRobot& robot) {
  for (const MrclamPose& at : robot.truth) {
    ViewPose pose = {.file = robot.truth_file, .line = at.line, .stamp_ns = at.stamp_ns};
    pose.matrix.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(at.pose.heading_rad).toRotationMatrix();
    pose.matrix(0, 3) = at.pose.x_m, pose.matrix(1, 3) = at.pose.y_m;
    view.poses.push_back(pose);
  }
}

/// Lines that are left out of a file whose other lines are equally far apart.
void find_missing_poses(DatasetView& view, const MrclamRobot& robot) {
  constexpr double kAlike = 0.01, kMostOthers = 0.1, kGap = 1.5;
  std::vector<double> steps_ns;
  for (std::size_t i = 0; i + 1 < robot.truth.size(); ++i)
    steps_ns.push_back(static_cast<double>(robot.truth[i + 1].stamp_ns - robot.truth[i].stamp_ns));
  const double usual_ns = median(steps_ns);
  const auto others =
      std::ranges::count_if(steps_ns, [&](double ns) { return std::abs(ns - usual_ns) > kAlike * usual_ns; });
  if (static_cast<double>(others) > kMostOthers * static_cast<double>(steps_ns.size())) return;
  constexpr double kNanosecond = 1e-9;
  for (std::size_t i = 0; i < steps_ns.size(); ++i)
    if (view.margins.is_beyond("gap of true poses", steps_ns[i], kGap * usual_ns))
      view.faults.push_back(
          {robot.truth_file, robot.truth[i + 1].time,
           fmt::format(
               "line {}: missing frame: the pose before is {:.6g} s earlier, where {:.6g} s are usual",
               robot.truth[i + 1].line, kNanosecond * steps_ns[i], kNanosecond * usual_ns)});
}

}  // namespace

bool looks_like_mrclam(const fs::path& folder) {
  return find_plain_or_gz(folder / kMrclamBarcodes) || find_plain_or_gz(folder / kMrclamLandmarks);
}

DatasetView read_mrclam_view(const fs::path& folder) {
  DatasetView view = {.format = "mrclam", .folder = folder};
  view.has_calibration = false;
  const MrclamLog log = read_mrclam_log(view);
  if (log.robots.empty())
    throw std::runtime_error(
        fmt::format("{}: expected a log of MRCLAM: Robot1_Measurement.dat and others", folder.string()));
  bool may_be_late = false;
  read_or_blame(view, kDatasetJson,
                [&] { may_be_late = said_of_shutter(folder, "late_probability") != 0.0; });
  check_identities(view, log);
  for (const MrclamRobot& robot : log.robots) {
    view.pictures_file = robot.sightings_file;
    add_instants(view, robot);
    add_path(view, robot);
    find_missing_poses(view, robot);
    check_sightings(view, log, robot, may_be_late);
    check_odometry(view, robot);
  }
  view.cannot.push_back("pictures, which the layout has not");
  return view;
}

}  // namespace stereobench::harness
