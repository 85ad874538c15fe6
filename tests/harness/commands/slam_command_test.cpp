// What `stereobench slam` makes of logs that lack something: it says what it assumed, and compares nothing
// that cannot be compared.
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "harness/drive/recording.h"
#include "harness/experiment/experiment.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/logs/log_folder.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A recorded drive through open_field, as a folder of CSV files.
class SlamCommand : public testing::Test {
 protected:
  TestFolder scratch_;
  std::filesystem::path log_ = scratch_.path() / "log";

  SlamCommand() {
    std::filesystem::create_directories(log_);
    write_log(log_, record(read_experiment(scenario_path("open_field"), {}), 3, {}).log);
  }

  std::vector<std::string> lines_of(const std::string& file) const {
    std::istringstream stream(bytes_of(log_ / file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  void rewrite(const std::string& file, const std::vector<std::string>& lines) const {
    std::ofstream stream(log_ / file);
    for (const std::string& line : lines) stream << line << "\n";
  }
  /// Every observation as if the sensor could not tell landmarks apart.
  void take_names() const {
    std::vector<std::string> lines = lines_of("observations.csv");
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::size_t from = lines[i].find(',') + 1;
      lines[i].replace(from, lines[i].find(',', from) - from, "-1");
    }
    rewrite("observations.csv", lines);
  }

  nlohmann::json slam(std::string* said = nullptr) const {
    const std::string out = (scratch_.path() / "out").string();
    const Outcome outcome = run_stereobench({"slam",
                                             log_.string(),
                                             "--filters",
                                             "ekf",
                                             "--range-sd-m",
                                             "0.3",
                                             "--bearing-sd-rad",
                                             "0.052",
                                             "--v-constant-mps",
                                             "0.02",
                                             "--v-per-v",
                                             "0",
                                             "--v-per-w",
                                             "0",
                                             "--w-constant-radps",
                                             "0.0035",
                                             "--w-per-w",
                                             "0",
                                             "--correlation-s",
                                             "0",
                                             "--out",
                                             out});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    if (said != nullptr) *said = outcome.out;
    return nlohmann::json::parse(bytes_of(scratch_.path() / "out" / "run.json"));
  }
};

double value(const nlohmann::json& json, const std::string& metric) {
  const auto& mean = json["filters"]["ekf"][metric]["mean"];
  return mean.is_null() ? std::nan("") : mean.get<double>();
}

TEST_F(SlamCommand, OfACompleteLogAssumesNothing) {
  std::string said;
  const auto json = slam(&said);
  EXPECT_THAT(said, Not(HasSubstr("assumed:")));
  EXPECT_EQ(json["log"]["frame"], "truth");
  EXPECT_TRUE(json["log"]["assumed"].empty());
  EXPECT_LT(value(json, "ate_rms_m"), 0.6);
}

// Seen before: each sighting that stood twice was evidence twice. Mutation: duplicates kept.
TEST_F(SlamCommand, SightingsThatStandTwiceAreUsedOnce) {
  const double once_m = value(slam(), "ate_rms_m");
  std::vector<std::string> doubled = {lines_of("observations.csv").front()};
  for (const std::string& line : lines_of("observations.csv"))
    if (line != doubled.front()) doubled.insert(doubled.end(), {line, line});
  const auto count = (doubled.size() - 1) / 2;
  rewrite("observations.csv", doubled);
  std::string said;
  const auto json = slam(&said);
  EXPECT_EQ(value(json, "ate_rms_m"), once_m);
  EXPECT_EQ(json["log"]["repeated_sightings"], count);
  EXPECT_THAT(said, HasSubstr("assumed: " + std::to_string(count) + " sightings stood in the log already"));
}

// Seen before: the map began at the origin, 24 m from the truth, and the raw error of that was printed.
// Mutation: a start at the origin of the truth's frame.
TEST_F(SlamCommand, TruthThatStartsLateIsComparedAfterAlignment) {
  const double aligned_m = value(slam(), "ate_aligned_rms_m");
  std::vector<std::string> late = lines_of("groundtruth.csv");
  late.erase(late.begin() + 1, late.begin() + 21);
  rewrite("groundtruth.csv", late);
  std::string said;
  const auto json = slam(&said);
  EXPECT_TRUE(std::isnan(value(json, "ate_rms_m")));
  EXPECT_TRUE(std::isnan(value(json, "landmark_rms_m")));
  EXPECT_NEAR(value(json, "ate_aligned_rms_m"), aligned_m, 0.3 * aligned_m);
  EXPECT_LT(value(json, "landmark_aligned_rms_m"), 0.6);
  EXPECT_EQ(json["log"]["frame"], "own");
  EXPECT_THAT(said, HasSubstr("assumed: the truth starts 10.00 s after the log"));
  EXPECT_THAT(said, HasSubstr("landmarks, aligned [m]"));
}

// Seen before: 40 m of "error" of a map that is 0.3 m off. Mutation: as above.
TEST_F(SlamCommand, WithoutTruthAMapIsAlignedOrLeftOut) {
  const double aligned_m = value(slam(), "landmark_aligned_rms_m");
  std::filesystem::remove(log_ / "groundtruth.csv");
  std::string said;
  auto json = slam(&said);
  EXPECT_TRUE(std::isnan(value(json, "landmark_rms_m")));
  EXPECT_NEAR(value(json, "landmark_aligned_rms_m"), aligned_m, 1e-6);
  EXPECT_THAT(said, HasSubstr("assumed: there is no true path"));
  take_names();
  json = slam(&said);
  EXPECT_TRUE(std::isnan(value(json, "landmark_aligned_rms_m")));
  EXPECT_TRUE(std::isnan(value(json, "landmark_path_aligned_rms_m")));
}

// Mutation: 0 in silence.
TEST_F(SlamCommand, WithoutIdentitiesTheDelayIsSaidToBeTakenForZero) {
  take_names();
  std::string said;
  slam(&said);
  EXPECT_THAT(said,
              HasSubstr("assumed: sightings do not say of which landmark they are: the odometry's delay is "
                        "taken to be 0; state --odometry-delay-s"));
}

}  // namespace
}  // namespace stereobench::harness
