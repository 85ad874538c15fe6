/// Every kind of bad input ends in exit 2, one clear line, and no half-written file.
#include <algorithm>
#include <functional>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A small scenario that is right; each case breaks one thing in it.
constexpr const char* kScenario = R"(name: tiny
seeds: 0..1
particles: 5
sensor: oracle
identity: known
oracle: {range_sd_m: 0.1, bearing_sd_deg: 1, max_range_m: 10, field_of_view_deg: 180}
odometry_noise: {v_per_v: 0.1, w_per_w: 0.1}
path: {kind: circle, radius_m: 1, speed_mps: 0.5, laps: 0.1, step_s: 0.1}
world:
  balls:
    - {colour: 0, at_m: [2, 0, 0.1]}
    - {colour: 1, at_m: [0, 2, 0.1]}
)";

struct BadScenario {
  std::string kind;
  std::string from;  ///< replaced by `to` in the scenario
  std::string to;
  std::string message;  ///< part of the one line
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool is_empty_or_missing(const std::filesystem::path& folder) {
  return !std::filesystem::exists(folder) || std::filesystem::is_empty(folder);
}

void expect_bad_input(const Outcome& outcome, const std::string& message) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
  EXPECT_EQ(lines_of(outcome.err), 1u) << outcome.err;
  EXPECT_THAT(outcome.err, StartsWith("stereobench: "));
  EXPECT_THAT(outcome.err, HasSubstr(message));
}

void PrintTo(const BadScenario& bad, std::ostream* out) {
  *out << bad.kind;
}

class BadScenarioTest : public testing::TestWithParam<BadScenario> {};

TEST_P(BadScenarioTest, IsOneLineThatNamesFileLineAndKey) {
  const TestFolder scratch;
  const std::string file = scratch.write("tiny.yaml", replaced(kScenario, GetParam().from, GetParam().to));
  const std::filesystem::path out = scratch.path() / "out";
  const Outcome outcome = run_stereobench({"run", file, "--out", out.string()});
  expect_bad_input(outcome, GetParam().message);
  EXPECT_THAT(outcome.err, HasSubstr("tiny.yaml:"));
  EXPECT_TRUE(is_empty_or_missing(out));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadScenarioTest,
    testing::Values(
        BadScenario{"UnknownKey", "particles: 5", "partcles: 5", "tiny.yaml:3: partcles"},
        BadScenario{"RepeatedKey", "particles: 5", "particles: 5\nparticles: 6", "particles"},
        BadScenario{"MissingKey", "identity: known\n", "", "identity"},
        BadScenario{"TextForNumber", "radius_m: 1", "radius_m: wide", "tiny.yaml:8: path.radius_m"},
        BadScenario{"NumberForMap", "odometry_noise: {v_per_v: 0.1, w_per_w: 0.1}", "odometry_noise: 3",
                    "odometry_noise"},
        BadScenario{"NegativeRadius", "radius_m: 1", "radius_m: -1", "path.radius_m"},
        BadScenario{"ZeroStep", "step_s: 0.1", "step_s: 0", "path.step_s"},
        BadScenario{"NanSpeed", "speed_mps: 0.5", "speed_mps: .nan", "path.speed_mps"},
        BadScenario{"InfiniteSpeed", "speed_mps: 0.5", "speed_mps: .inf", "path.speed_mps"},
        BadScenario{"NegativeNoise", "v_per_v: 0.1", "v_per_v: -0.1", "odometry_noise.v_per_v"},
        BadScenario{"ZeroParticles", "particles: 5", "particles: 0", "particles"},
        BadScenario{"FractionOfAParticle", "particles: 5", "particles: 5.5", "particles"},
        BadScenario{"BackwardSeeds", "seeds: 0..1", "seeds: 3..1", "seeds"},
        BadScenario{"NegativeSeed", "seeds: 0..1", "seeds: -1", "seeds"},
        BadScenario{"TooManySeeds", "seeds: 0..1", "seeds: 0..99999999999", "seeds"},
        BadScenario{"UnknownSensor", "sensor: oracle", "sensor: sonar", "sensor"},
        BadScenario{"UnknownIdentity", "identity: known", "identity: guessed", "identity"},
        BadScenario{"UnknownPath", "kind: circle", "kind: spiral", "path.kind"},
        BadScenario{"UnknownColour", "colour: 1", "colour: 18", "world.balls[1].colour"},
        BadScenario{"BallOfTwoCoordinates", "[2, 0, 0.1]", "[2, 0]", "world.balls[0].at_m"},
        BadScenario{"BallBelowTheFloor", "[2, 0, 0.1]", "[2, 0, -1]", "world.balls[0].at_m"},
        BadScenario{"NoBalls",
                    "  balls:\n    - {colour: 0, at_m: [2, 0, 0.1]}\n    - {colour: 1, at_m: [0, 2, 0.1]}",
                    "  balls: []", "world.balls"},
        BadScenario{"StereoWithoutRig", "sensor: oracle", "sensor: stereo", "rig"},
        BadScenario{"MissingMesh", "world:\n", "world:\n  meshes: [{file: none.obj, at_m: [0, 0, 0]}]\n",
                    "world.meshes[0].file"},
        BadScenario{"UnknownMaterial", "world:\n", "world:\n  floor: lava\n", "world.floor"},
        BadScenario{"WallOfOnePoint", "world:\n", "world:\n  walls: [{corners_m: [[0, 0]]}]\n",
                    "world.walls[0].corners_m"},
        BadScenario{"GateWithoutLimit", "seeds: 0..1", "gates: [{metric: vision.recall}]", "gates[0]"},
        BadScenario{"BadName", "name: tiny", "name: ../tiny", "name"},
        BadScenario{"NotYaml", "particles: 5", "particles: [5", "tiny.yaml:"},
        BadScenario{"UnknownFilter", "seeds: 0..1", "filters: [kalmann]", "filters[0]"}),
    [](const auto& test) { return test.param.kind; });

struct BadCall {
  std::string kind;
  std::vector<std::string> arguments;  ///< {scenario}, {out} and {scratch} stand for paths
  std::string message;
};

void PrintTo(const BadCall& bad, std::ostream* out) {
  *out << bad.kind;
}

class BadCallTest : public testing::TestWithParam<BadCall> {};

TEST_P(BadCallTest, IsOneLineThatSaysWhatWasExpected) {
  const TestFolder scratch;
  const std::filesystem::path out = scratch.path() / "out";
  scratch.write("a_file", "");
  scratch.write("empty.yaml", "");
  std::vector<std::string> arguments;
  for (std::string argument : GetParam().arguments) {
    if (argument == "{scenario}") argument = scratch.write("tiny.yaml", kScenario);
    if (argument == "{out}") argument = out.string();
    if (argument.starts_with("{scratch}")) argument = scratch.path().string() + argument.substr(9);
    arguments.push_back(argument);
  }
  expect_bad_input(run_stereobench(arguments), GetParam().message);
  EXPECT_TRUE(is_empty_or_missing(out));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadCallTest,
    testing::Values(
        BadCall{"NoCommand", {}, "subcommand"}, BadCall{"UnknownCommand", {"fly"}, "fly"},
        BadCall{"NoScenario", {"run"}, "scenario"},
        BadCall{"MissingScenario", {"run", "{scratch}/none.yaml"}, "none.yaml"},
        BadCall{"EmptyScenario", {"run", "{scratch}/empty.yaml"}, "empty.yaml"},
        BadCall{"FolderForScenario", {"run", "{scratch}"}, "got a folder"},
        BadCall{"UnknownOption", {"run", "{scenario}", "--fast"}, "--fast"},
        BadCall{"UnknownFilter", {"run", "{scenario}", "--filters", "kalman"}, "kalman"},
        BadCall{"EmptyFilter", {"run", "{scenario}", "--filters", "ufastslam,"}, "--filters"},
        BadCall{"ZeroParticles", {"run", "{scenario}", "--particles", "0"}, "--particles"},
        BadCall{"TextForParticles", {"run", "{scenario}", "--particles", "many"}, "--particles"},
        BadCall{"ZeroJobs", {"run", "{scenario}", "--jobs", "0"}, "--jobs"},
        BadCall{"BackwardSeeds", {"run", "{scenario}", "--seeds", "9..0"}, "--seeds"},
        BadCall{"RepeatedSeed", {"run", "{scenario}", "--seeds", "1,1"}, "--seeds"},
        BadCall{"EmptySeeds", {"run", "{scenario}", "--seeds", ""}, "--seeds"},
        BadCall{"SetOfUnknownKey",
                {"run", "{scenario}", "--set", "path.lapps=1", "--out", "{out}"},
                "--set path.lapps"},
        BadCall{"SetWithoutValue", {"run", "{scenario}", "--set", "path.laps", "--out", "{out}"}, "--set"},
        BadCall{"SetOutOfRange",
                {"run", "{scenario}", "--set", "path.laps=-1", "--out", "{out}"},
                "--set path.laps"},
        BadCall{"OutIsAFile", {"run", "{scenario}", "--out", "{scratch}/a_file"}, "a_file"},
        BadCall{"OutBelowAFile", {"run", "{scenario}", "--out", "{scratch}/a_file/out"}, "a_file"},
        BadCall{"OutInProc", {"run", "{scenario}", "--out", "/proc/stereobench"}, "/proc/stereobench"},
        BadCall{
            "GateOnNothing",
            {"run", "{scenario}", "--out", "{out}", "--set", "gates=[{metric: vision.beauty, at_least: 1}]"},
            "vision.beauty"},
        BadCall{"RenderOfAnOracle", {"render", "{scenario}", "--out", "{out}"}, "oracle"},
        BadCall{"LensTooWideToRender",
                {"render", scenario_path("ball_circle"), "--set", "rig.width_px=4096", "--set",
                 "rig.pixel_aspect=1.5", "--set", "rig.distortion=[-0.01,0,0,0,0]", "--out", "{out}"},
                "--set rig.distortion: expected fewer pixels, or a lens that looks less far aside"},
        BadCall{"LensTooWideInTheLastCell",
                {"sweep", scenario_path("ball_circle"), "--set", "rig.width_px=4096", "--vary",
                 "rig.pixel_aspect=1,1.5", "--out", "{out}"},
                "rig.pixel_aspect: expected fewer pixels"},
        BadCall{"UnknownTruth", {"render", "{scenario}", "--truth", "flow,beauty"}, "beauty"},
        BadCall{"FormatOfNoTruth", {"render", "{scenario}", "--truth-format", "kitti"}, "--truth"},
        BadCall{"NegativeSeed", {"render", "{scenario}", "--seed", "-1"}, "--seed"},
        BadCall{"SlamWithoutLog", {"slam"}, "log"},
        BadCall{"SlamOfNothing", {"slam", "{scratch}/none"}, "none"},
        BadCall{"SlamOfAFolderWithoutALog", {"slam", "{scratch}"}, "odometry"},
        BadCall{"SlamNegativeNoise", {"slam", "{scratch}", "--range-sd-m", "-1"}, "--range-sd-m"},
        BadCall{
            "SlamDelayOfHours", {"slam", "{scratch}", "--odometry-delay-s", "3600"}, "--odometry-delay-s"},
        BadCall{"SlamZeroNoise", {"slam", "{scratch}", "--range-sd-m", "0"}, "--range-sd-m"},
        BadCall{"SweepWithoutVary", {"sweep", "{scenario}"}, "--vary"},
        BadCall{"VaryWithoutValues", {"sweep", "{scenario}", "--vary", "path.laps="}, "--vary"},
        BadCall{"VaryUnknownKey",
                {"sweep", "{scenario}", "--vary", "path.lapps=1,2", "--out", "{out}"},
                "path.lapps"},
        BadCall{
            "VaryTwice", {"sweep", "{scenario}", "--vary", "path.laps=1", "--vary", "path.laps=2"}, "twice"},
        BadCall{"VaryRepeatedValue", {"sweep", "{scenario}", "--vary", "path.laps=1,1"}, "twice"},
        BadCall{"VaryBadValueInTheLastCell",
                {"sweep", "{scenario}", "--vary", "path.laps=1,0.5,x", "--out", "{out}"},
                "path.laps"}),
    [](const auto& test) { return test.param.kind; });

struct BadLog {
  std::string kind;
  std::string file;
  std::string content;
  std::string message;
};

void PrintTo(const BadLog& bad, std::ostream* out) {
  *out << bad.kind;
}

class BadLogTest : public testing::TestWithParam<BadLog> {};

TEST_P(BadLogTest, IsOneLineThatNamesFileAndLine) {
  const TestFolder scratch;
  scratch.write("odometry.csv", "t_s,v_mps,w_radps\n0,1,0\n1,1,0\n");
  scratch.write("observations.csv", "t_s,landmark_id,range_m,bearing_rad\n0.5,1,2,0.1\n");
  scratch.write(GetParam().file, GetParam().content);
  const std::filesystem::path out = scratch.path() / "out";
  expect_bad_input(run_stereobench({"slam", scratch.path().string(), "--out", out.string()}),
                   GetParam().message);
  EXPECT_TRUE(is_empty_or_missing(out));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadLogTest,
    testing::Values(
        BadLog{"WrongHeader", "odometry.csv", "time,v,w\n0,1,0\n", "odometry.csv:1"},
        BadLog{"TooFewFields", "odometry.csv", "t_s,v_mps,w_radps\n0,1\n", "odometry.csv:2"},
        BadLog{"NotANumber", "odometry.csv", "t_s,v_mps,w_radps\n0,fast,0\n", "odometry.csv:2"},
        BadLog{"NotFinite", "odometry.csv", "t_s,v_mps,w_radps\n0,1,0\n1,inf,0\n", "odometry.csv:3"},
        BadLog{"TimeRunsBackwards", "odometry.csv", "t_s,v_mps,w_radps\n5,1,0\n0,1,0\n", "odometry.csv:3"},
        BadLog{"EmptyFile", "odometry.csv", "", "odometry.csv"},
        BadLog{"NegativeRange", "observations.csv", "t_s,landmark_id,range_m,bearing_rad\n0.5,1,-2,0.1\n",
               "observations.csv:2"},
        BadLog{"LandmarkOfAFraction", "observations.csv",
               "t_s,landmark_id,range_m,bearing_rad\n0.5,1.5,2,0.1\n", "observations.csv:2"}),
    [](const auto& test) { return test.param.kind; });

/// Runs the program with files limited to `bytes`, as a disk that is full would.
Outcome run_on_full_disk(const std::vector<std::string>& arguments, rlim_t bytes) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{bytes, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);  // inherited: writes fail instead of killing
  Outcome outcome = run_stereobench(arguments);
  ::signal(SIGXFSZ, old_handler);
  ::setrlimit(RLIMIT_FSIZE, &before);
  return outcome;
}

// Mutation: writing in place instead of through a temporary name leaves a part of the file here.
TEST(FullDisk, IsOneLineAndLeavesNoPartOfAFile) {
  const TestFolder scratch;
  const std::string file = scratch.write("tiny.yaml", kScenario);
  const std::filesystem::path out = scratch.path() / "out";
  expect_bad_input(run_on_full_disk({"run", file, "--out", out.string()}, 2000), "cannot be written");
  EXPECT_TRUE(is_empty_or_missing(out));
}

/// Root may write everywhere: while this lives, root is somebody else, and so are the programs it starts.
class AsNobody {
 public:
  AsNobody() : was_root_(::geteuid() == 0) { become(65534); }
  ~AsNobody() { become(0); }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  void become(uid_t user) const {
    if (!was_root_) return;
    EXPECT_EQ(::setresuid(user, user, 0), 0);  // the saved one leads back
  }
  bool was_root_;
};

TEST(UnwritableFolder, IsOneLine) {
  const TestFolder scratch;
  const std::string file = scratch.write("tiny.yaml", kScenario);
  std::filesystem::permissions(scratch.path(), std::filesystem::perms(0555));
  const std::filesystem::path out = scratch.path() / "out";
  const AsNobody nobody;
  if (::faccessat(AT_FDCWD, STEREOBENCH_PROGRAM, X_OK, AT_EACCESS) != 0)
    GTEST_SKIP() << "nobody but root may run " << STEREOBENCH_PROGRAM;
  expect_bad_input(run_stereobench({"run", file, "--out", out.string()}), out.string());
}

}  // namespace
}  // namespace stereobench::harness
