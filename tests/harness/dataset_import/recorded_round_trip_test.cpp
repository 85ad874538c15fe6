/// A drive that went into a bag or an MCAP file comes back with its log.
#include <gmock/gmock.h>

#include "tests/harness/dataset_import/carried.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A drive, and what may happen to it.
struct RecordedDrive {
  const char* name;
  std::vector<std::string> render;
};

void PrintTo(const RecordedDrive& drive, std::ostream* out) {
  *out << drive.name;
}

const std::vector<std::string> kFromZero = {"--epoch-s", "1500000000"};

// Begins at an angle whose quaternion is rounded.
const std::vector<std::string> kShortDrive = {
    "--set",
    "path={kind: polyline, points_m: [[0, 0], [0.5, 0.11], [0.4, 1.4]], corner_radius_m: 0.3, "
    "speed_mps: 1, step_s: 0.1}"};

class Recorded : public testing::TestWithParam<RecordedDrive> {
 protected:
  fs::path sets() const { return rendered(kBend, "plain,rosbag,mcap", with(kShortDrive, GetParam().render)); }
};

// Law: each table of the log has the bytes that it has in the plain folder; so has all that `slam` makes of
// it. Mutations: the true path by its quaternions; a message's speeds hold from it on; the covariance of
// range and bearing left out.
TEST_P(Recorded, LogIsThatOfThePlainFolder) {
  const TestFolder scratch;
  const auto slam = [&](const fs::path& log, const fs::path& out) {
    const Outcome outcome = run_stereobench({"slam", log.string(), "--filters", "ekf,fastslam2",
                                             "--particles", "10", "--seeds", "0,1", "--out", out.string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  };
  slam(sets() / "plain", scratch.path() / "wanted");
  for (const char* format : {"rosbag", "mcap"}) {
    const fs::path imported = scratch.path() / format / "plain";  // results are called as the folder
    import_to(imported, sets() / format, kFromZero);
    for (const char* table : {"odometry", "observations", "landmarks", "groundtruth", "instants"}) {
      const std::string file = std::string(table) + ".csv";
      EXPECT_EQ(first_difference(bytes_of(imported / file), bytes_of(sets() / "plain" / file)), "")
          << format << file;
    }
    slam(imported, scratch.path() / "out" / format);
    for (const char* file : {"run.json", "steps.csv"})
      EXPECT_EQ(first_difference(bytes_of(scratch.path() / "out" / format / file),
                                 bytes_of(scratch.path() / "wanted" / file)),
                "")
          << format << file;
  }
}

// Law: pictures have the numbers of their steps, so that `detect`, and `slam` with what it found, say the
// same. Mutations: pictures are numbered from 0; the pitch has the last digits of its quaternion.
TEST_P(Recorded, DetectionsAreThoseOfThePlainFolder) {
  const TestFolder scratch;
  const std::string plain = detected(sets() / "plain", {});
  ASSERT_THAT(plain, HasSubstr("range_m"));
  const fs::path found = scratch.write("found.jsonl", plain);
  const auto steps = [&](const fs::path& log, const fs::path& out) {
    const Outcome outcome =
        run_stereobench({"slam", log.string(), "--detections", found.string(), "--identity", "known",
                         "--filters", "ekf", "--out", out.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return bytes_of(out / "steps.csv");
  };
  const std::string wanted = steps(sets() / "plain", scratch.path() / "wanted");
  for (const char* format : {"rosbag", "mcap"}) {
    const fs::path imported = scratch.path() / format / "plain";
    import_to(imported, sets() / format, kFromZero);
    EXPECT_EQ(bytes_of(imported / "calibration.yaml"), bytes_of(sets() / "plain/calibration.yaml")) << format;
    EXPECT_EQ(
        first_difference(detected(imported, {"--ball-radius-m", "0.1", "--ball-radius-sd-m", "0"}), plain),
        "")
        << format;
    EXPECT_EQ(first_difference(steps(imported, scratch.path() / "out" / format), wanted), "") << format;
    for (const auto& picture : fs::directory_iterator(sets() / "plain/right"))
      EXPECT_EQ(bytes_of(imported / "right" / picture.path().filename()), bytes_of(picture.path())) << format;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Drives, Recorded,
    testing::Values(RecordedDrive{"whole", {}}, RecordedDrive{"some_frames", {"--frames", "3..9"}},
                    RecordedDrive{"with_lost_frames", {"--set", "shutter.drop_probability=0.3"}},
                    RecordedDrive{"pitched_behind_a_lens",
                                  {"--set", "rig.pitch_down_deg=5.3", "--set",
                                   "rig.distortion=[-0.2,0.05,0.001,0.0005,0.01]"}}),
    [](const auto& drive) { return std::string(drive.param.name); });

TEST(RecordedImport, SaysWhatItHas) {
  const fs::path sets = rendered(kBend, "plain,rosbag,mcap", kShortDrive);
  const TestFolder scratch;
  const Outcome outcome =
      run_stereobench({"import", (sets / "rosbag").string(), "--out", (scratch.path() / "in").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("recorded odometry readings, "));
  EXPECT_THAT(scratch.read("in/odometry.csv"), HasSubstr("\n1500000000.000000000,"));
  EXPECT_THAT(
      scratch.read("in/pictures.csv"),
      HasSubstr("\n0,1500000000.000000000,bend_0.bag/stereo/left/image_raw,bend_0.bag/stereo/right/"));
}

// Nothing of a container that is cut short is written.
TEST(RecordedImport, EndsInOneLineWhereTheContainerIsCutShort) {
  const fs::path sets = rendered(kBend, "plain,rosbag,mcap", kShortDrive);
  for (const auto& [format, name] : {std::pair("rosbag", "bend_0.bag"), std::pair("mcap", "bend_0.mcap")}) {
    const TestFolder folder, scratch;
    folder.write(name, bytes_of(sets / format / name).substr(0, 2'000'000));
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"verify", folder.path().string()},
          std::vector<std::string>{"import", folder.path().string(), "--out",
                                   (scratch.path() / "in").string()}}) {
      const Outcome outcome = run_stereobench(command);
      EXPECT_EQ(outcome.exit_code, 2) << format;
      EXPECT_THAT(outcome.err, HasSubstr(std::string(name) + ": byte "));
      EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    }
    EXPECT_FALSE(fs::exists(scratch.path() / "in"));
  }
}

}  // namespace
}  // namespace stereobench::harness
