/// `stereobench attribute` on errors that are planted: shares are those of what was planted.
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using nlohmann::json;

/// A drive without any error but what is planted. All noise is small, and filters weigh everything as they
/// are told, whatever is planted: errors add up.
const std::vector<std::string> kQuiet = {
    "--set",     "path.laps=0.25",
    "--set",     "rig.width_px=512",
    "--set",     "rig.height_px=384",
    "--set",     "rig.focal_px=443",
    "--set",     "camera.noise_sd_levels=0",
    "--set",     "perfect_detections={places: true}",
    "--set",     "odometry_noise={v_per_v: 1e-3, w_per_w: 1e-3}",
    "--set",     "believed_odometry_noise={v_per_v: 0.05, w_per_w: 0.05}",
    "--set",     "believed_measurement_noise={kind: constant, range_sd_m: 0.01, bearing_sd_deg: 0.2}",
    "--filters", "smoother",
    "--seeds",   "0..5"};

const std::string kWrongRig = "believed_rig={baseline_m: 0.1224}";
const std::string kFound = "perfect_detections={places: false}";  // detections are the detector's own
const std::string kNoise = "detector_noise={centre_sd_px: 0.014, covariance: as_stated}";

json attribution_with(const std::vector<std::string>& planted, const std::string& scenario = "ball_circle") {
  const TestFolder scratch;
  std::vector<std::string> words = {"attribute", scenario_path(scenario), "--out", scratch.path().string()};
  words.insert(words.end(), kQuiet.begin(), kQuiet.end());
  for (const std::string& line : planted) words.insert(words.end(), {"--set", line});
  const Outcome outcome = run_stereobench(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(bytes_of(scratch.path() / "attribution.json"));
}

/// ATE of the smoother, and its parts.
struct Shares {
  double real = 0.0;
  double perfect = 0.0;
  std::map<std::string, double> share, half_width, only_real;
  double sum = 0.0;
};

Shares shares_in(const json& attribution) {
  Shares shares;
  for (const json& metric : attribution["metrics"]) {
    if (metric["filter"] != "smoother" || metric["metric"] != "ate_rms_m") continue;
    shares.real = metric["real"]["mean"];
    shares.perfect = metric["perfect"]["mean"];
    for (const json& part : metric["parts"]) {
      const std::string name = part["part"];
      shares.share[name] = part["share"]["mean"];
      shares.half_width[name] = part["share"]["ci95_half_width"];
      shares.only_real[name] = part["only_real"]["mean"];
      shares.sum += shares.share[name];
    }
  }
  return shares;
}

// Mutations: coalitions in another order than their bits; a part whose lines are those of another.
TEST(AttributeCommand, SharesAddUpToTheWhole) {
  const Shares shares = shares_in(attribution_with({kFound, kWrongRig, kNoise}));
  EXPECT_GT(shares.real, 2.0 * shares.perfect);
  EXPECT_NEAR(shares.sum, shares.real - shares.perfect, 1e-12);
  EXPECT_EQ(shares.share.size(), 5U);  // rig, detection, identities, odometry, estimator
}

// Mutation: a perfect estimator that also takes a wrong rig away.
TEST(AttributeCommand, OfAWrongRigAloneIsTheRigs) {
  const Shares shares = shares_in(attribution_with({kWrongRig}));
  const double whole = shares.real - shares.perfect;
  EXPECT_NEAR(shares.share.at("rig"), whole, 0.1 * whole);
  for (const char* part : {"identities", "odometry", "estimator"})
    EXPECT_NEAR(shares.share.at(part), 0.0, 0.1 * whole) << part;
  EXPECT_FALSE(shares.share.contains("detection"));  // which is perfect already
}

// Of noise alone nothing is the rig's, which is right.
TEST(AttributeCommand, OfNoiseAloneIsTheNoises) {
  const Shares shares = shares_in(attribution_with({kFound, kNoise}));
  const double whole = shares.real - shares.perfect;
  EXPECT_NEAR(shares.share.at("detection") + shares.share.at("estimator"), whole, 0.1 * whole);
  EXPECT_FALSE(shares.share.contains("rig"));
  for (const char* part : {"identities", "odometry"})
    EXPECT_NEAR(shares.share.at(part), 0.0, 0.05 * whole) << part;
}

// Where both are planted, squares add: of two parts that alone leave a and b, the first has
// (a + sqrt(a^2 + b^2) - b) / 2. Mutations: shares of the first order; parts in the order of the chain.
TEST(AttributeCommand, OfBothIsWhatSquaresThatAddSay) {
  const std::string told = "believed_measurement_noise={kind: constant, range_sd_m: 0.05, bearing_sd_deg: 1}";
  const std::string wrong_rig = "believed_rig={baseline_m: 0.13}";
  const std::string slip = "odometry_noise={v_per_v: 0.05, w_per_w: 0.05}";
  const double rig = shares_in(attribution_with({told, wrong_rig})).real;
  const double noise = shares_in(attribution_with({told, slip})).real;
  const Shares both = shares_in(attribution_with({told, slip, wrong_rig}));
  EXPECT_LT(std::abs(rig - noise), 0.5 * both.real);  // about half and half
  const double together = std::sqrt(rig * rig + noise * noise);
  EXPECT_NEAR(both.real, together, 0.25 * together);
  EXPECT_NEAR(both.share.at("rig"), 0.5 * (rig + together - noise), both.half_width.at("rig"));
  EXPECT_NEAR(both.share.at("odometry") + both.share.at("estimator"), 0.5 * (noise + together - rig),
              both.half_width.at("odometry") + both.half_width.at("estimator"));
  EXPECT_NEAR(both.sum, both.real - both.perfect, 1e-12);
}

// A named fault is the part's whose keys it stands for. Mutations: faults that are laid over what is perfect.
TEST(AttributeCommand, OfANamedFaultIsItsParts) {
  const Shares shares = shares_in(attribution_with({"faults.rig.calibration=4"}));
  const double whole = shares.real - shares.perfect;
  EXPECT_GT(whole, 0.0);
  EXPECT_NEAR(shares.share.at("rig"), whole, 0.1 * whole);
}

TEST(AttributeCommand, RefusesInOneLine) {
  const auto complaint = [](const std::vector<std::string>& more) {
    const Outcome outcome =
        run_stereobench(with({"attribute", scenario_path("ball_circle"), "--dry-run"}, more));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_NE(complaint({"--filters", "dead_reckoning"}).find("--filters: expected a filter beside"),
            std::string::npos);
  EXPECT_NE(complaint({"--gate", "vision.recall>=0.9"}).find("--gate: a study has no gates"),
            std::string::npos);
}

TEST(AttributeCommand, ListsPartsThatAreNotPerfect) {
  const Outcome outcome = run_stereobench({"attribute", scenario_path("ball_circle"), "--dry-run"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("image_noise"), std::string::npos);
  EXPECT_EQ(outcome.out.find("rig:"), std::string::npos);
}

}  // namespace
}  // namespace stereobench::harness
