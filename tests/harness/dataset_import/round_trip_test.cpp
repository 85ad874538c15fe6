/// What `render` writes in the layouts of others comes back by `import` as it was.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"
#include "tests/harness/dataset_import/carried.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// A drive, the layouts that can carry it, and what they cannot say of its rig.
struct Carried {
  const char* name;
  std::string formats;
  std::vector<std::string> render;
  std::vector<std::string> import;
};

void PrintTo(const Carried& carried, std::ostream* out) {
  *out << carried.name;
}

const std::vector<std::string> kWithTruth = {"--truth", "balls,disparity,flow"};
const std::vector<std::string> kBallsOfBend = {"--ball-radius-m", "0.1", "--ball-radius-sd-m", "0"};
const std::string kAllPairs =
    "plain,kitti-odometry,kitti-stereo,kitti-stereo-2012,kitti-scene-flow,euroc,middlebury,eth3d,sceneflow,"
    "vslamlab,rosbag,mcap,webdataset,colmap,bop,nerfstudio";

std::string without_last_line(const std::string& lines) {
  return lines.substr(0, lines.rfind('\n', lines.size() - 2) + 1);
}

fs::path rendered_bend(const std::string& formats, const std::vector<std::string>& more) {
  return rendered(kBend, formats, with({"--frames", "0..4"}, more));
}

class CarriedDrive : public testing::TestWithParam<Carried> {};

// Law: what `detect` finds in a folder that went through a layout and back is what it finds in the plain
// folder, to the byte. Layouts say nothing of balls, whose size is told; and those of one calibration a pair
// nothing of how the cameras look down. kitti-scene-flow has no pair of the last step, which leads nowhere.
// Mutations: a baseline that is P1[3] / f; the right camera's turn the other way round.
TEST_P(CarriedDrive, DetectWritesTheSameBytes) {
  const fs::path sets = rendered_bend(GetParam().formats, GetParam().render);
  const std::string plain = detected(sets / "plain", {});
  ASSERT_GT(std::ranges::count(plain, '\n'), 4);
  ASSERT_THAT(plain, testing::HasSubstr("range_m"));
  const TestFolder scratch;
  for (const std::string& format : names_in(GetParam().formats)) {
    if (format == "plain") continue;
    const fs::path imported = scratch.path() / format;
    import_to(imported, sets / format, GetParam().import);
    const std::string wanted = format == "kitti-scene-flow" ? without_last_line(plain) : plain;
    EXPECT_EQ(first_difference(detected(imported, kBallsOfBend), wanted), "") << format;
    EXPECT_EQ(bytes_of(imported / "right/000001.png"), bytes_of(sets / "plain/right/000001.png")) << format;
  }
}

// f B is rounded, and divided by f it is no longer B.
// Places whose first pixel is (0.5, 0.5) are rounded, and half a pixel less they are others.
const std::vector<std::string> kOddRig = {"--set", "rig.focal_px=281.37", "--set", "rig.baseline_m=0.1201",
                                          "--set", "rig.cx_px=127.7",     "--set", "rig.cy_px=127.61"};

INSTANTIATE_TEST_SUITE_P(
    RoundTrip, CarriedDrive,
    testing::Values(Carried{"level", kAllPairs, with(kOddRig, kWithTruth), {}},
                    Carried{"pitched_as_the_layout_says",
                            "plain,euroc,rosbag,mcap,webdataset",
                            {"--set", "rig.pitch_down_deg=7.3"},
                            {}},
                    Carried{"pitched_as_is_told",
                            kAllPairs,
                            with({"--set", "rig.pitch_down_deg=7.3"}, kWithTruth),
                            {"--pitch-down-deg", "7.3"}},
                    Carried{"turned",
                            "plain,euroc,vslamlab,webdataset,colmap,bop,nerfstudio",
                            {"--set", "rig.right_turn_deg=[0.3,-0.2,0.1]"},
                            {}},
                    Carried{"behind_lenses",
                            "plain,euroc,vslamlab,rosbag,mcap,webdataset,colmap,nerfstudio",
                            {"--set", "rig.distortion=[-0.2,0.05,0.001,0.0005,0]", "--set",
                             "rig.pixel_aspect=1.01"},
                            {}},
                    Carried{"behind_lenses_with_k3",
                            "plain,vslamlab,rosbag,mcap,webdataset,colmap,nerfstudio",
                            {"--set", "rig.distortion=[-0.2,0.05,0.001,0.0005,0.01]"},
                            {}},
                    // A shard says what vision is told, and when each camera looked.
                    Carried{"told_another_rig_and_late",
                            "plain,webdataset",
                            {"--set", "believed_rig={focal_px: 283.1, pitch_down_deg: 0.7}", "--set",
                             "shutter={right_delay_s: 0.004, late_probability: 0.5, late_s: 0.03}"},
                            {}}),
    [](const auto& carried) { return std::string(carried.param.name); });

// TUM has one camera.
TEST(RoundTrip, OneCameraGivesTheSameOutlines) {
  const fs::path sets = rendered_bend("plain,tum", {});
  const TestFolder scratch;
  import_to(scratch.path() / "tum", sets / "tum");
  const auto outlines = [&](const fs::path& folder) {
    return detected(folder / "left", with({"--rig", (folder / "calibration.yaml").string()}, kBallsOfBend));
  };
  const std::string lines = outlines(scratch.path() / "tum");
  EXPECT_EQ(lines, outlines(sets / "plain"));
  EXPECT_THAT(lines, testing::HasSubstr("colour"));
}

nlohmann::json slam_of(const fs::path& log, const std::string& detections, const fs::path& out) {
  const Outcome outcome =
      run_stereobench({"slam", log.string(), "--detections", detections, "--identity", "known", "--filters",
                       "ekf", "--odometry-delay-s", "0", "--out", out.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(bytes_of(out / "run.json"));
}

/// The numbers of a table's rows.
std::vector<std::vector<double>> rows_of(const fs::path& table) {
  std::istringstream lines(bytes_of(table));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(lines, line);  // header
  while (std::getline(lines, line)) {
    rows.emplace_back();
    for (const std::string& cell : names_in(line)) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

/// The plain folder with odometry that follows its true path: chord and turn of each step, by hand.
void drive_exactly(const fs::path& folder) {
  const auto truth = rows_of(folder / "groundtruth.csv");
  std::string odometry = "t_s,v_mps,w_radps\n";
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const auto &from = truth[i - 1], &to = truth[i];
    const double lasts_s = to[0] - from[0], turn = std::remainder(to[3] - from[3], 2.0 * M_PI);
    const double middle = from[3] + 0.5 * turn;  // wheels move along the direction half way of the turn
    const double chord_m = (to[1] - from[1]) * std::cos(middle) + (to[2] - from[2]) * std::sin(middle);
    const double arc_m = turn == 0.0 ? chord_m : chord_m * 0.5 * turn / std::sin(0.5 * turn);
    odometry += fmt::format("{:.9f},{},{}\n", from[0], arc_m / lasts_s, turn / lasts_s);
  }
  fs::remove(folder / "manifest-sha256.txt");
  std::ofstream(folder / "odometry.csv", std::ios::binary) << odometry;
}

// Law: poses, times and detections that went through a layout and back give the filters what the plain
// folder's give them, where its odometry is exact as well. Poses are equal to the last digits of quaternions
// and matrices, not to the byte: poses are held to 1e-12, what filters make of them to a part in 1e9.
// Mutation: the robot at the left camera.
TEST(RoundTrip, SlamOnTruePathsFindsTheSame) {
  const TestFolder scratch;
  // All of the drive: the plain folder's log has every step, with a picture or not.
  const std::vector<std::string> short_drive = {
      "--set",
      "path={kind: polyline, points_m: [[0, 0], [0.5, 0], [0.5, 1.4]], corner_radius_m: 0.3, "
      "speed_mps: 1, step_s: 0.1}"};
  const fs::path sets = rendered(kBend, "plain,euroc,kitti-odometry,vslamlab,webdataset", short_drive);
  const fs::path plain = scratch.path() / "plain";
  fs::copy(sets / "plain", plain, fs::copy_options::recursive);
  drive_exactly(plain);
  const fs::path detections = scratch.write("found.jsonl", detected(plain, {}));
  const auto wanted = slam_of(plain, detections, scratch.path() / "wanted")["filters"]["ekf"];
  EXPECT_LT(wanted["ate_rms_m"]["mean"].get<double>(), 0.01);
  EXPECT_GT(wanted["ate_rms_m"]["mean"].get<double>(), 1e-6);
  for (const char* format : {"euroc", "kitti-odometry", "vslamlab", "webdataset"}) {
    const fs::path imported = scratch.path() / format;
    import_to(imported, sets / format, {"--odometry-from-truth"});
    const auto found = slam_of(imported, detections, scratch.path() / "out" / format)["filters"]["ekf"];
    for (const char* metric : {"ate_rms_m", "heading_rms_rad", "anees"})
      EXPECT_NEAR(found[metric]["mean"].get<double>() / wanted[metric]["mean"].get<double>(), 1.0, 1e-9)
          << format << " " << metric;
    const auto poses = rows_of(imported / "groundtruth.csv"), true_poses = rows_of(plain / "groundtruth.csv");
    ASSERT_EQ(poses.size(), true_poses.size()) << format;
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (std::size_t k = 1; k < 4; ++k)
        EXPECT_NEAR(poses[i][k], true_poses[i][k], 1e-12) << format << " " << i << " " << k;
  }
}

TEST(RoundTrip, WhatALayoutCannotSayIsRefused) {
  const fs::path sets = rendered_bend(kAllPairs, with(kOddRig, kWithTruth));
  const TestFolder scratch;
  const std::string out = (scratch.path() / "out").string();
  const auto complaint = [&](const std::string& format, const std::vector<std::string>& more) {
    const Outcome outcome = run_stereobench(with({"import", (sets / format).string(), "--out", out}, more));
    EXPECT_EQ(outcome.exit_code, 2) << format;
    EXPECT_FALSE(fs::exists(out)) << format;
    return outcome.err;
  };
  using testing::HasSubstr;
  EXPECT_THAT(complaint("plain", {}), HasSubstr("`detect` and `slam` read as it is"));
  EXPECT_THAT(complaint("middlebury", {"--odometry-from-truth"}),
              HasSubstr("there are no times (format middlebury)"));
  EXPECT_THAT(complaint("euroc", {"--only", "cam7"}), HasSubstr("no frame of --only cam7 has its pictures"));
  EXPECT_THAT(complaint("euroc", {"--as", "mp4"}), HasSubstr("no format is called 'mp4'"));
  import_to(out, sets / "euroc");
  const Outcome again = run_stereobench({"import", (sets / "euroc").string(), "--out", out});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("writes into a new folder"));
  const Outcome slam = run_stereobench({"slam", out});
  EXPECT_EQ(slam.exit_code, 2);
  EXPECT_THAT(slam.err, HasSubstr("expected odometry.csv"));
}

}  // namespace
}  // namespace stereobench::harness
