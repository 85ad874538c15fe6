#include "harness/budget/budget_report.h"

#include <limits>

#include <gmock/gmock.h>

#include "harness/budget/budget_page.h"
#include "harness/budget/budget_picture.h"
#include "tests/harness/budget/made_up_worlds.h"
#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A study whose seed s breaks the limit from the level 0.5 + s / 1000 on.
BudgetStudy study_of(const std::vector<BudgetMix>& mixes, std::size_t seeds = 59) {
  BudgetStudy study{.scenario = "circle",
                    .limit = {"filters.smoother.ate_rms_m", Gate::Relation::kAtMost, 0.05},
                    .seeds = seeds_from(0, seeds)};
  for (const BudgetMix& mix : mixes)
    study.answers.push_back(
        {mix, find_budget({budget_levels(mix, study.tolerance), study.seeds, study.limit, study.wanted},
                          MadeUpWorlds{[](double level, std::uint64_t seed) {
                            return 0.05 * level / (0.5 + 0.001 * static_cast<double>(seed));
                          }})});
  return study;
}

std::string sentence_of(const BudgetStudy& study) {
  return budget_sentence(study, study.answers.front());
}

const BudgetMix kNoise = {{"noise.sd_px", 0.0, 2.0}};
const BudgetMix kBoth = {{"noise.sd_px", 0.0, 2.0}, {"noise.miss", 0.0, 0.1}};

// Mutations: the number of seeds that fail for that of those that may; the wrong relation; "up to" for what
// goes down.
TEST(BudgetReport, SaysTheAnswerInASentence) {
  EXPECT_EQ(sentence_of(study_of({kNoise})),
            "noise.sd_px may be up to 0.5: filters.smoother.ate_rms_m <= 0.05 in at least 95 % of worlds, "
            "with 95 % confidence. Of 59 seeds none may fail, and none does. At 0.51 too many fail.");
  EXPECT_EQ(
      sentence_of(study_of({kBoth}, 93)),
      "noise.sd_px and noise.miss may together go up to 0.5 of the way (noise.sd_px=1, "
      "noise.miss=0.05): "
      "filters.smoother.ate_rms_m <= 0.05 in at least 95 % of worlds, with 95 % confidence. Of 93 seeds "
      "1 may fail, and none does. At 0.51 too many fail.");
  EXPECT_EQ(sentence_of(study_of({{{"noise.sd_px", 0.0, 0.25}}})),
            "noise.sd_px may be up to 0.25, the end of the range: filters.smoother.ate_rms_m <= 0.05 in at "
            "least 95 % of worlds, with 95 % confidence. Of 59 seeds none may fail, and none does. Nothing "
            "worse was tried.");
  BudgetStudy none = study_of({kBoth});
  none.answers[0].budget.outcome = BudgetOutcome::kNone;
  none.answers[0].budget.level = 0.0;
  none.answers[0].budget.failing = 4;
  EXPECT_EQ(
      sentence_of(none),
      "noise.sd_px and noise.miss together have no budget: filters.smoother.ate_rms_m <= 0.05 is broken by "
      "4 of 59 seeds at 0 (noise.sd_px=0, noise.miss=0) already, and none may fail.");
  EXPECT_EQ(sentence_of(study_of({{{"noise.sd_px", 0.51, 1.0}}})),
            "noise.sd_px has no budget: filters.smoother.ate_rms_m <= 0.05 is broken by 10 of 59 seeds at "
            "0.51 already, and none may fail.");
}

TEST(BudgetReport, SaysDownToWhereLessIsWorse) {
  BudgetStudy study = study_of({kNoise});
  study.limit = {"vision.recall", Gate::Relation::kAtLeast, 0.9};
  study.answers = {
      {{{"light", 1.0, 0.0}},
       {.outcome = BudgetOutcome::kFound, .level = 0.3, .fails_at = 0.29, .may_fail = 2, .failing = 1}}};
  EXPECT_EQ(
      sentence_of(study),
      "light may be down to 0.3: vision.recall >= 0.9 in at least 95 % of worlds, with 95 % confidence. "
      "Of 59 seeds 2 may fail, and 1 does. At 0.29 too many fail.");
}

// Mutations: the level's own value for that of each line; runs without their seeds; NaN that is 0.
TEST(BudgetReport, JsonHasTheQuestionTheAnswersAndAllRuns) {
  BudgetStudy study = study_of({kNoise, kBoth});
  study.answers[0].budget.runs[3].value = kNaN;
  const nlohmann::ordered_json json = budget_json(study);
  EXPECT_EQ(json["metric"], "filters.smoother.ate_rms_m");
  EXPECT_EQ(json["relation"], "<=");
  EXPECT_EQ(json["limit"], 0.05);
  EXPECT_EQ(json["seeds"].size(), 59U);
  const auto& alone = json["budgets"][0];
  EXPECT_EQ(alone["outcome"], "found");
  EXPECT_EQ(alone["level"], 0.5);
  EXPECT_EQ(alone["fails_at"], 0.51);
  EXPECT_EQ(alone["keys"][0]["value"], 0.5);
  EXPECT_EQ(alone["values"].size(), 59U);
  EXPECT_EQ(alone["runs"].size(), study.answers[0].budget.runs.size());
  EXPECT_EQ(alone["runs"][0]["level"], 2.0);
  EXPECT_EQ(alone["runs"][2]["seed"], 2);
  EXPECT_TRUE(alone["runs"][3]["value"].is_null());
  const auto& together = json["budgets"][1];
  EXPECT_EQ(together["level"], 0.5);
  EXPECT_EQ(together["keys"][0]["value"], 1.0);
  EXPECT_EQ(together["keys"][1]["value"], 0.05);
}

TEST(BudgetReport, TableHasARowAnAnswer) {
  BudgetStudy study = study_of({kNoise, kBoth, {{"noise.sd_px", 0.51, 1.0}}});
  for (BudgetAnswer& answer : study.answers) {
    answer.budget.runs.resize(7);
    answer.budget.grid_runs = 590;
  }
  EXPECT_EQ(budget_table(study),
            "may get worse                        up to  fails at  seeds that fail  runs  full grid\n"
            "--------------------------  --------------  --------  ---------------  ----  ---------\n"
            "noise.sd_px                            0.5      0.51          0 of 59     7        590\n"
            "noise.sd_px and noise.miss  0.5 of the way      0.51          0 of 59     7        590\n"
            "noise.sd_px                              -      0.51         10 of 59     7        590\n");
}

// Mutations: warnings of all answers at once; seeds that have no value at other levels.
TEST(BudgetReport, WarnsOfWhatTheBoundDoesNotTakeIn) {
  BudgetStudy study = study_of({kNoise});
  EXPECT_EQ(budget_warnings(study), "");
  Budget& budget = study.answers.front().budget;
  budget.not_monotone = {3, 17};
  EXPECT_EQ(budget_warnings(study),
            "warning: noise.sd_px: seeds 3,17 kept the limit at a worse level than one at which they broke "
            "it; the bound takes worse levels to be worse for all\n");
  budget.not_monotone.clear();
  budget.values[5] = kNaN;
  EXPECT_EQ(budget_warnings(study),
            "warning: noise.sd_px: 1 of 59 seeds have no filters.smoother.ate_rms_m at 0.5, and count as "
            "failed\n");
}

template <class Content>
const Content& block_of(const Page& page, const std::string& title) {
  for (const Block& block : page.blocks)
    if (block.title == title) return std::get<Content>(block.content);
  throw std::runtime_error("no block " + title);
}

// Mutations: all runs in one series; the budget at the level that fails; seeds of another answer.
TEST(BudgetPage, ShowsRunsLimitAndBudget) {
  const BudgetStudy study = study_of({kNoise, kBoth});
  const std::vector<std::string> words = {"stereobench", "budget", "a b.yaml"};
  const Page page = budget_page(study, words);
  EXPECT_EQ(block_of<PageText>(page, "Answer").lines.size(), 2U);
  const Chart& chart =
      block_of<PageCharts>(page, "filters.smoother.ate_rms_m against the level").charts.at(0);
  EXPECT_EQ(chart.series.at(0).x.size() + chart.series.at(1).x.size(), study.answers[0].budget.runs.size());
  for (const double value : chart.series.at(0).y) EXPECT_LE(value, 0.05);
  for (const double value : chart.series.at(1).y) EXPECT_GT(value, 0.05);
  EXPECT_THAT(chart.series.at(2).y, ElementsAre(0.05, 0.05));
  EXPECT_THAT(chart.series.at(3).x, ElementsAre(0.5, 0.5));
  const auto& seeds = block_of<PageTable>(page, "Seeds at the budget");
  ASSERT_EQ(seeds.rows.size(), 59U);
  EXPECT_EQ(seeds.rows[20].cells.at(1).number, 0.05 * 0.5 / 0.52);
  EXPECT_THAT(page.blocks.at(0).commands, ElementsAre("stereobench budget 'a b.yaml' --seeds 0..58"));
  EXPECT_THAT(page_html(page), HasSubstr("may be up to 0.5"));
  EXPECT_TRUE(budget_page(study, {}).blocks.at(0).commands.empty());
}

constexpr Colour kGreenOfBudget = {0.0, 0.620, 0.451, 1.0};

/// Where the budget's line is on the picture, between the left and the right end of the plot.
double budget_column(const BudgetStudy& study) {
  const cv::Mat image = decoded(draw_budget_picture(study));
  return mean_of(pixels_of(image(cv::Rect(0, 0, 815, image.rows)), kGreenOfBudget, 40.0)).x_px;
}

// Mutations: the next level; a line where nothing holds; the bad end for the budget.
TEST(BudgetPicture, HasTheBudgetWhereItIs) {
  BudgetStudy study = study_of({kNoise});
  const double half = budget_column(study);
  study.answers[0].budget.level = 1.0;
  const double one = budget_column(study);
  study.answers[0].budget.level = 1.5;
  EXPECT_NEAR(budget_column(study) - one, one - half, 1.5);
  EXPECT_NEAR(one, 84.0 + 0.5 * 730.0, 1.5);
  study.answers[0].budget.outcome = BudgetOutcome::kNone;
  EXPECT_TRUE(std::isnan(budget_column(study)) || budget_column(study) == 0.0);
}

TEST(BudgetPicture, HasAPanelAnAnswerAndEqualBytes) {
  const BudgetStudy one = study_of({kNoise}), two = study_of({kNoise, kBoth});
  EXPECT_GT(decoded(draw_budget_picture(two)).rows, decoded(draw_budget_picture(one)).rows + 200);
  EXPECT_EQ(draw_budget_picture(two), draw_budget_picture(two));
}

// Runs without a value, infinite ones, a range below zero, a budget that is a small part of the range.
TEST(BudgetPicture, NonsenseIsAPicture) {
  BudgetStudy study = study_of({kNoise});
  study.answers[0].budget.runs[0].value = kNaN;
  study.answers[0].budget.runs[1].value = std::numeric_limits<double>::infinity();
  study.answers[0].budget.level = 0.0;
  EXPECT_FALSE(decoded(draw_budget_picture(study)).empty());
  for (BudgetRun& run : study.answers[0].budget.runs) run = {-run.level, run.seed, -1.0};
  EXPECT_FALSE(decoded(draw_budget_picture(study)).empty());
}

}  // namespace
}  // namespace stereobench::harness
