/// Pages of results: that they say what the results say.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/frames/pair_files.h"
#include "harness/result_pages/calibration_page.h"
#include "harness/result_pages/changed_frames.h"
#include "harness/result_pages/comparison_page.h"
#include "harness/result_pages/gates_block.h"
#include "harness/result_pages/run_page.h"
#include "harness/result_pages/sweep_page.h"
#include "harness/run/run_tally.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> titles_of(const std::vector<Block>& blocks) {
  std::vector<std::string> titles;
  for (const Block& block : blocks) titles.push_back(block.title);
  return titles;
}

template <class Content>
const Content& content_of(const std::vector<Block>& blocks, const std::string& title) {
  for (const Block& block : blocks)
    if (block.title == title) return std::get<Content>(block.content);
  throw std::runtime_error("no block " + title);
}

std::vector<std::string> column(const PageTable& table, std::size_t index) {
  std::vector<std::string> texts;
  for (const PageRow& row : table.rows) texts.push_back(row.cells.at(index).text);
  return texts;
}

// Mutations: the table in the order of the file; a gate without a value that holds; the room's sign.
TEST(GatesBlock, HasTheBrokenOnesFirst) {
  const nlohmann::ordered_json json = {{"a", 1.0}, {"b", 2.0}, {"c", nullptr}};
  const std::vector<Gate> gates = {{"a", Gate::Relation::kAtMost, 1.0},
                                   {"a", Gate::Relation::kAtLeast, 0.25},
                                   {"b", Gate::Relation::kAtMost, 1.5},
                                   {"c", Gate::Relation::kAtLeast, 0.0}};
  const Block block = gates_block(gates, json);
  const auto& table = std::get<PageTable>(block.content);
  EXPECT_THAT(column(table, 0), ElementsAre("b", "c", "a", "a"));
  EXPECT_THAT(column(table, 1), ElementsAre("BROKEN", "BROKEN", "HOLDS", "HOLDS"));
  EXPECT_EQ(table.rows[0].cells[4].number, -0.5);
  EXPECT_EQ(table.rows[3].cells[4].number, 0.75);
  EXPECT_FALSE(table.rows[1].is_quiet);
  EXPECT_TRUE(table.rows[2].is_quiet);
  EXPECT_THAT(block.note, HasSubstr("2 of 4"));
}

/// A seed that drives along x for some steps with one filter, which is `off_m` beside it.
SeedResult seed_of(std::uint64_t seed, double off_m) {
  SeedDrive drive{.seed = seed};
  drive.runs = {{.filter = "dead_reckoning"}};
  for (int k = 0; k < 6; ++k) {
    drive.recording.log.steps.push_back(
        {.stamp_ns = k * kSecond_ns, .truth = slam::Pose{static_cast<double>(k), 0.0, 0.0}});
    drive.recording.log.steps.back().measurements.push_back({.range_m = 3.0});
    drive.runs[0].poses.push_back({static_cast<double>(k), off_m, 0.0});
    drive.runs[0].covariances.push_back(Eigen::Vector3d(0.25, 1.0, 0.01).asDiagonal());
    drive.runs[0].updates.push_back({.innovations = {{0, 2.0 * off_m, false}}});
  }
  drive.recording.log.landmarks = {{0, 3, {7.0, 1.0}}};
  drive.runs[0].last.landmarks = {{0, 3, {7.5, 1.0}, Eigen::Matrix2d::Identity()}};
  drive.references.batch.failed = true;
  drive.pairs = {{seed, 4, {static_cast<long>(seed), 1.0}, "left", "right"}};
  return score_seed(drive, {.steps = true, .map = true});
}

struct RunOfTwo {
  RunResult result;
  RunCurves curves;
};

RunOfTwo run_of_two() {
  RunTally tally("name", kNoBackend);
  SeedMetricsTally metrics;
  RunOfTwo run;
  for (const SeedResult& seed : {seed_of(2, 0.3), seed_of(5, 0.4)}) {
    tally.add(seed);
    metrics.add(seed);
    run.curves.add(seed);
  }
  run.result = tally.result();
  run.result.seed_metrics = metrics.metrics();
  return run;
}

Page page_of_two(const RunStory& story = {}) {
  const RunOfTwo run = run_of_two();
  return run_page(run.result, run.curves, story, {}, run_json(run.result));
}

// Mutations: the first seed's errors for those of all; the mean for the rms; NIS over twice its degrees.
TEST(RunPage, DrawsErrorsAndConsistencyOfAllSeedsOverTime) {
  const Page page = page_of_two();
  const Chart& error = content_of<PageCharts>(page.blocks, "Error over time").charts.at(0);
  EXPECT_THAT(error.series.at(0).x, ElementsAre(0.0, 1.0, 2.0, 3.0, 4.0, 5.0));
  EXPECT_THAT(error.series.at(0).y, Each(testing::DoubleEq(std::sqrt(0.5 * (0.09 + 0.16)))));
  const auto& consistency = content_of<PageCharts>(page.blocks, "Consistency over time").charts;
  for (std::size_t k = 2; k < 6; ++k)  // errors of the first steps are not normalised
    EXPECT_NEAR(consistency.at(0).series.at(1).y.at(k), (0.09 + 0.16) / 6.0, 1e-12);
  EXPECT_THAT(consistency.at(1).series.at(1).y, Each(testing::DoubleNear((0.6 + 0.8) / 4.0, 1e-12)));
  const Band band = chi_square_band(0.95, 4);
  EXPECT_THAT(consistency.at(1).series.at(0).low, Each(band.low));
}

// Mutations: the second seed's map; landmarks without their true ones; the covariance of another step.
TEST(RunPage, MapsTheFirstSeed) {
  const Page page = page_of_two({.walls = {{.from_m = {0.0, 1.0}, .to_m = {2.0, 3.0}}}});
  const auto& map = content_of<PageMap>(page.blocks, "Map of seed 2");
  ASSERT_EQ(map.time_s.size(), 6U);
  EXPECT_EQ(map.truth.at(4).value(), Eigen::Vector3d(4.0, 0.0, 0.0));
  EXPECT_EQ(map.sightings.at(4).at(0), Eigen::Vector2d(7.0, 0.0));
  EXPECT_EQ(map.walls.at(0), (std::vector<Eigen::Vector2d>{{0.0, 1.0}, {2.0, 3.0}}));
  const PageEstimate& estimate = map.estimates.at(0);
  EXPECT_EQ(estimate.path.at(4), Eigen::Vector2d(4.0, 0.3));
  EXPECT_EQ(estimate.covariances.at(4), Eigen::Matrix2d(Eigen::Vector2d(0.25, 1.0).asDiagonal()));
  EXPECT_EQ(estimate.landmarks.at(0).true_one, 0U);
  EXPECT_EQ(map.landmarks.at(0).colour.size(), 7U);
}

// Mutations: the better pair first; seeds of all in a pair's command; commands where none are known.
TEST(RunPage, ShowsTheWorstPairsAndHowToMakeEverything) {
  const RunStory story = {
      .commands = {{"stereobench", "run", "a b.yaml"}, {"stereobench", "render", "a b.yaml"}}};
  const Page page = page_of_two(story);
  const auto& frames = content_of<PageFrames>(page.blocks, "The worst stereo pairs");
  ASSERT_EQ(frames.frames.size(), 2U);
  EXPECT_EQ(frames.frames[0].title, "seed 5, frame 4");
  EXPECT_EQ(frames.frames[0].command, "stereobench render 'a b.yaml' --seeds 5 --frames 4");
  EXPECT_EQ(frames.jpegs.at(frames.frames[1].panels.at(1).picture.value()), "right");
  EXPECT_THAT(page.blocks.front().commands, ElementsAre("stereobench run 'a b.yaml' --seeds 2,5"));
  for (const Block& block : page_of_two().blocks) EXPECT_TRUE(block.commands.empty()) << block.title;
}

// Mutation: the intervals of another seed's numbers.
TEST(RunPage, HasOnePointForEachSeed) {
  const Page page = page_of_two();
  const Series& series = content_of<PageCharts>(page.blocks, "Errors seed by seed").charts.at(0).series.at(0);
  EXPECT_THAT(series.y, ElementsAre(testing::DoubleEq(0.3), testing::DoubleEq(0.4)));
  EXPECT_THAT(content_of<PageCharts>(page.blocks, "Errors seed by seed").charts.at(0).x_names,
              ElementsAre("2", "5"));
}

/// A comparison of ten seeds: `worse` is 20 % worse on each, `same` equal.
struct Compared {
  StoredResult first, second;
  VerdictSettings settings;
  ResultComparison comparison;

  Compared() {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      first.seeds.seeds.push_back(seed);
      const double value = 1.0 + 0.1 * static_cast<double>(seed);
      first.seeds.metrics["filters.ekf.ate_rms_m"].push_back(value);
      second.seeds.metrics["filters.ekf.ate_rms_m"].push_back(1.2 * value);
      for (StoredResult* result : {&first, &second}) result->seeds.metrics["vision.recall"].push_back(1.0);
    }
    second.seeds.seeds = first.seeds.seeds;
    comparison = compare_results(first.seeds, second.seeds, settings);
  }
  ComparisonStory story() const { return {{"x", "y"}, first, second, comparison, settings, {}, {}}; }
};

// Mutations: what passes not hidden; the change in its unit for that in margins; A minus B.
TEST(ComparisonPage, HasVerdictsFirstAndChangesSeedBySeed) {
  const Compared compared;
  const std::vector<Block> blocks = comparison_blocks(compared.story());
  EXPECT_THAT(titles_of(blocks), ElementsAre("Verdicts", "Changes seed by seed"));
  const auto& table = content_of<PageTable>(blocks, "Verdicts");
  EXPECT_THAT(column(table, 1), ElementsAre("REGRESSED", "PASS"));
  EXPECT_FALSE(table.rows[0].is_quiet);
  EXPECT_TRUE(table.rows[1].is_quiet);
  const PageInterval drawn = table.rows[0].cells.at(4).interval.value();
  EXPECT_NEAR(drawn.value, 4.0, 1e-9);  // 20 % of a margin of 5 %
  EXPECT_GT(drawn.low, 1.0);
  EXPECT_GT(drawn.high, drawn.value);
  EXPECT_FALSE(table.rows[1].cells.at(4).interval);
  const auto& charts = content_of<PageCharts>(blocks, "Changes seed by seed").charts;
  ASSERT_EQ(charts.size(), 2U);
  EXPECT_NEAR(charts[0].series.at(0).y.at(3), 0.2 * 1.3, 1e-12);
  EXPECT_NEAR(charts[0].series.at(2).y.at(0), 0.2 * 1.45, 1e-12);
}

// Mutations: links to the wrong case; blocks without their chapter.
TEST(ComparisonPage, OfManyCasesHasATableThatLeadsToEach) {
  const Compared compared;
  const Page page = cases_page(
      "suite", {},
      {{.name = "one",
        .verdict = "PASS",
        .mark = CellMark::kGood,
        .blocks = comparison_blocks(compared.story())},
       {.name = "two", .verdict = "REGRESSED", .mark = CellMark::kBad, .reason = "lost: 3 of 3 at frame 7"}});
  EXPECT_THAT(titles_of(page.blocks), ElementsAre("Cases", "one", "Verdicts", "Changes seed by seed", "two"));
  const auto& table = std::get<PageTable>(page.blocks[0].content);
  EXPECT_EQ(table.rows[1].cells[0].link, page.blocks[4].identity);
  EXPECT_EQ(table.rows[0].cells[0].link, page.blocks[1].identity);
  EXPECT_TRUE(page.blocks[4].is_chapter);
  EXPECT_EQ(table.header.back(), "which balls");
  EXPECT_EQ(table.rows[1].cells.back().text, "lost: 3 of 3 at frame 7");
}

TEST(ComparisonPage, OfCasesWithoutLostBallsHasNoColumnForThem) {
  const Page page = cases_page("suite", {}, {{.name = "one", .verdict = "PASS"}});
  EXPECT_EQ(std::get<PageTable>(page.blocks[0].content).header.back(), "says");
}

// Mutations: equal pictures twice in the page; no picture where one result alone has kept the pair; A and B
// swapped.
TEST(ChangedFrames, HaveBothResultsSideBySide) {
  TestFolder folder;
  const KeptPair pair = {3, 41, {}, "left", "right"};
  write_pairs(folder.path() / "b", std::vector{pair}, {});
  const std::vector<DetectionRow> found = {
      {.seed = 3, .frame = 41, .outcome = "true_positive", .ball = 1, .is_required = true}};
  const std::vector<DetectionRow> missed = {
      {.seed = 3, .frame = 41, .outcome = "miss", .ball = 1, .is_required = true}};
  const std::vector<ChangedFrame> frames = {{3, 41, 1, 0.0}, {3, 42, 1, 0.0}};
  folder.write("b/invocation.json", "{}");
  const PageFrames shown =
      changed_frames({folder.path() / "a", found}, {folder.path() / "b", missed}, frames);
  ASSERT_EQ(shown.frames.size(), 2U);
  EXPECT_THAT(shown.jpegs, ElementsAre("left", "right"));
  const auto& panels = shown.frames[0].panels;
  ASSERT_EQ(panels.size(), 4U);
  EXPECT_EQ(panels[0].title, "A, left camera (picture of B)");
  EXPECT_EQ(panels[3].title, "B, right camera");
  EXPECT_EQ(panels[0].picture, 0U);
  EXPECT_EQ(panels[3].picture, 1U);
  EXPECT_EQ(panels[0].truth.at(0).fate, Fate::kFound);
  EXPECT_EQ(panels[1].truth.at(0).fate, Fate::kMissed);
  EXPECT_FALSE(shown.frames[1].panels[0].picture);
  EXPECT_THAT(shown.frames[1].command, AllOf(StartsWith("stereobench replay "), EndsWith("/b --frame 3:42")));
  EXPECT_TRUE(
      changed_frames({folder.path() / "a", found}, {folder.path() / "a", missed}, frames).frames.empty());
}

// Mutations: cells of all values of the second variation in one line; intervals of the wrong unit.
TEST(SweepPage, HasOneChartForEachCombinationOfTheOtherVariations) {
  SweepResult sweep{.name = "name", .variations = {parse_variation("a=1,2,3"), parse_variation("b=x,y")}};
  double off_m = 0.1;
  for (const Cell& cell : grid(sweep.variations)) {
    CellTally tally("name", kNoBackend);
    for (const std::uint64_t seed : {2U, 5U}) tally.add(seed_of(seed, off_m));
    sweep.cells.push_back(tally.cell(cell));
    off_m += 0.1;
  }
  const Page page = sweep_page(sweep, {}, "");
  const auto& charts = content_of<PageCharts>(page.blocks, "Errors of filters against a").charts;
  ASSERT_EQ(charts.size(), 4U);
  EXPECT_EQ(charts[0].name, "ATE rms [m] at b = x");
  EXPECT_THAT(charts[0].x_names, ElementsAre("1", "2", "3"));
  const auto near = [](double value) { return testing::DoubleNear(value, 1e-12); };
  EXPECT_THAT(charts[0].series.at(0).y, ElementsAre(near(0.1), near(0.3), near(0.5)));
  EXPECT_THAT(charts[2].series.at(0).y, ElementsAre(near(0.2), near(0.4), near(0.6)));
  EXPECT_EQ(content_of<PageTable>(page.blocks, "Cells").rows.size(), 6U);
}

// Mutations: the bound times what it is exceeded by; parts of balls among the whole ones.
TEST(CalibrationPage, DrawsErrorsBesideTheirBound) {
  CalibrationResult result{.scenario = "name"};
  result.bins = {{.nearest_m = 1.0,
                  .farthest_m = 4.0,
                  .samples = 9,
                  .sd = {0.006, 0.0002},
                  .over_bound = {2.0, 4.0},
                  .half_nis = {1.5, 1.25, 1.125}},
                 {.nearest_m = 1.0, .farthest_m = 4.0, .whole = false, .samples = 9}};
  const Page page = calibration_page(result, {}, {});
  const auto& charts = content_of<PageCharts>(page.blocks, "Errors and consistency over depth").charts;
  EXPECT_THAT(charts[0].series.at(0).x, ElementsAre(2.0));
  EXPECT_THAT(charts[0].series.at(0).y, ElementsAre(testing::DoubleEq(6.0)));
  EXPECT_THAT(charts[0].series.at(1).y, ElementsAre(testing::DoubleEq(3.0)));
  EXPECT_THAT(charts[1].series.at(1).y, ElementsAre(testing::DoubleEq(0.05)));
  EXPECT_THAT(charts[2].series.at(2).y, ElementsAre(1.125));
  EXPECT_EQ(content_of<PageTable>(page.blocks, "Errors by depth").rows.size(), 2U);
}

}  // namespace
}  // namespace stereobench::harness
