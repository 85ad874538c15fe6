#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"
#include "tests/harness/verify/planted_recording.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

/// A drive that formats take as it is.
struct CleanCase {
  const char* name;
  std::string scenario;
  std::string formats;
  std::vector<std::string> arguments;
  bool is_known_by_dataset_json = false;  ///< that rows roll, or that the right camera looks later
};

void PrintTo(const CleanCase& clean, std::ostream* out) {
  *out << clean.name;
}

const std::vector<std::string> kSmall = {
    "--frames",          "0..2",  "--set",           "rig.width_px=320", "--set",
    "rig.height_px=240", "--set", "rig.focal_px=280"};

/// Sixteen frames, of which some are late and some are lost.
const std::vector<std::string> kManyFrames = {"--frames", "0..15",
                                              "--set",    "shutter.drop_probability=0.3",
                                              "--set",    "shutter.late_probability=0.3",
                                              "--set",    "shutter.late_s=0.03"};

/// @param more behind a small rig
std::vector<std::string> small_rig(const std::vector<std::string>& more) {
  return with(kSmall, more);
}

class Clean : public testing::TestWithParam<CleanCase> {};

// Law: a set that is as it should be has no faults, with dataset.json and without, in any format, noise and
// all.
TEST_P(Clean, HasNoFaults) {
  const std::filesystem::path folder =
      rendered(GetParam().scenario, GetParam().formats, GetParam().arguments);
  std::istringstream names(GetParam().formats);
  const bool is_one = GetParam().formats.find(',') == std::string::npos;
  for (std::string format; std::getline(names, format, ',');) {
    const std::filesystem::path set = is_one ? folder : folder / format;
    EXPECT_EQ(reader_of(set).format, format);
    EXPECT_EQ(faults_of(set, format), "") << format;
    if (GetParam().is_known_by_dataset_json) continue;
    const TestFolder copy;  // other tests share the set
    std::filesystem::copy(set, copy.path() / "set", std::filesystem::copy_options::recursive);
    for (const char* name : {"dataset.json", "manifest-sha256.txt"})
      std::filesystem::remove(copy.path() / "set" / name);
    EXPECT_EQ(faults_of(copy.path() / "set", format), "") << format << ", without dataset.json";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sets, Clean,
    testing::Values(
        CleanCase{"bend_of_few_frames",
                  kBend,
                  kAllFormats,
                  {"--frames", "3..5", "--truth", "balls,disparity,flow,range"}},
        CleanCase{"ball_circle", scenario_path("ball_circle"), kAllFormats,
                  small_rig({"--set", "path.laps=0.2", "--truth", "balls,disparity,flow,range"})},
        CleanCase{"corridor", scenario_path("corridor"), kAllFormats,
                  small_rig({"--truth", "balls,disparity,flow"})},
        CleanCase{"office", scenario_path("office"), kAllFormats,
                  small_rig({"--truth", "balls,disparity,flow"})},
        CleanCase{"scenes_of_few_frames", kBend, kSceneFormats, {"--frames", "3..5"}},
        CleanCase{"scenes_of_ball_circle", scenario_path("ball_circle"), kSceneFormats,
                  small_rig({"--set", "path.laps=0.2"})},
        CleanCase{"scenes_of_an_office", scenario_path("office"), kSceneFormats, small_rig({})},
        CleanCase{"scenes_with_lens_and_turned_camera",
                  kBend,
                  "colmap,nerfstudio",
                  {"--frames", "2..5", "--set", "rig.distortion=[-0.2, 0.05, 0.001, -0.001, 0.01]", "--set",
                   "rig.right_turn_deg=[0.4, -0.3, 0.5]", "--set", "rig.pitch_down_deg=8"}},
        CleanCase{"scenes_with_late_and_lost_frames", kBend, kSceneFormats,
                  with(kManyFrames, {"--set", "shutter.right_delay_s=0.01"})},
        CleanCase{"recordings", kBend, kRecordings, {"--frames", "2..7"}},
        CleanCase{"recordings_behind_a_lens",
                  kBend,
                  kRecordings,
                  {"--frames", "0..15", "--set", "rig.distortion=[-0.2, 0.05, 0.001, -0.001, 0.01]", "--set",
                   "rig.pitch_down_deg=8", "--set", "shutter.drop_probability=0.3"}},
        CleanCase{"recordings_of_ball_circle", scenario_path("ball_circle"), kRecordings,
                  small_rig({"--set", "path.laps=0.2"})},
        CleanCase{"levels_of_kitti",
                  kBend,
                  "plain",
                  {"--frames", "3..5", "--truth", "balls,disparity,flow", "--truth-format", "kitti"}},
        CleanCase{"floats_of_tiff",
                  kBend,
                  "plain",
                  {"--frames", "3..5", "--truth", "range,disparity,flow", "--truth-format", "tiff"}},
        // A floor that comes nearer: corners of it are all found a tenth of a pixel too far down.
        CleanCase{"floor_straight_ahead", scenario_path("corridor"), "euroc", {"--frames", "0..4"}},
        CleanCase{"lens_and_turned_camera",
                  kBend,
                  "plain,euroc,tum,vslamlab",
                  {"--frames", "2..7", "--set", "rig.distortion=[-0.2, 0.05, 0.001, -0.001, 0]", "--set",
                   "rig.right_turn_deg=[0.4, -0.3, 0.5]", "--set", "rig.pitch_down_deg=8", "--truth",
                   "disparity,flow,range"}},
        CleanCase{"rolling_shutter",
                  kBend,
                  "plain",
                  {"--frames", "3..5", "--set", "shutter.readout_s=0.02", "--truth", "range"},
                  true},
        CleanCase{"shards_and_log_of_few_frames", kBend, kShardsAndLogs, {"--frames", "3..5"}},
        CleanCase{"shards_and_log_of_ball_circle", scenario_path("ball_circle"), kShardsAndLogs,
                  small_rig({"--set", "path.laps=0.2"})},
        CleanCase{"shards_and_log_of_a_corridor", scenario_path("corridor"), kShardsAndLogs, small_rig({})},
        CleanCase{"shards_and_log_of_an_office", scenario_path("office"), kShardsAndLogs, small_rig({})},
        CleanCase{"shards_and_log_with_lens_and_turned_camera",
                  kBend,
                  kShardsAndLogs,
                  {"--frames", "2..5", "--set", "rig.distortion=[-0.2, 0.05, 0.001, -0.001, 0.01]", "--set",
                   "rig.right_turn_deg=[0.4, -0.3, 0.5]", "--set", "rig.pitch_down_deg=8"}},
        CleanCase{"shards_and_log_of_late_cameras",
                  kBend,
                  kShardsAndLogs,
                  {"--set", "shutter.drop_probability=0.3", "--set", "shutter.late_probability=0.3", "--set",
                   "shutter.late_s=0.03", "--set", "shutter.right_delay_s=0.01", "--set", "path.overlap_m=0"},
                  true},
        CleanCase{"known_log", kBend, "mrclam", kLogFrames},
        CleanCase{"late_and_lost_frames", kBend, "plain,kitti-stereo-2012",
                  with(kManyFrames, {"--set", "path.overlap_m=0", "--truth", "balls,disparity"})},
        CleanCase{
            "right_camera_late",
            kBend,
            "plain",
            {"--frames", "2..5", "--set", "shutter.right_delay_s=0.01", "--truth", "balls,disparity,flow"}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace stereobench::harness
