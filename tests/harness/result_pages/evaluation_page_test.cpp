// The page of an evaluated trajectory. Mutations, each tried: degrees left out of a rotation; the relative
// errors in place of the absolute ones in the chart; estimate and truth exchanged on the map.
#include "harness/result_pages/evaluation_page.h"

#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/page/spaced_steps.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;

constexpr double kTurn_rad = 0.01;

/// Poses along x, one a second. @param off of every second one, m, to the left, where the body is turned
Trajectory along_x(std::size_t poses, double off_m) {
  Trajectory path;
  for (std::size_t i = 0; i < poses; ++i) {
    PoseInSpace pose;
    pose.position_m = Eigen::Vector3d(static_cast<double>(i), i % 2 == 1 ? off_m : 0.0, 0.0);
    if (i % 2 == 1 && off_m != 0.0)
      pose.rotation = Eigen::AngleAxisd(kTurn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    path.poses.push_back(pose);
    path.stamps_ns.push_back(static_cast<std::int64_t>(i) * 1'000'000'000);
  }
  return path;
}

Evaluation evaluated(std::size_t poses) {
  return evaluate(along_x(poses, 0.5), along_x(poses, 0.0),
                  {.align = AlignmentKind::kNone, .segments_m = {2.0}});
}

const Block& block_of(const Page& page, const std::string& title) {
  for (const Block& block : page.blocks)
    if (block.title == title) return block;
  throw std::runtime_error("no block " + title);
}

TEST(EvaluationPage, ShowsErrorsInMetresAndDegrees) {
  const Page page = evaluation_page(evaluated(21), "estimate.txt", "truth.txt", {}, {});
  const auto& rows = std::get<PageTable>(block_of(page, "Errors").content).rows;
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].cells[1].number, 21.0);
  EXPECT_DOUBLE_EQ(*rows[0].cells[7].number, 0.5);
  EXPECT_NEAR(*rows[1].cells[7].number, kTurn_rad * 180.0 / std::numbers::pi, 1e-9);
  EXPECT_EQ(rows[2].cells[0].text, "relative, over 1 pose, translation [m]");

  const auto& charts = std::get<PageCharts>(block_of(page, "Absolute error over time").content).charts;
  ASSERT_EQ(charts.size(), 2U);
  const Series& position = charts[0].series.at(0);
  EXPECT_EQ(position.x.size(), 21U);
  EXPECT_THAT(std::vector<double>(position.y.begin(), position.y.begin() + 4),
              ElementsAre(0.0, 0.5, 0.0, 0.5));
  EXPECT_EQ(std::get<PageTable>(block_of(page, "Errors by length").content).rows.size(), 2U);
}

TEST(EvaluationPage, ShowsBothPathsOnTheMap) {
  const Page page = evaluation_page(evaluated(21), "estimate.txt", "truth.txt", {}, {});
  const auto& map = std::get<PageMap>(block_of(page, "Map").content);
  ASSERT_EQ(map.truth.size(), 21U);
  EXPECT_EQ(*map.truth[3], Eigen::Vector3d(3.0, 0.0, 0.0));
  EXPECT_EQ(map.estimates.at(0).path[3], Eigen::Vector2d(3.0, 0.5));
  EXPECT_FALSE(page_html(page).empty());
}

TEST(EvaluationPage, StaysSmallForALongPath) {
  const Page page = evaluation_page(evaluated(100'000), "estimate.txt", "truth.txt", {}, {});
  EXPECT_LT(page_html(page).size(), 1'000'000U);
}

TEST(SpacedSteps, AreAllOrEveryNth) {
  EXPECT_THAT(spaced_steps(4, 4), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(spaced_steps(5, 4), ElementsAre(0, 2, 4));
  EXPECT_THAT(spaced_steps(0, 4), ElementsAre());
  for (std::size_t steps = 1; steps < 200; ++steps) {
    EXPECT_LE(spaced_steps(steps, 7).size(), 7U) << steps;
    EXPECT_LT(steps - 1 - spaced_steps(steps, 7).back(), (steps + 7) / 7) << steps;
  }
}

}  // namespace
}  // namespace stereobench::harness
