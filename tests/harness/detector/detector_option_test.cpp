/// People's own detectors, as people run them: a program in place of ours, and files made elsewhere.
#include <algorithm>
#include <chrono>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kServe = std::string(STEREOBENCH_PROGRAM) + " detect --serve";

/// A drive of three pairs in small pictures, in a scenario of its own, so that shell commands need no
/// quoting.
std::vector<std::string> small_drive(const TestFolder& scratch, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run",         scenario_path("ball_circle"),
                                        "--set",       "path.laps=0.06",
                                        "--set",       "rig.width_px=256",
                                        "--set",       "rig.height_px=192",
                                        "--set",       "rig.focal_px=222",
                                        "--set",       "gates=[]",
                                        "--seeds",     "0",
                                        "--particles", "5",
                                        "--filters",   "dead_reckoning",
                                        "--out",       (scratch.path() / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

nlohmann::json run_json_of(const TestFolder& scratch) {
  return nlohmann::json::parse(bytes_of(scratch.path() / "out/run.json"));
}

// The strongest law of the protocol: our own detector, asked through it, gives what it gives in the process,
// byte for byte, but for its name; with any jobs, a camera that encodes, and a rig that is not as it is
// believed to be. Mutations, some tried together: a range of six digits; the setup's encoding not read, or
// its noise; cameras swapped in the reader.
TEST(DetectorProgram, OursThroughTheProtocolGivesTheSameBytes) {
  const TestFolder scratch;
  const auto run = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"run",
                                          scenario_path("ball_circle"),
                                          "--set",
                                          "path.laps=0.12",
                                          "--set",
                                          "camera={noise_sd_levels: 3, encoding: gamma, gamma: 1.8}",
                                          "--set",
                                          "believed_rig={baseline_m: 0.121, pitch_down_deg: 0.3, "
                                          "right_turn_deg: [1.2, 0, 0], rows_within_px: 25}",
                                          "--set",
                                          "gates=[]",
                                          "--seeds",
                                          "0..1",
                                          "--particles",
                                          "20",
                                          "--out",
                                          (scratch.path() / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_stereobench(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  };
  run("ours", {});
  run("theirs", {"--detector", kServe, "--jobs", "2"});
  auto ours = nlohmann::ordered_json::parse(bytes_of(scratch.path() / "ours/run.json"));
  const auto theirs = nlohmann::ordered_json::parse(bytes_of(scratch.path() / "theirs/run.json"));
  EXPECT_EQ(ours["detector"], "stereobench");
  EXPECT_EQ(theirs["detector"], kServe);
  EXPECT_GT(theirs["vision"]["found"].get<int>(), 10);
  ours["detector"] = kServe;
  ours["made_from"]["scenario_sha256"] = theirs["made_from"]["scenario_sha256"];  // it names the detector
  EXPECT_EQ(ours.dump(2), theirs.dump(2));
  for (const char* file : {"steps.csv", "map.png", "error.png", "frames/seed0_step0000.png"})
    EXPECT_EQ(bytes_of(scratch.path() / "ours" / file), bytes_of(scratch.path() / "theirs" / file)) << file;
}

struct Misbehaviour {
  std::string kind;
  std::string command;  ///< of the shell
  std::string message;
};
void PrintTo(const Misbehaviour& bad, std::ostream* out) {
  *out << bad.kind;
}
class MisbehavingDetector : public testing::TestWithParam<Misbehaviour> {};

/// Folders of pictures that runs have left in a place for temporary files.
long left_in(const std::filesystem::path& folder) {
  const auto entries = std::filesystem::directory_iterator(folder);
  return std::count_if(begin(entries), end(entries), [](const auto& entry) {
    return entry.path().filename().string().starts_with("stereobench_detector_");
  });
}

// Mutations: the frame's number not looked at; what comes after the last frame, or how it ended, not looked
// at; told as bad input.
TEST_P(MisbehavingDetector, EndsTheRunWithFourAndOneLineAndNothingLeft) {
  const TestFolder scratch;
  const auto began = std::chrono::steady_clock::now();
  const Outcome outcome = run_stereobench(
      small_drive(scratch,
                  {"--detector", GetParam().command, "--detector-timeout-s", "1", "--detector-start-s", "3"}),
      {"TMPDIR=" + scratch.path().string()});
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(15));
  EXPECT_EQ(outcome.exit_code, 4) << outcome.out;
  EXPECT_THAT(outcome.err, StartsWith("stereobench: detector '"));
  const std::string first_line = outcome.err.substr(0, outcome.err.find('\n'));
  EXPECT_THAT(first_line, HasSubstr(GetParam().message));
  EXPECT_LT(first_line.size(), 700U);
  EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 11) << outcome.err;
  EXPECT_EQ(left_in(scratch.path()), 0);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out/run.json"));
}

/// A detector that finds nothing in each frame until it does something else in frame 1.
std::string then(const std::string& in_frame_1) {
  return "read setup; read frame; echo '{\"frame\": 0, \"balls\": []}'; read frame; " + in_frame_1;
}
/// A detector that finds nothing in all frames, and something else when they are over.
std::string in_the_end(const std::string& last) {
  return "read setup; n=0; while read frame; do echo \"{\\\"frame\\\": $n, \\\"balls\\\": []}\"; n=$((n+1)); "
         "done; " +
         last;
}

// Libraries and models take their time to load, which is told apart from the time for a frame. Mutations: the
// first frame as any other; a start of four timeouts, whatever is asked for; the scenario's line not read.
TEST(DetectorProgram, HasATimeOfItsOwnToStart) {
  const TestFolder scratch;
  const auto run = [&](const std::string& seconds, const std::vector<std::string>& options) {
    std::vector<std::string> words = {"--detector", "sleep " + seconds + "; " + in_the_end("exit 0"),
                                      "--detector-timeout-s", "1"};
    words.insert(words.end(), options.begin(), options.end());
    return run_stereobench(small_drive(scratch, words));
  };
  EXPECT_EQ(run("5", {}).exit_code, 0) << "90 s by default";
  EXPECT_EQ(run("5", {"--detector-start-s", "20"}).exit_code, 0);
  EXPECT_EQ(run("5", {"--set", "detector_start_s=1", "--detector-start-s", "20"}).exit_code, 0);
  const Outcome late = run("3", {"--set", "detector_start_s=0.5"});
  EXPECT_EQ(late.exit_code, 4);
  EXPECT_THAT(late.err, HasSubstr("within 1.5 s, 0.5 to start and 1 for a frame (none came)"));
  EXPECT_EQ(run("3", {"--detector-start-s", "0"}).exit_code, 4);
  EXPECT_EQ(run("3", {"--detector-start-s", "-1"}).exit_code, 2);
}

// The line of a traceback that tells is seldom the last one. Mutation: the last line alone.
TEST(DetectorProgram, ThatFailsShowsTheLastTenLinesOfItsErrors) {
  const TestFolder scratch;
  const std::string script = scratch.write(
      "fails.sh", "for i in 1 2 3 4 5 6 7 8 9 10 11 12; do echo \"  line $i\" >&2; done; exit 1\n");
  const Outcome outcome = run_stereobench(small_drive(scratch, {"--detector", "sh " + script}));
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("; its last error: line 12\n      line 3\n      line 4\n"));
  EXPECT_THAT(outcome.err, testing::EndsWith("\n      line 12\n"));
}

INSTANTIATE_TEST_SUITE_P(
    All, MisbehavingDetector,
    testing::Values(
        Misbehaviour{"Hangs", "exec sleep 60",
                     "seed 0, frame 0: expected a line of detections within 4 s, 3 to start and 1 for a "
                     "frame (none came)"},
        Misbehaviour{"HangsLater", then("exec sleep 60"),
                     "frame 1: expected a line of detections within 1 s"},
        Misbehaviour{"HangsAndIgnoresSignals", "trap '' TERM INT HUP PIPE; while :; do sleep 1; done",
                     "within 4 s"},
        Misbehaviour{"Crashes", then("kill -SEGV $$"),
                     "frame 1: expected a line of detections (it ended with signal 11"},
        Misbehaviour{"CrashesWithWords",
                     then("echo Traceback >&2; echo ValueError: no balls >&2; echo >&2; exit 1"),
                     "(it ended with exit status 1); its last error: ValueError: no balls"},
        Misbehaviour{"EndsAtOnce", "true",
                     "frame 0: expected a line of detections (it ended with exit status 0"},
        Misbehaviour{"EndsInTheMiddleOfALine", then("printf '{\"frame\": 1, '"),
                     "in the middle of '{\"frame\": 1, '"},
        Misbehaviour{"ClosesItsOutput", then("exec 1>&-; exec sleep 60"), "(it closed its output)"},
        Misbehaviour{"SaysHello", "echo loading the model; cat",
                     "frame 0: expected a line of JSON (got 'loading the"},
        Misbehaviour{"EchoesItsInput", "cat", "frame 0: ball_radius_m: unknown key"},
        Misbehaviour{"AnswersNaN",
                     then("echo '{\"frame\": 1, \"balls\": [{\"colour\": 1, \"range_m\": NaN}]}'"),
                     "frame 1: expected a line of JSON"},
        Misbehaviour{
            "AnswersNegativeRange",
            then("echo '{\"frame\": 1, \"balls\": [{\"colour\": 1, \"range_m\": -1, \"bearing_rad\": 0}]}'"),
            "frame 1: balls[0].range_m: expected a number"},
        Misbehaviour{"AnswersTwice",
                     then("echo '{\"frame\": 1, \"balls\": []}'; echo '{\"frame\": 1, \"balls\": []}'; cat"),
                     "frame 2: frame: expected 2 (got 1)"},
        Misbehaviour{"AnswersAhead", then("echo '{\"frame\": 2, \"balls\": []}'; cat"),
                     "frame 1: frame: expected 1 (got 2)"},
        Misbehaviour{"MegabytesInALine", then("head -c 3000000 /dev/zero; exec sleep 60"),
                     "frame 1: expected a line of at most 1048576 bytes"},
        Misbehaviour{"EndlessOutput", "yes", "expected a line of JSON (got 'y')"},
        Misbehaviour{"EndlessErrors", "yes oh dear >&2", "1 for a frame (none came); its last error: "},
        Misbehaviour{"SpeaksInTheEnd", in_the_end("echo done"),
                     "after the last frame: expected one line a frame and no more (got 'done'"},
        Misbehaviour{
            "FailsInTheEnd", in_the_end("echo oh >&2; exit 3"),
            "after the last frame: expected exit status 0 (it ended with exit status 3); its last error: oh"},
        Misbehaviour{"DoesNotEnd", in_the_end("exec sleep 60"),
                     "after the last frame: expected it to end within 1 s"}),
    [](const auto& test) { return test.param.kind; });

TEST(DetectorProgram, ThatFindsNothingIsScoredSo) {
  const TestFolder scratch;
  const Outcome outcome = run_stereobench(small_drive(scratch, {"--set", "detector=sh no_such_script.sh"}));
  EXPECT_EQ(outcome.exit_code, 4);  // there is no such script
  const std::string script = scratch.write("blind.sh", in_the_end("exit 0"));
  const Outcome blind = run_stereobench(small_drive(scratch, {"--set", "detector=sh " + script}));
  EXPECT_EQ(blind.exit_code, 0) << blind.err;
  const auto json = run_json_of(scratch);
  EXPECT_EQ(json["detector"], "sh " + script);
  EXPECT_EQ(json["vision"]["found"], 0);
  EXPECT_GT(json["vision"]["visible"].get<int>(), 0);
}

TEST(DetectorProgram, ThatCannotBeStartedIsBadInput) {
  const TestFolder scratch;
  const std::string no_program = scratch.write("no_program", "");
  for (const std::string& command : {std::string("no_such_detector --fast"), no_program}) {
    const Outcome outcome = run_stereobench(small_drive(scratch, {"--detector", command}));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("cannot be started"));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  const Outcome oracle = run_stereobench(
      {"run", scenario_path("open_field"), "--detector", "cat", "--out", scratch.path().string()});
  EXPECT_EQ(oracle.exit_code, 2);
  EXPECT_THAT(oracle.err, HasSubstr("the oracle, which has no pictures"));
}

// Range and bearing alone do, too: told from the scenario's balls by their colour, and scored.
// Mutation: scored by the pixels that are made up for it, at the cameras' height.
TEST(DetectorProgram, RangeAndBearingAloneAreScored) {
  const TestFolder scratch;
  const std::string script =
      scratch.write("strip.sh", kServe + R"( | sed -u -E 's/,"left_px":\[[^]]*\],"right_px":\[[^]]*\]//g')"
                                         R"( | sed -u -E 's/,"(left|right)_radius_px":[^,}]*//g')");
  const Outcome outcome = run_stereobench(small_drive(scratch, {"--detector", "sh " + script}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto stripped = run_json_of(scratch)["vision"];
  EXPECT_EQ(run_stereobench(small_drive(scratch, {})).exit_code, 0);
  const auto whole = run_json_of(scratch)["vision"];
  EXPECT_TRUE(stripped["disparity_rms_px"].is_null());
  for (const char* key :
       {"recall", "precision", "range_rms_m", "bearing_rms_rad", "normalised_error", "found"})
    EXPECT_EQ(stripped[key], whole[key]) << key;
}

// The example that people copy: it works, and it is a simple one. Skipped without Debian's python3-opencv.
TEST(ExampleDetector, FindsWhatASimpleOneCan) {
  if (std::system("/usr/bin/python3 -c 'import cv2' 2>/dev/null") != 0) GTEST_SKIP() << "no python3-opencv";
  const TestFolder scratch;
  const Outcome outcome = run_stereobench(
      {"run", scenario_path("ball_circle"), "--set", "path.laps=0.15", "--set", "gates=[]", "--seeds", "0",
       "--particles", "20", "--out", (scratch.path() / "out").string(), "--detector",
       "/usr/bin/python3 " STEREOBENCH_SOURCE_DIR "/assets/detectors/colour_blobs.py"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = run_json_of(scratch);
  EXPECT_GE(json["vision"]["recall"].get<double>(), 0.9);
  EXPECT_EQ(json["vision"]["precision"], 1.0);
  EXPECT_LE(json["vision"]["disparity_rms_px"].get<double>(), 0.1);
  EXPECT_LT(json["filters"]["ufastslam"]["ate_rms_m"]["mean"].get<double>(),
            json["filters"]["dead_reckoning"]["ate_rms_m"]["mean"].get<double>());
}

}  // namespace
}  // namespace stereobench::harness
