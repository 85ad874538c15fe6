/// `replay`: frames of a finished run.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ReplayCommand : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome run =
        run_stereobench(with({"run", scenario_path("ball_circle"), "--seeds", "0..1", "--filters",
                              "dead_reckoning", "--out", path("result"), "--set", "gates=[]"},
                             kShort));
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  Outcome replay(const std::vector<std::string>& more) {
    return run_stereobench(with({"replay", path("result"), "--out", path("replay")}, more));
  }
  std::string path(const std::string& name) { return (folder_.path() / name).string(); }

  const std::vector<std::string> kShort = {"--set", "path.laps=0.15",    "--set", "rig.width_px=512",
                                           "--set", "rig.height_px=384", "--set", "rig.focal_px=443.5"};
  TestFolder folder_;
};

// The reference for pictures is `render`. Mutations: pictures of the light; of another frame; no --set.
TEST_F(ReplayCommand, ShowsWhatTheRunSaw) {
  const Outcome outcome = replay({"--frame", "1:3", "--frame", "0:2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("seed 0 frame 2\n"), HasSubstr("seed 1 frame 3\n"), HasSubstr("true positive"),
                    HasSubstr("as in the run"), Not(HasSubstr("not as in the run"))));
  ASSERT_EQ(run_stereobench(with({"render", scenario_path("ball_circle"), "--seeds", "1", "--frames", "3",
                                  "--out", path("dataset")},
                                 kShort))
                .exit_code,
            0);
  EXPECT_EQ(bytes_of(path("replay/seed1_step0003_left.png")), bytes_of(path("dataset/left/000003.png")));
  EXPECT_EQ(bytes_of(path("replay/seed1_step0003_right.png")), bytes_of(path("dataset/right/000003.png")));
  EXPECT_GT(bytes_of(path("replay/seed0_step0002.png")).size(), 10000u);
}

// Mutations: always as in the run; the run's detector in spite of --detector.
TEST_F(ReplayCommand, SaysWhatAnotherDetectorMakesOfIt) {
  folder_.write("blind.py", R"(import json, sys
setup = sys.stdin.readline()
for line in sys.stdin:
    print(json.dumps({"frame": json.loads(line)["frame"], "balls": []}), flush=True)
)");
  const Outcome blind = replay({"--frame", "0:2", "--detector", "/usr/bin/python3 " + path("blind.py")});
  EXPECT_EQ(blind.exit_code, 0) << blind.err;
  EXPECT_THAT(blind.out,
              AllOf(HasSubstr("not as in the run"), HasSubstr("miss "), Not(HasSubstr("true positive"))));
}

TEST_F(ReplayCommand, RefusesInOneLine) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& line) {
    const Outcome outcome = replay(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(line));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path("replay")));
  };
  refused({}, "--frame is required");
  refused({"--frame", "x"}, "--frame: expected SEED:STEP, e.g. 0:12 (got 'x')");
  refused({"--frame", "0:77"}, "has the steps 0 to 6 (got 77)");
  refused({"--frame", "0:1", "--scenario", scenario_path("corridor")},
          "is not as it was when this result was made");
}

}  // namespace
}  // namespace stereobench::harness
