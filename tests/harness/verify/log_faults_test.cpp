#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Cells = std::vector<std::string>;

constexpr const char* kOdometry = "Robot1_Odometry.dat";
constexpr const char* kSightings = "Robot1_Measurement.dat";
constexpr const char* kTruth = "Robot1_Groundtruth.dat";
constexpr const char* kLandmarks = "Landmark_Groundtruth.dat";

/// A fault, and what the message says of it.
struct LogCase {
  const char* name;
  void (*plant)(const PlantedSet&);
  const char* cause;
};

void PrintTo(const LogCase& planted, std::ostream* out) {
  *out << planted.name;
}

/// Changes the lines of a table. @param change of the rows without the header
void change_table(const PlantedSet& set, const char* file,
                  const std::function<void(std::vector<Cells>&)>& change) {
  std::istringstream text(set.text(file));
  std::string header;
  std::getline(text, header);
  std::vector<Cells> rows;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    rows.push_back({std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()});
  }
  ASSERT_FALSE(rows.empty());
  change(rows);
  std::string changed = header + "\n";
  for (const Cells& row : rows) changed += fmt::format("{}\n", fmt::join(row, " "));
  set.write(file, changed);
}

void scale(const PlantedSet& set, const char* file, std::initializer_list<std::size_t> columns, double by) {
  change_table(set, file, [&](std::vector<Cells>& rows) {
    for (Cells& row : rows)
      for (const std::size_t column : columns) row[column] = fmt::format("{}", by * std::stod(row[column]));
  });
}

/// Each line of a file gets the values of the line before it.
void delay(const PlantedSet& set, const char* file) {
  change_table(set, file, [](std::vector<Cells>& rows) {
    for (std::size_t i = rows.size(); i-- > 1;)
      std::copy(rows[i - 1].begin() + 1, rows[i - 1].end(), rows[i].begin() + 1);
  });
}

constexpr double kDegrees = 57.29577951308232;

void turn_bearings(const PlantedSet& set) {
  scale(set, kSightings, {3}, -1.0);
}
void write_bearings_in_degrees(const PlantedSet& set) {
  scale(set, kSightings, {3}, kDegrees);
}
void write_ranges_in_centimetres(const PlantedSet& set) {
  scale(set, kSightings, {2}, 100.0);
}
void write_poses_in_centimetres(const PlantedSet& set) {
  scale(set, kTruth, {1, 2}, 100.0);
}
void write_landmarks_in_centimetres(const PlantedSet& set) {
  scale(set, kLandmarks, {1, 2}, 100.0);
}
void write_world_in_centimetres(const PlantedSet& set) {
  write_poses_in_centimetres(set);
  write_landmarks_in_centimetres(set);
}
void turn_headings(const PlantedSet& set) {
  scale(set, kTruth, {3}, -1.0);
}
void swap_columns_of_sightings(const PlantedSet& set) {
  change_table(set, kSightings, [](std::vector<Cells>& rows) {
    for (Cells& row : rows) std::swap(row[2], row[3]), row[2].erase(0, row[2].find_first_not_of('-'));
  });
}
void swap_axes_of_landmarks(const PlantedSet& set) {
  change_table(set, kLandmarks, [](std::vector<Cells>& rows) {
    for (Cells& row : rows) std::swap(row[1], row[2]);
  });
}
void delay_true_poses(const PlantedSet& set) {
  delay(set, kTruth);
}
void delay_sightings(const PlantedSet& set) {
  change_table(set, kSightings, [](std::vector<Cells>& rows) {
    for (Cells& row : rows) row[0] = fmt::format("{:.9f}", std::stod(row[0]) + 0.1);
  });
}
void lose_a_pose(const PlantedSet& set) {
  change_table(set, kTruth, [](std::vector<Cells>& rows) { rows.erase(rows.begin() + 12); });
}
void lose_a_file(const PlantedSet& set) {
  ASSERT_TRUE(fs::remove(set.path(kTruth)));
}
void write_nan_of_range(const PlantedSet& set) {
  change_table(set, kSightings, [](std::vector<Cells>& rows) { rows[3][2] = "nan"; });
}
void write_nan_of_odometry(const PlantedSet& set) {
  change_table(set, kOdometry, [](std::vector<Cells>& rows) { rows[7][2] = "nan"; });
}
void misname_a_sighting(const PlantedSet& set) {
  change_table(set, kSightings, [](std::vector<Cells>& rows) { rows[2][1] = rows[2][1] == "6" ? "8" : "6"; });
}
void invent_a_barcode(const PlantedSet& set) {
  change_table(set, kSightings, [](std::vector<Cells>& rows) { rows[2][1] = rows[4][1] = "77"; });
}
void move_a_landmark(const PlantedSet& set) {
  change_table(set, kLandmarks, [](std::vector<Cells>& rows) { rows[2][1] = "2.4"; });
}
void lose_a_landmark(const PlantedSet& set) {
  change_table(set, kLandmarks, [](std::vector<Cells>& rows) { rows.pop_back(); });
}
void lose_a_barcode(const PlantedSet& set) {
  change_table(set, "Barcodes.dat", [](std::vector<Cells>& rows) { rows.pop_back(); });
}
void call_a_landmark_a_robot(const PlantedSet& set) {
  change_table(set, kLandmarks, [](std::vector<Cells>& rows) { rows[0][0] = "3"; });
}
void exchange_two_times(const PlantedSet& set) {
  change_table(set, kSightings, [](std::vector<Cells>& rows) { rows.back()[0] = "0.100000000"; });
}
void turn_odometry(const PlantedSet& set) {
  scale(set, kOdometry, {2}, -1.0);
}
void write_odometry_in_centimetres(const PlantedSet& set) {
  scale(set, kOdometry, {1}, 100.0);
}
void write_odometry_in_degrees(const PlantedSet& set) {
  scale(set, kOdometry, {2}, kDegrees);
}

constexpr LogCase kLogCases[] = {
    {"sign_of_bearings", turn_bearings, "Robot1_Measurement.dat: bearings have the other sign ("},
    {"degrees", write_bearings_in_degrees, "Robot1_Measurement.dat: bearings are in degrees ("},
    {"centimetres", write_ranges_in_centimetres, "Robot1_Measurement.dat: ranges are in centimetres ("},
    {"centimetres_of_poses", write_poses_in_centimetres,
     "Robot1_Groundtruth.dat: poses are in centimetres ("},
    {"centimetres_of_landmarks", write_landmarks_in_centimetres,
     "Robot1_Groundtruth.dat: landmarks are in centimetres ("},
    {"centimetres_of_all", write_world_in_centimetres,
     "Robot1_Groundtruth.dat: poses and landmarks are in centimetres ("},
    {"sign_of_headings", turn_headings, "Robot1_Groundtruth.dat: headings have the other sign ("},
    {"columns", swap_columns_of_sightings, "Robot1_Measurement.dat: range and bearing are swapped ("},
    {"axes", swap_axes_of_landmarks, "x and y of landmarks are swapped ("},
    {"late_poses", delay_true_poses, "Robot1_Groundtruth.dat: poses are a frame late, or sightings"},
    {"late_sightings", delay_sightings, "Robot1_Measurement.dat: sightings are a frame late, or poses"},
    {"lost_pose", lose_a_pose, "Robot1_Groundtruth.dat: frame 1.300000000: line 14: missing frame"},
    {"lost_file", lose_a_file, "Robot1_Groundtruth.dat: missing file: there are others of this robot"},
    {"nan", write_nan_of_range, "Robot1_Measurement.dat: frame 0.100000000: line 5: range [m]: expected"},
    {"nan_of_odometry", write_nan_of_odometry, "Robot1_Odometry.dat: frame 0.700000000: line 9: angular"},
    {"other_landmark", misname_a_sighting, "Robot1_Measurement.dat: frame 0.100000000: line 4: range 1.92"},
    {"no_barcode", invent_a_barcode, "line 4: barcode 77, which Barcodes.dat does not list (in 2 lines)"},
    {"moved_landmark", move_a_landmark, "Robot1_Measurement.dat: landmark 8: its 11 sightings are 0."},
    {"lost_landmark", lose_a_landmark,
     "Landmark_Groundtruth.dat: missing landmark: Barcodes.dat lists subject 10"},
    {"lost_barcode", lose_a_barcode,
     "Barcodes.dat: missing landmark: Landmark_Groundtruth.dat has subject 10"},
    {"robot", call_a_landmark_a_robot, "Landmark_Groundtruth.dat: subject 3 is a robot's"},
    {"time", exchange_two_times,
     "frame 0.100000000: time 100000000 ns is not after that of the frame before"},
    {"sign_of_odometry", turn_odometry, "Robot1_Odometry.dat: angular velocities have the other sign: -"},
    {"centimetres_of_odometry", write_odometry_in_centimetres,
     "Robot1_Odometry.dat: forward velocities are in centimetres: "},
    {"degrees_of_odometry", write_odometry_in_degrees,
     "Robot1_Odometry.dat: angular velocities are in degrees: "},
};

class PlantedInLog : public testing::TestWithParam<LogCase> {};

// Law: a fault that the format has redundancy for is found, and called what it is.
TEST_P(PlantedInLog, IsFoundAndNamed) {
  const PlantedSet set("mrclam");
  GetParam().plant(set);
  EXPECT_THAT(set.faults(), HasSubstr(GetParam().cause));
}

INSTANTIATE_TEST_SUITE_P(Faults, PlantedInLog, testing::ValuesIn(kLogCases),
                         [](const auto& test) { return std::string(test.param.name); });

// A cause of the whole file is one line: no sighting has one of its own besides.
TEST(LogFaults, AreNamedOnce) {
  for (const auto plant : {turn_bearings, write_ranges_in_centimetres, delay_sightings, move_a_landmark,
                           misname_a_sighting, lose_a_pose, turn_odometry}) {
    const PlantedSet set("mrclam");
    plant(set);
    const std::string faults = set.faults();
    EXPECT_EQ(std::ranges::count(faults, '\n'), 1) << faults;
  }
}

// Without names, the landmark that is nearest to a sighting is the one that was seen.
TEST(LogFaults, AreFoundWithoutIdentities) {
  for (const LogCase& planted : {LogCase{"", turn_bearings, "bearings have the other sign"},
                                 {"", write_ranges_in_centimetres, "ranges are in centimetres"},
                                 {"", delay_sightings, "sightings are a frame late"}}) {
    const PlantedSet set("mrclam");
    scale(set, kSightings, {1}, 0.0);
    EXPECT_EQ(set.faults(), "");
    planted.plant(set);
    EXPECT_THAT(set.faults(), HasSubstr(planted.cause));
  }
}

// MRCLAM's own folders: several robots, gzip, blanks of any number, and pictures of each other.
TEST(LogsOfOthers, HaveSeveralRobots) {
  const PlantedSet set("mrclam");
  for (const char* what : {"Odometry", "Measurement", "Groundtruth"}) {
    std::string text = set.text(fmt::format("Robot1_{}.dat", what));
    for (std::size_t at = 0; (at = text.find(' ', at)) != std::string::npos; at += 4)
      text.replace(at, 1, "   \t");
    set.write(fmt::format("Robot4_{}.dat", what), text);
  }
  EXPECT_EQ(set.faults(), "");
  turn_bearings(set);
  const std::string faults = set.faults();
  EXPECT_THAT(faults, HasSubstr("Robot1_Measurement.dat: bearings have the other sign"));
  EXPECT_THAT(faults, testing::Not(HasSubstr("Robot4")));
}

}  // namespace
}  // namespace stereobench::harness
