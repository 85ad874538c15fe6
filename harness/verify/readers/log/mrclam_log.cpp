#include "harness/verify/readers/log/mrclam_log.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/logs/recorded_streams.h"
#include "harness/verify/readers/reader_tools.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kBarcodeColumns = {"Subject #", "Barcode #"};
const std::vector<std::string> kLandmarkColumns = {"Subject #", "x [m]", "y [m]", "x std-dev [m]",
                                                   "y std-dev [m]"};
const std::vector<std::string> kOdometryColumns = {"Time [s]", "forward velocity [m/s]",
                                                   "angular velocity[rad/s]"};
const std::vector<std::string> kSightingColumns = {"Time [s]", "Subject #", "range [m]", "bearing [rad]"};
const std::vector<std::string> kTruthColumns = {"Time [s]", "x [m]", "y [m]", "orientation [rad]"};

/// A file's name in the folder, with .gz where it has that; empty where there is none.
std::string file_there(const DatasetView& view, const std::string& name) {
  const auto file = find_plain_or_gz(view.folder / name);
  return file ? file->filename().string() : "";
}

/// Reads a table line by line. @param read of a line; what it throws is a fault of that line
void read_rows(DatasetView& view, const std::string& file, const std::vector<std::string>& columns,
               const std::function<void(const NumberTable&, const TableRow&)>& read) {
  if (file.empty()) return;
  NumberTable table;
  read_or_blame(view, file, [&] { table = read_blank_separated_table(view.folder / file, columns); });
  for (const TableRow& row : table.rows) {
    const std::size_t before = view.faults.size();
    read_or_blame(view, file, [&] { read(table, row); });
    const bool is_of_a_time = columns[0] == kTruthColumns[0];
    if (view.faults.size() > before && is_of_a_time) view.faults.back().frame = row.cells[0];
  }
}

std::vector<MrclamReading> readings_in(DatasetView& view, const std::string& file) {
  std::vector<MrclamReading> readings;
  read_rows(view, file, kOdometryColumns, [&](const NumberTable& table, const TableRow& row) {
    const std::int64_t stamp_ns = stamp_ns_in(table, row, 0);
    if (!readings.empty() && stamp_ns < readings.back().stamp_ns)
      refuse(table, row, 0, "expected a time that is not before that of the line before");
    readings.push_back({row.line, stamp_ns, number_in(table, row, 1), number_in(table, row, 2)});
  });
  return readings;
}

std::vector<MrclamSighting> sightings_in(DatasetView& view, const std::string& file) {
  std::vector<MrclamSighting> sightings;
  read_rows(view, file, kSightingColumns, [&](const NumberTable& table, const TableRow& row) {
    const MrclamSighting sighting = {row.line,
                                     row.cells[0],
                                     stamp_ns_in(table, row, 0),
                                     whole_number_in(table, row, 1, 0),
                                     number_in(table, row, 2),
                                     number_in(table, row, 3)};
    if (sighting.range_m < 0.0) refuse(table, row, 2, "expected a range of at least 0");
    sightings.push_back(sighting);
  });
  return sightings;
}

std::vector<MrclamPose> truth_in(DatasetView& view, const std::string& file) {
  std::vector<MrclamPose> truth;
  read_rows(view, file, kTruthColumns, [&](const NumberTable& table, const TableRow& row) {
    const slam::Pose pose = {number_in(table, row, 1), number_in(table, row, 2), number_in(table, row, 3)};
    truth.push_back({row.line, row.cells[0], stamp_ns_in(table, row, 0), pose});
  });
  return truth;
}

/// @return nothing where the folder has no file of the robot
std::optional<MrclamRobot> robot_in(DatasetView& view, int subject) {
  const auto name = [&](const char* what) { return fmt::format("Robot{}_{}.dat", subject, what); };
  MrclamRobot robot = {.subject = subject,
                       .odometry_file = file_there(view, name("Odometry")),
                       .sightings_file = file_there(view, name("Measurement")),
                       .truth_file = file_there(view, name("Groundtruth"))};
  const std::string any = robot.odometry_file + robot.sightings_file + robot.truth_file;
  if (any.empty()) return std::nullopt;
  for (const auto& [file, what] :
       {std::pair(robot.odometry_file, "Odometry"), std::pair(robot.sightings_file, "Measurement"),
        std::pair(robot.truth_file, "Groundtruth")})
    if (file.empty()) view.faults.push_back({name(what), "", "missing file: there are others of this robot"});
  robot.odometry = readings_in(view, robot.odometry_file);
  robot.sightings = sightings_in(view, robot.sightings_file);
  robot.truth = truth_in(view, robot.truth_file);
  return robot;
}

void read_subjects(DatasetView& view, MrclamLog& log) {
  read_rows(view, file_there(view, kMrclamBarcodes), kBarcodeColumns,
            [&](const NumberTable& table, const TableRow& row) {
              if (!log.subjects.emplace(whole_number_in(table, row, 1, 0), whole_number_in(table, row, 0, 1))
                       .second)
                refuse(table, row, 1, "expected each barcode once");
            });
  read_rows(view, file_there(view, kMrclamLandmarks), kLandmarkColumns,
            [&](const NumberTable& table, const TableRow& row) {
              const Eigen::Vector2d place_m(number_in(table, row, 1), number_in(table, row, 2));
              for (const std::size_t column : {std::size_t{3}, std::size_t{4}})
                if (number_in(table, row, column) < 0.0)
                  refuse(table, row, column, "expected a deviation of at least 0");
              if (!log.landmarks_m.emplace(whole_number_in(table, row, 0, 1), place_m).second)
                refuse(table, row, 0, "expected each subject once");
            });
}

}  // namespace

MrclamLog read_mrclam_log(DatasetView& view) {
  MrclamLog log;
  for (const char* name : {kMrclamBarcodes, kMrclamLandmarks})
    if (file_there(view, name).empty())
      view.faults.push_back({name, "", "missing file: the layout cannot be without it"});
  read_subjects(view, log);
  for (int subject = 1; subject <= kMrclamRobots; ++subject)
    if (std::optional<MrclamRobot> robot = robot_in(view, subject)) log.robots.push_back(std::move(*robot));
  return log;
}

std::optional<slam::Pose> true_pose(const std::vector<MrclamPose>& truth, std::int64_t stamp_ns,
                                    std::ptrdiff_t late) {
  constexpr std::int64_t kLongestGap_ns = 1'000'000'000;
  const auto after = std::ranges::lower_bound(truth, stamp_ns, {}, &MrclamPose::stamp_ns);
  if (after == truth.end()) return std::nullopt;
  const std::ptrdiff_t last = std::ssize(truth) - 1, place = after - truth.begin();
  const auto pose_of = [&](std::ptrdiff_t i) -> const slam::Pose& {
    return truth[static_cast<std::size_t>(i)].pose;
  };
  const bool is_exact = after->stamp_ns == stamp_ns;
  if (place + late > last || place + late - (is_exact ? 0 : 1) < 0 || (!is_exact && place == 0))
    return std::nullopt;
  if (is_exact) return pose_of(place + late);
  const MrclamPose& before = *(after - 1);
  if (after->stamp_ns - before.stamp_ns > kLongestGap_ns) return std::nullopt;
  const double share = static_cast<double>(stamp_ns - before.stamp_ns) /
                       static_cast<double>(after->stamp_ns - before.stamp_ns);
  const slam::Pose &from = pose_of(place + late - 1), &to = pose_of(place + late);
  return slam::Pose{from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m),
                    from.heading_rad + share * slam::wrap_angle(to.heading_rad - from.heading_rad)};
}

}  // namespace stereobench::harness
