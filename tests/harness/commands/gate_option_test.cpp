/// Limits on results, by every command that scores something: a broken one is exit code 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kDeadReckoning = "filters.dead_reckoning.ate_rms_m.mean";

std::string limit(const std::string& metric, const std::string& at_most) {
  return "gates=[{metric: " + metric + ", at_most: " + at_most + "}]";
}

// Mutations: a sweep that looks at the first cell's gates alone, that passes where one is broken, that
// keeps quiet of it, or that asks whether there are such numbers only once all is run.
TEST(SweepGates, AreThoseOfTheScenarioForEachCell) {
  const TestFolder scratch;
  const auto sweep = [&](const std::string& at_most, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"sweep",       scenario_path("open_field"),
                                      "--seeds",     "0",
                                      "--particles", "5",
                                      "--filters",   "dead_reckoning",
                                      "--vary",      "odometry_noise.v_constant_mps=0,5",
                                      "--out",       scratch.path().string(),
                                      "--set",       limit(kDeadReckoning, at_most)};
    words.insert(words.end(), more.begin(), more.end());
    return run_stereobench(words);
  };
  const Outcome kept = sweep("1e6");
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_THAT(kept.out, HasSubstr("all 2 gates hold"));
  const Outcome broken = sweep("10");
  EXPECT_EQ(broken.exit_code, 1) << broken.out;
  EXPECT_THAT(broken.out,
              HasSubstr("gate broken: odometry_noise.v_constant_mps = 5: " + std::string(kDeadReckoning)));
  EXPECT_THAT(broken.out, testing::Not(HasSubstr("v_constant_mps = 0: filters")));
  EXPECT_THAT(sweep("10", {"--quiet"}).err, HasSubstr("gate broken: ")) << "nobody would hear of it";
  const Outcome unknown =
      run_stereobench({"sweep", scenario_path("open_field"), "--vary", "particles=1", "--set",
                       limit("vision.beauty", "1"), "--out", scratch.path().string()});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("gate 'vision.beauty': the result has no such number"));
}

// Mutation: the option read and forgotten.
TEST(RunGates, OfTheCommandLineStandBesideTheScenarios) {
  const TestFolder scratch;
  const auto run = [&](const std::string& gate) {
    return run_stereobench({"run", scenario_path("open_field"), "--seeds", "0", "--particles", "5",
                            "--filters", "dead_reckoning", "--set", limit(kDeadReckoning, "1e6"), "--gate",
                            gate, "--out", scratch.path().string()});
  };
  const Outcome kept = run(std::string(kDeadReckoning) + "<=1e6");
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_THAT(kept.out, HasSubstr("all 2 gates hold"));
  EXPECT_EQ(run(std::string(kDeadReckoning) + "<=1e-6").exit_code, 1);
  const Outcome misspelt = run("filters.dead_reckoning.ate_rms_m.maen<=1");
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("did you mean filters.dead_reckoning.ate_rms_m.mean?"));
}

// Mutations: as above, for a log, and for a calibration.
TEST(SlamGates, LimitWhatFiltersMakeOfALog) {
  const TestFolder scratch;
  const std::string log = (scratch.path() / "log").string();
  ASSERT_EQ(run_stereobench({"render", scenario_path("ball_circle"), "--set", "path.laps=0.04", "--out", log})
                .exit_code,
            0);
  const auto slam = [&](const std::string& gate) {
    return run_stereobench({"slam", log, "--filters", "dead_reckoning", "--gate", gate, "--out",
                            (scratch.path() / "out").string()});
  };
  EXPECT_EQ(slam(std::string(kDeadReckoning) + "<=1e6").exit_code, 0);
  const Outcome broken = slam(std::string(kDeadReckoning) + ">=1e6");
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.out, HasSubstr("gate broken: " + std::string(kDeadReckoning)));
  EXPECT_EQ(slam("filters.ekf.failures<=0").exit_code, 2);
}

TEST(CalibrateGates, LimitTheDetector) {
  const TestFolder scratch;
  const auto calibrate = [&](const std::string& gate) {
    return run_stereobench({"calibrate", scenario_path("ball_circle"), "--seeds", "0..1", "--gate", gate,
                            "--out", scratch.path().string()});
  };
  EXPECT_EQ(calibrate("recall>=0.1").exit_code, 0);
  const Outcome broken = calibrate("recall>=1.1");
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.out, HasSubstr("gate broken: recall is"));
  EXPECT_EQ(calibrate("recal>=1").exit_code, 2);
}

class EmptyValue : public testing::TestWithParam<std::vector<std::string>> {};

// An unset variable of a script is an empty value: without this check, our own detector, or the log's own
// sightings, would be tested in place of what was meant. Mutation: no check; only of the detector.
TEST_P(EmptyValue, IsRefused) {
  const Outcome outcome = run_stereobench(GetParam());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("got an empty one (is a variable unset?)"),
                                 HasSubstr(GetParam()[GetParam().size() - 2])));
}
INSTANTIATE_TEST_SUITE_P(
    Options, EmptyValue,
    testing::Values(std::vector<std::string>{"run", scenario_path("ball_circle"), "--detector", ""},
                    std::vector<std::string>{"run", scenario_path("ball_circle"), "--detector", "  "},
                    std::vector<std::string>{"slam", "log", "--detections", ""},
                    std::vector<std::string>{"sweep", scenario_path("open_field"), "--vary", ""},
                    std::vector<std::string>{"run", scenario_path("ball_circle"), "--out", ""},
                    std::vector<std::string>{"detect", "a.png", "--palette", ""}));

// Mutations: no suggestion; one for what is nothing like a command.
TEST(Misspelt, CommandsFiltersAndOptionsAreAskedBack) {
  const auto complaint = [](const std::vector<std::string>& arguments) {
    const Outcome outcome = run_stereobench(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(complaint({"rnu", "x"}), HasSubstr("no command is called 'rnu', did you mean run?"));
  EXPECT_THAT(complaint({"swep"}), HasSubstr("did you mean sweep?"));
  EXPECT_THAT(complaint({"photograph"}), HasSubstr("expected one of run, render, export, dataset"));
  EXPECT_THAT(complaint({"run", "x", "--filters", "ufastslm"}), HasSubstr("did you mean ufastslam?"));
  EXPECT_THAT(complaint({"run", "x", "--partciles", "3"}), HasSubstr("did you mean --particles?"));
}

// Mutations: tables on standard output all the same; broken gates that nobody hears of.
TEST(QuietOption, LeavesErrorsAndBrokenGates) {
  const TestFolder scratch;
  const auto run = [&](const std::string& gate) {
    return run_stereobench({"run", scenario_path("open_field"), "--seeds", "0", "--particles", "5",
                            "--filters", "dead_reckoning", "--set", "gates=[]", "--gate", gate, "--quiet",
                            "--out", scratch.path().string()});
  };
  const Outcome kept = run(std::string(kDeadReckoning) + "<=1e6");
  EXPECT_EQ(kept.exit_code, 0);
  EXPECT_EQ(kept.out, "");
  EXPECT_EQ(kept.err, "");
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "run.json"));
  const Outcome broken = run(std::string(kDeadReckoning) + "<=0");
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_EQ(broken.out, "");
  EXPECT_THAT(broken.err, HasSubstr("gate broken: "));
}

// Mutations: a dry run that writes; one that passes what a run would refuse.
TEST(DryRunOption, ChecksAndWritesNothing) {
  const TestFolder scratch;
  const std::string out = (scratch.path() / "out").string();
  const auto dry = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--dry-run", "--out", out});
    return run_stereobench(arguments);
  };
  const Outcome run = dry({"run", scenario_path("ball_circle"), "--seeds", "3..4", "--filters", "ekf"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("would run seeds 3, 4 of"));
  EXPECT_THAT(run.out, HasSubstr("each with dead_reckoning, ekf"));
  const Outcome sweep = dry({"sweep", scenario_path("ball_circle"), "--vary", "rig.distortion[0]=0,-0.1"});
  EXPECT_THAT(sweep.out, HasSubstr("rig.distortion[0] = -0.1: would run"));
  EXPECT_EQ(dry({"calibrate", scenario_path("ball_circle")}).exit_code, 0);
  EXPECT_EQ(dry({"sweep", scenario_path("ball_circle"), "--vary", "path.laps=1,0"}).exit_code, 2);
  EXPECT_EQ(dry({"run", scenario_path("ball_circle"), "--gate", "vision.beauty>=1"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace stereobench::harness
