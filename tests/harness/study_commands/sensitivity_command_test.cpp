/// `stereobench sensitivity` as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::vector<std::string> kDrive = {"sensitivity", scenario_path("ball_circle"),
                                         "--set",       "path.laps=0.12",
                                         "--set",       "rig.width_px=512",
                                         "--set",       "rig.height_px=384",
                                         "--set",       "rig.focal_px=443",
                                         "--metric",    "filters.ekf.ate_rms_m",
                                         "--samples",   "16"};

json study_in(const TestFolder& scratch, const std::string& name, const std::vector<std::string>& more) {
  const auto out = scratch.path() / name;
  const Outcome outcome = run_stereobench(with(with(kDrive, more), {"--out", out.string()}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(bytes_of(out / "sensitivity.json"));
}

json factor_named(const json& study, const std::string& name) {
  for (const json& factor : study["factors"])
    if (factor.value("key", "") == name || factor.value("stream", "") == name) return factor;
  ADD_FAILURE() << "no factor " << name << " in " << study.dump();
  return {};
}

// A key that does nothing to the metric has no share, one that does all has nearly all. Mutations: values of
// keys that are not set; keys in another order.
TEST(SensitivityCommand, TellsWhatMattersFromWhatDoesNot) {
  const TestFolder scratch;
  const json study =
      study_in(scratch, "s", {"--vary", "detector_noise.range_scale=1..1.3", "--vary", "particles=1..90"});
  EXPECT_GT(factor_named(study, "detector_noise.range_scale")["total"]["value"], 0.8);
  EXPECT_EQ(factor_named(study, "particles")["total"]["value"], 0.0);
}

// Mutations: streams that share their seed; two that are swapped.
TEST(SensitivityCommand, TakesChanceApart) {
  const TestFolder scratch;
  const json study = study_in(scratch, "s", {"--by-stream", "--set", "detector_noise={centre_sd_px: 3}"});
  EXPECT_EQ(factor_named(study, "filter")["total"]["value"], 0.0);  // the EKF draws nothing
  EXPECT_GT(factor_named(study, "sensor")["total"]["value"], 0.1);
}

// Mutation: a study that depends on the order in which runs end.
TEST(SensitivityCommand, SameBytesForAnyNumberOfJobs) {
  const TestFolder scratch;
  for (const char* jobs : {"1", "3"})
    study_in(scratch, jobs, {"--vary", "odometry_noise.v_per_v=0..0.2", "--jobs", jobs});
  for (const char* file : {"sensitivity.json", "sensitivity.png"})
    EXPECT_EQ(bytes_of(scratch.path() / "1" / file), bytes_of(scratch.path() / "3" / file)) << file;
}

TEST(SensitivityCommand, RefusesInOneLine) {
  const auto complaint = [](const std::vector<std::string>& more) {
    const Outcome outcome = run_stereobench(with(kDrive, with({"--dry-run"}, more)));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(complaint({}), HasSubstr("--vary or --by-stream"));
  EXPECT_THAT(complaint({"--vary", "particles=9"}), HasSubstr("--vary"));
  EXPECT_THAT(complaint({"--vary", "particles=1..9:log"}), HasSubstr("leave :log out"));
  EXPECT_THAT(complaint({"--vary", "detector_noise.miss_probability=0..2"}), HasSubstr("miss_probability"));
}

}  // namespace
}  // namespace stereobench::harness
