// What is assumed of a recorded log is said, with what to do about it.
#include "harness/logs/log_facts.h"

#include <gmock/gmock.h>

#include "harness/logs/measurement_log_reader.h"
#include "tests/harness/logs/log_folder.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr StatedNoise kAllStated = {.sensor = true, .odometry = true};

/// A log of which nothing needs to be assumed.
LogFacts complete() {
  return {.delay_source = DelaySource::kFound, .has_truth = true, .steps = 9};
}

TEST(Assumptions, OfACompleteLogThereAreNone) {
  EXPECT_THAT(assumptions_of(complete(), kAllStated), IsEmpty());
}

// Mutations: any of the lines left out, or without what to do.
TEST(Assumptions, EachIsALineThatSaysWhatToDo) {
  const auto line_of = [](LogFacts facts) { return assumptions_of(facts, kAllStated); };
  LogFacts facts = complete();
  facts.repeated_sightings = 12;
  EXPECT_THAT(line_of(facts), ElementsAre(AllOf(HasSubstr("12 sightings"), HasSubstr("remove"))));
  facts = complete();
  facts.concurrent_sightings = 1;
  EXPECT_THAT(line_of(facts), ElementsAre(AllOf(HasSubstr("1 sighting "), HasSubstr("remove"))));
  facts = complete();
  facts.unknown_barcodes = 3;
  EXPECT_THAT(line_of(facts), ElementsAre(AllOf(HasSubstr("3 sightings"), HasSubstr("Barcodes.dat"))));
  facts = complete();
  facts.truth_starts_s = 3.25;
  EXPECT_THAT(line_of(facts), ElementsAre(AllOf(HasSubstr("3.25 s"), HasSubstr("cut the log"))));
  facts = complete();
  facts.steps_without_truth = 4;
  EXPECT_THAT(line_of(facts), ElementsAre(HasSubstr("4 of 9 steps")));
  facts = complete();
  facts.has_truth = false;
  EXPECT_THAT(line_of(facts), ElementsAre(AllOf(HasSubstr("no true path"), HasSubstr("groundtruth.csv"))));
  facts = complete();
  facts.lasting_errors = {.time_s = {4.5, 0.0}, .correlation = {0.9, 0.0}, .gap_s = 0.3};
  EXPECT_THAT(line_of(facts), ElementsAre(AllOf(HasSubstr("ranges last 4.5 s"), HasSubstr("10 sightings"),
                                                HasSubstr("--sighting-correlation-s"))));
  for (const DelaySource source : {DelaySource::kNoIdentities, DelaySource::kFewPairs}) {
    facts = complete();
    facts.delay_source = source;
    EXPECT_THAT(line_of(facts), ElementsAre(HasSubstr("--odometry-delay-s")));
  }
}

// Mutation: a noise that was stated is said to be assumed.
TEST(Assumptions, NoiseThatIsStatedIsNotAssumed) {
  LogFacts facts = complete();
  EXPECT_THAT(assumptions_of(facts, {}), ElementsAre(HasSubstr("--v-constant-mps")));
  facts.noise_is_assumed = true;
  EXPECT_THAT(assumptions_of(facts, {.odometry = true}), ElementsAre(HasSubstr("--range-sd-m")));
  EXPECT_THAT(assumptions_of(facts, kAllStated), IsEmpty());
}

// Mutations: truth counted from the epoch; a log without any truth said to start late.
TEST(Assumptions, AreReadOffTheLog) {
  const TestFolder folder;
  write_small_csv_log(folder);
  LogFacts facts = read_log(folder.path() / "log", {}).facts;
  EXPECT_TRUE(facts.has_truth);
  EXPECT_EQ(facts.truth_starts_s, 0.0);
  EXPECT_EQ(facts.steps, 4);
  EXPECT_EQ(facts.steps_without_truth, 0);
  EXPECT_TRUE(facts.noise_is_assumed);
  EXPECT_EQ(facts.delay_source, DelaySource::kFewPairs);
  folder.write("log/groundtruth.csv", "t_s,x_m,y_m,theta_rad\n1,1,0,0\n2,2,0,0.5\n");
  const RecordedLog late = read_log(folder.path() / "log", {.odometry_delay_s = 0.0});
  EXPECT_EQ(late.facts.truth_starts_s, 1.5) << "the first step with truth is at 1.5 s";
  EXPECT_EQ(late.facts.steps_without_truth, 2);
  EXPECT_EQ(late.facts.delay_source, DelaySource::kStated);
  EXPECT_FALSE(late.log.start_is_true);
  folder.write("log/observations.csv",
               "t_s,landmark_id,range_m,bearing_rad,colour_class,range_var_m2,cov_m_rad,bearing_var_rad2\n"
               "0.5,-1,2,0.1,3,0.01,0,0.01\n");
  std::filesystem::remove(folder.path() / "log/groundtruth.csv");
  facts = read_log(folder.path() / "log", {}).facts;
  EXPECT_FALSE(facts.has_truth);
  EXPECT_FALSE(facts.noise_is_assumed);
  EXPECT_EQ(facts.delay_source, DelaySource::kNoIdentities);
}

}  // namespace
}  // namespace stereobench::harness
