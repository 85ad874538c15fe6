/// Data sets of several seeds, of some frames, and as another detector sees them.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <signal.h>

#include "tests/harness/commands/processes.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A drive of seven frames.
Outcome render_to(const fs::path& out, const std::vector<std::string>& more) {
  std::vector<std::string> words = {
      "render", scenario_path("ball_circle"), "--set", "path.laps=0.165", "--out", out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return run_stereobench(words);
}

std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path());
  return files;
}

nlohmann::json marker_of(const fs::path& folder) {
  return nlohmann::json::parse(bytes_of(folder / "dataset.json"));
}

// Laws: a seed's files do not depend on how many processes render how many seeds; a frame's files do not
// depend on which frames are asked for. Mutations: seeds counted from 0; noise of the n-th picture in place
// of the frame's.
TEST(RenderCommand, SeedsAndFramesAreTheSameInAnyCompany) {
  const TestFolder scratch;
  const fs::path one = scratch.path() / "one", three = scratch.path() / "three", all = scratch.path() / "all";
  const std::vector<std::string> seeds = {"--seeds", "2..4", "--frames", "1..5:2", "--truth", "balls,flow"};
  const auto with_jobs = [&](const char* jobs) {
    std::vector<std::string> words = seeds;
    words.insert(words.end(), {"--jobs", jobs});
    return words;
  };
  ASSERT_EQ(render_to(one, with_jobs("1")).exit_code, 0);
  const Outcome outcome = render_to(three, with_jobs("3"));
  EXPECT_THAT(outcome.out,
              HasSubstr(fmt::format("3 stereo pairs with ids, depth, calibration and truth in {}/seed_4/",
                                    three.string())));
  EXPECT_EQ(files_of(one), files_of(three));
  ASSERT_EQ(render_to(all, {"--seed", "3", "--truth", "balls,flow"}).exit_code, 0);
  const auto whole = files_of(all);
  int pictures = 0;
  for (const auto& [name, bytes] : files_of(one / "seed_3")) {
    if (name.find('/') == std::string::npos) continue;  // tables and cards are of the frames that there are
    EXPECT_TRUE(whole.contains(name) && whole.at(name) == bytes) << name;
    pictures += name.starts_with("left/") ? 1 : 0;
  }
  EXPECT_EQ(pictures, 3);
  EXPECT_EQ(marker_of(one / "seed_3")["frames"], nlohmann::json({1, 3, 5}));
}

// Mutation: complete data sets rendered, or at least their tables written, once more.
TEST(RenderCommand, CompleteSeedsAreLeftAsTheyAre) {
  const TestFolder scratch;
  ASSERT_EQ(render_to(scratch.path(), {"--seeds", "0..1", "--frames", "0..1"}).exit_code, 0);
  std::map<fs::path, fs::file_time_type> times;
  for (const auto& entry : fs::recursive_directory_iterator(scratch.path()))
    if (entry.is_regular_file()) times[entry.path()] = entry.last_write_time();
  const Outcome again = render_to(scratch.path(), {"--seeds", "0..2", "--frames", "0..1", "--jobs", "2"});
  EXPECT_EQ(again.exit_code, 0);
  for (const char* seed : {"seed_0", "seed_1"})
    EXPECT_THAT(again.out, HasSubstr(fmt::format("{}/ is complete and is left as it is\n",
                                                 (scratch.path() / seed).string())));
  EXPECT_THAT(again.out, HasSubstr("2 stereo pairs"));
  for (const auto& [file, time] : times) EXPECT_EQ(fs::last_write_time(file), time) << file;
}

// A dropped frame has no pictures, and the data set does not claim it. Mutation: the frames that were asked
// for listed as those that there are.
TEST(RenderCommand, SaysWhichFramesThereAre) {
  const TestFolder scratch;
  ASSERT_EQ(render_to(scratch.path(), {"--set", "shutter.drop_probability=0.5"}).exit_code, 0);
  std::vector<int> there;
  for (const auto& entry : fs::directory_iterator(scratch.path() / "left"))
    there.push_back(std::stoi(entry.path().stem().string()));
  std::ranges::sort(there);
  EXPECT_EQ(marker_of(scratch.path())["frames"], nlohmann::json(there));
  EXPECT_LT(there.size(), 7U);
}

// What is said while it runs is gone later. Mutations: the warning alone; blur among what tells renderings
// apart, so that none is ever complete.
TEST(RenderCommand, KeepsHowCoarseItsBlurIs) {
  const TestFolder scratch;
  const std::vector<std::string> coarse = {"--frames",           "1..2",  "--set",
                                           "shutter.open_s=0.5", "--set", "shutter.most_samples=8"};
  const Outcome outcome = render_to(scratch.path(), coarse);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: the blur of 2 pairs is drawn in steps of more than a pixel"));
  const nlohmann::json blur = marker_of(scratch.path())["blur"];
  EXPECT_EQ(blur["coarse_pairs"], 2);
  EXPECT_THAT(outcome.err, HasSubstr(fmt::format("up to {:.1f} px", blur["most_step_px"].get<double>())));
  EXPECT_THAT(render_to(scratch.path(), coarse).out, HasSubstr("is complete and is left as it is"));
}

// Mutation: `render` whose own detector looks all the same.
TEST(RenderCommand, WritesWhatAnotherDetectorSees) {
  const TestFolder scratch;
  const std::string blind =
      "read setup; while read line; do f=${line#*frame\\\":}; echo \"{\\\"frame\\\": ${f%%,*}, "
      "\\\"balls\\\": []}\"; done";
  const Outcome outcome = render_to(scratch.path(), {"--frames", "0..2", "--detector", blind});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(bytes_of(scratch.path() / "observations.csv").find('\n') + 1,
            bytes_of(scratch.path() / "observations.csv").size());
  EXPECT_EQ(marker_of(scratch.path())["detector"], blind);
  EXPECT_EQ(render_to(scratch.path() / "none", {"--frames", "0", "--detector", "exit 3"}).exit_code, 4);
}

// Nothing is a surface of no number, infinitely far. Mutation: a floor in the list of surfaces.
TEST(RenderCommand, HasNoFloorInTheTruthWhereThereIsNone) {
  const TestFolder scratch;
  const Outcome outcome = render_to(
      scratch.path(), {"--frames", "0", "--set", "world.floor=none", "--truth", "surface,range,disparity"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(bytes_of(scratch.path() / "surfaces.csv"), testing::Not(HasSubstr("floor")));
  const cv::Mat surface =
      cv::imread((scratch.path() / "left_surface/000000.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::countNonZero(surface == 255), 0);
  const cv::Mat nothing = surface == 0;
  EXPECT_GT(cv::countNonZero(nothing.rowRange(700, 768)), 10000);
  for (const char* truth : {"range", "depth", "disparity"}) {
    const cv::Mat values = cv::imread((scratch.path() / fmt::format("left_{}/000000.pfm", truth)).string(),
                                      cv::IMREAD_UNCHANGED);
    cv::Mat mixed = (values == std::numeric_limits<float>::infinity()) != nothing;
    EXPECT_EQ(cv::countNonZero(mixed), 0) << truth;
  }
}

struct OtherOption {
  std::string name;
  std::vector<std::string> words;
  std::string keys;  ///< that differ
};
void PrintTo(const OtherOption& option, std::ostream* out) {
  *out << option.name;
}
class OtherRendering : public testing::TestWithParam<OtherOption> {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<TestFolder>();
    ASSERT_EQ(render_to(scratch_->path(), {"--frames", "0..1"}).exit_code, 0);
  }
  static void TearDownTestSuite() { scratch_.reset(); }
  static std::unique_ptr<TestFolder> scratch_;
};
std::unique_ptr<TestFolder> OtherRendering::scratch_;

// Mutations: an identity without the frames, the detector or the files; one that does not say what differs.
TEST_P(OtherRendering, IsRefusedByTheKeysThatDiffer) {
  std::vector<std::string> words = {"--frames", "0..1"};
  if (GetParam().name == "Frames") words.clear();
  words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
  const auto before = files_of(scratch_->path());
  const Outcome outcome = render_to(scratch_->path(), words);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(fmt::format("dataset.json: holds a data set of another {}; choose "
                                                 "another folder or remove it\n",
                                                 GetParam().keys)));
  EXPECT_EQ(files_of(scratch_->path()), before);
}

INSTANTIATE_TEST_SUITE_P(Options, OtherRendering,
                         testing::Values(OtherOption{"Frames", {}, "asked_frames"},
                                         OtherOption{"Seed", {"--seed", "1"}, "seed"},
                                         OtherOption{"Detector", {"--detector", "true"}, "detector"},
                                         OtherOption{"Set", {"--set", "camera.gain=1.5"}, "set"},
                                         OtherOption{"Truth", {"--truth", "balls"}, "truth"},
                                         OtherOption{"Format", {"--format", "tum"}, "format"}),
                         [](const auto& test) { return test.param.name; });

// Mutations: the default format whatever is asked for; ids claimed of a data set that has none.
TEST(RenderCommand, WritesTheFormatThatIsAskedFor) {
  const TestFolder scratch;
  const fs::path out = scratch.path() / "out";
  const Outcome outcome = render_to(out, {"--frames", "1", "--format", "kitti-stereo"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 stereo pairs with disparity, as in KITTI stereo 2015 in "));
  EXPECT_TRUE(fs::exists(out / "disp_occ_0/000001_10.png"));
  EXPECT_FALSE(fs::exists(out / "left"));
  EXPECT_EQ(marker_of(out)["format"], "kitti-stereo");
  EXPECT_THAT(render_to(out, {"--frames", "1", "--format", "kitti-stereo"}).out,
              HasSubstr("is left as it is"));
}

// Law: each of several formats is what it is alone. Mutations: files of both in one folder; the truth of the
// plain one in the identity of the other; what is complete written again.
TEST(RenderCommand, WritesSeveralFormatsOfOneDrive) {
  const TestFolder scratch;
  const fs::path both = scratch.path() / "both", alone = scratch.path() / "alone";
  const Outcome outcome = render_to(both, {"--frames", "1", "--format", "tum,plain", "--truth", "flow"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("both/tum/"), HasSubstr("both/plain/")));
  ASSERT_EQ(render_to(alone / "tum", {"--frames", "1", "--format", "tum"}).exit_code, 0);
  ASSERT_EQ(render_to(alone / "plain", {"--frames", "1", "--truth", "flow"}).exit_code, 0);
  EXPECT_EQ(files_of(both), files_of(alone));
  fs::remove(both / "tum/groundtruth.txt");
  const auto written = fs::last_write_time(both / "plain/frames.csv");
  EXPECT_THAT(render_to(both, {"--frames", "1", "--format", "tum,plain", "--truth", "flow"}).out,
              AllOf(HasSubstr("1 stereo pairs"), HasSubstr("plain/ is complete and is left as it is")));
  EXPECT_EQ(files_of(both), files_of(alone));
  EXPECT_EQ(fs::last_write_time(both / "plain/frames.csv"), written);
}

// Mutations: found out after rendering (a folder is there); another exit code.
TEST(RenderCommand, RefusesFormatsThatThereAreNotOrThatCannotHoldIt) {
  const TestFolder scratch;
  const fs::path out = scratch.path() / "out";
  using Words = std::vector<std::string>;
  for (const auto& [words, complaint] :
       {std::pair(Words{"--format", "tun"}, "no format is called 'tun', did you mean tum?; there are"),
        std::pair(Words{"--format", "kitti-stereo", "--set", "rig.right_turn_deg=[0,0.1,0]"},
                  "the format kitti-stereo has no place for rig.right_turn_deg;"),
        std::pair(Words{"--format", "tum,tum"}, "--format: 'tum' stands there twice"),
        std::pair(Words{"--format", "tum,eth3d", "--truth", "flow"},
                  "--truth: tum has a place for what is its own alone; add the format plain")}) {
    const Outcome outcome = render_to(out, words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(complaint));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(out));
}

TEST(RenderCommand, RefusesFramesThatThereAreNot) {
  const TestFolder scratch;
  const fs::path out = scratch.path() / "out";
  for (const auto& [frames, complaint] :
       std::map<std::string, std::string>{{"", "--frames: expected a value, got an empty one"},
                                          {"0..7", "--frames: the drive has the frames 0 to 6 (got 0..7)"},
                                          {"9", "--frames: the drive has the frames 0 to 6 (got 9..9)"},
                                          {"3..1", "--frames: expected frames such as"}}) {
    const Outcome outcome = render_to(out, {"--frames", frames});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(complaint));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(out));
}

// Several seeds in a folder that is a data set itself would leave a mixture. Mutations: no look at the
// folder; a dry run that writes.
TEST(RenderCommand, DryRunsCheckTheFolderAndWriteNothing) {
  const TestFolder scratch;
  const fs::path out = scratch.path() / "out";
  const Outcome dry = render_to(out, {"--seeds", "0,3", "--frames", "0..6:3", "--dry-run"});
  EXPECT_EQ(dry.exit_code, 0) << dry.err;
  EXPECT_THAT(dry.out, HasSubstr("would render frames 0..6:3 of seed 3 to " + (out / "seed_3/").string()));
  EXPECT_FALSE(fs::exists(out));
  ASSERT_EQ(render_to(out, {"--frames", "0"}).exit_code, 0);
  EXPECT_THAT(render_to(out, {"--seeds", "0,3", "--frames", "0", "--dry-run"}).err,
              HasSubstr("holds a data set itself"));
}

// Mutations: no PR_SET_PDEATHSIG (workers render on); SIGKILL in its place (half-written files stay).
TEST(RenderCommand, KilledLeavesNoWorkerNorHalfAFileAndGoesOn) {
  const TestFolder scratch;
  const fs::path whole = scratch.path() / "whole";
  const std::vector<std::string> seeds = {"--seeds", "0..2", "--jobs", "2"};
  for (const int signal : {SIGTERM, SIGKILL}) {
    const fs::path out = scratch.path() / std::to_string(signal);
    const pid_t render = start_stereobench(
        fmt::format("render '{}' --set path.laps=0.165 --seeds 0..2 --jobs 2 --out '{}' >/dev/null 2>&1",
                    scenario_path("ball_circle"), out.string()));
    ASSERT_TRUE(comes_true_in_time([&] { return fs::exists(out / "seed_1/left/000000.png"); }));
    const std::vector<pid_t> workers = children_of(render);
    EXPECT_EQ(workers.size(), 2U);
    ::kill(render, signal);
    EXPECT_EQ(exit_code_of(render), 128 + signal);
    EXPECT_TRUE(comes_true_in_time([&] { return std::ranges::none_of(workers, is_alive); }));
    for (const auto& entry : fs::recursive_directory_iterator(out))
      EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
  }
  ASSERT_EQ(render_to(whole, seeds).exit_code, 0);
  const fs::path killed = scratch.path() / std::to_string(SIGKILL);
  ASSERT_EQ(render_to(killed, seeds).exit_code, 0);
  EXPECT_EQ(files_of(killed), files_of(whole));
}

}  // namespace
}  // namespace stereobench::harness
