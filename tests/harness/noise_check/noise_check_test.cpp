// Filters that are told the wrong noise are found out by what they see.
#include "harness/noise_check/noise_check.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Mutations: a warning for what may be right; none for what is far too precise; the ends of an interval
// exchanged.
TEST(NoiseTable, WarnsOfWhatIsToldWronglyBeyondDoubt) {
  NoiseCheck check{.factors = {}, .logs = 3, .converged = true};
  EXPECT_THAT(noise_table(check), IsEmpty());
  check.factors[0] = {3.0, 2.5, 3.6};
  check.factors[1] = {1.3, 1.2, 1.4};
  check.factors[3] = {0.5, 0.4, 0.625};
  const std::string table = noise_table(check);
  EXPECT_THAT(table,
              HasSubstr("warning: forward speed is 3.0 times as noisy as filters are told (2.5 to 3.6"));
  EXPECT_THAT(table, HasSubstr("warning: bearings are 2.0 times as precise as filters are told (1.6 to 2.5"));
  EXPECT_THAT(table, Not(HasSubstr("warning: turn rate")));
  EXPECT_THAT(table, Not(HasSubstr("ranges"))) << "of which nothing is known";
  check.converged = false;
  EXPECT_THAT(noise_table(check), HasSubstr("warning: no noise was found"));
}

// Two frames say nothing of four deviations. Mutation: the information of frames inverted as it is.
TEST(NoiseCheck, OfTwoFramesClaimsNothing) {
  SensorLog log;
  for (int k = 0; k < 3; ++k) {
    slam::RangeBearing seen{.range_m = 5.0 - k, .bearing_rad = 0.01 * k, .landmark_id = 1};
    seen.covariance.diagonal().setConstant(1e-4);
    log.steps.push_back({{slam::Control{1.0, 0.0, 1.0}}, {seen}});
  }
  slam::FilterConfig config;
  config.odometry_noise = {.v_constant_mps = 0.1, .w_constant_radps = 0.1};
  for (const NoiseFactor& factor : check_noise({log}, config, 1).factors)
    EXPECT_TRUE(std::isnan(factor.factor));
}

struct Lie {
  const char* name;
  const char* setting;
  std::vector<const char*> found;  ///< what warnings begin with
};
void PrintTo(const Lie& lie, std::ostream* out) {
  *out << lie.name;
}

class PlantedLie : public testing::TestWithParam<Lie> {};

// Ten seeds, the noise told to filters two to three times too small or large. What is warned of is what was
// told wrongly, and nothing else. Mutations: logs of one seed alone (intervals too wide); factors on the
// noise that the log has in place of what filters are told.
TEST_P(PlantedLie, IsNamedByTheWarningsOfARun) {
  const TestFolder scratch;
  std::vector<std::string> call = {
      "run",   scenario_path("open_field"), "--filters", "iekf", "--seeds", "0..9", "--set", "gates=[]",
      "--out", scratch.path().string()};
  if (*GetParam().setting != '\0') call.insert(call.end(), {"--set", GetParam().setting});
  const Outcome outcome = run_stereobench(call);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::size_t warnings = 0;
  for (std::size_t at = 0; (at = outcome.out.find("as filters are told (", at)) != std::string::npos; ++at)
    ++warnings;
  EXPECT_EQ(warnings, GetParam().found.size()) << outcome.out;
  for (const char* found : GetParam().found) EXPECT_THAT(outcome.out, HasSubstr(found));
}

INSTANTIATE_TEST_SUITE_P(
    OpenField, PlantedLie,
    testing::Values(Lie{"nothing", "", {}},
                    Lie{"odometry_3_times_too_good",
                        "believed_odometry_noise={v_constant_mps: 0.00667, w_constant_degps: 0.0667}",
                        {"warning: forward speed is 3", "warning: turn rate is 3"}},
                    Lie{"ranges_2_times_too_good",
                        "believed_measurement_noise={kind: per_observation, range_sd_scale: 0.5}",
                        {"warning: ranges are 2.0 times as noisy"}},
                    Lie{"bearings_2_times_too_bad",
                        "believed_measurement_noise={kind: per_observation, bearing_sd_scale: 2}",
                        {"warning: bearings are 2.0 times as precise"}}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace stereobench::harness
