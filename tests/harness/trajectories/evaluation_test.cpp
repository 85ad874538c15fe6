#include "harness/trajectories/evaluation.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "harness/trajectories/trajectory_file.h"
#include "tests/harness/trajectories/paths.h"

namespace stereobench::harness {
namespace {

const std::filesystem::path kFolder = STEREOBENCH_SOURCE_DIR "/../shared/data/trajectories";

Evaluation of_freiburg(const std::string& estimate, AlignmentKind align, const std::string& delta,
                       bool all_pairs = false) {
  EvaluationRules rules{.align = align, .delta = parse_delta(delta)};
  rules.delta.all_pairs = all_pairs;
  return evaluate(read_trajectory(kFolder / ("freiburg1_xyz-" + estimate)),
                  read_trajectory(kFolder / "freiburg1_xyz-groundtruth.txt"), rules);
}

// The figures with six decimals are those that evo publishes of these files; the others are of a program of a
// few lines of numpy, written from the papers' definitions.
TEST(Evaluation, HasTheFiguresOfOthers) {
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const Evaluation orb = of_freiburg("ORB_kf_mono.txt", AlignmentKind::kSim3, "1");
  const ErrorStatistics ape = statistics_of(orb.absolute.translation_m);
  EXPECT_EQ(orb.pairs.truth.size(), 32U);
  EXPECT_NEAR(ape.rmse, 0.009755, 5e-7);
  EXPECT_NEAR(ape.max, 0.027924, 5e-7);
  EXPECT_NEAR(ape.rmse, 0.009754581898685107, 1e-12);
  EXPECT_NEAR(orb.alignment.scale, 1.1056223637370342, 1e-12);
  EXPECT_NEAR(statistics_of(orb.absolute.rotation_rad).rmse, 0.0413961357685684, 1e-12);
  EXPECT_NEAR(statistics_of(orb.relative.translation_m).rmse, 0.013834917845973986, 1e-12);
  EXPECT_NEAR(statistics_of(orb.relative.rotation_rad).rmse, 0.015443527730036434, 1e-12);

  const Evaluation rgbd = of_freiburg("rgbdslam.txt", AlignmentKind::kSe3, "10", true);
  EXPECT_EQ(rgbd.pairs.truth.size(), 785U);
  EXPECT_NEAR(statistics_of(rgbd.absolute.translation_m).rmse, 0.013470, 5e-7);
  EXPECT_NEAR(statistics_of(rgbd.absolute.translation_m).max, 0.034760, 5e-7);
  EXPECT_EQ(rgbd.relative.translation_m.size(), 775U);
  EXPECT_NEAR(statistics_of(rgbd.relative.translation_m).rmse, 0.014040675998645384, 1e-12);
  const PoseErrors consecutive = of_freiburg("rgbdslam.txt", AlignmentKind::kNone, "10").relative;
  EXPECT_EQ(consecutive.translation_m.size(), 78U);
  EXPECT_NEAR(statistics_of(consecutive.translation_m).rmse, 0.014610132023888764, 1e-12);
  const PoseErrors metres = of_freiburg("rgbdslam.txt", AlignmentKind::kSe3, "0.5m").relative;
  EXPECT_EQ(metres.translation_m.size(), 16U);
  EXPECT_NEAR(statistics_of(metres.translation_m).rmse, 0.024259867258448586, 1e-12);
  EXPECT_NEAR(statistics_of(metres.translation_m).max, 0.03411456190510003, 1e-12);
}

// A helix, and an estimate of it that is off in waves, aligned in a plane: the figures of a program of a few
// lines of numpy. Mutation: the rotation of the plane's normal instead of that about it.
TEST(Evaluation, InAPlaneHasTheFiguresOfAnotherProgram) {
  Trajectory truth, estimate;
  for (int i = 0; i < 120; ++i) {
    const double t = 0.1 * i;
    const Eigen::Vector3d place(3.0 * std::cos(t), 0.2 * t, 3.0 * std::sin(t));
    truth.poses.push_back({turned(-t, {0.0, 1.0, 0.0}), place});
    estimate.poses.push_back({turned(0.05 * std::sin(3.0 * t) - t, {0.0, 1.0, 0.0}),
                              0.8 * place + 0.1 * Eigen::Vector3d(std::sin(2.0 * t), t, std::cos(3.0 * t))});
  }
  const Evaluation evaluation = evaluate(
      estimate, truth, {.align = AlignmentKind::kSim2, .plane = Plane::kXz, .delta = parse_delta("10")});
  EXPECT_NEAR(evaluation.alignment.scale, 1.246182861811454, 1e-12);
  EXPECT_NEAR(statistics_of(evaluation.absolute.translation_m).rmse, 0.1252173746063724, 1e-12);
  EXPECT_NEAR(statistics_of(evaluation.absolute.rotation_rad).rmse, 0.035127928030137916, 1e-9);
  EXPECT_NEAR(statistics_of(evaluation.relative.translation_m).rmse, 0.2763028486570911, 1e-12);
}

// Law: aligned errors do not depend on the frame, nor on the scale where that is fitted.
TEST(Evaluation, DoesNotDependOnTheFrameOfTheEstimate) {
  const Trajectory truth = winding_path();
  const Trajectory estimate = disturbed(truth, 0.2, 0.05, 5);
  Trajectory elsewhere = estimate;
  elsewhere.poses = aligned(estimate.poses, {turned(2.5, {1.0, -1.0, 0.3}), {9.0, 8.0, 7.0}, 0.01});
  const EvaluationRules rules{.align = AlignmentKind::kSim3};
  const nlohmann::ordered_json here = evaluation_json(evaluate(estimate, truth, rules), "", "");
  const nlohmann::ordered_json there = evaluation_json(evaluate(elsewhere, truth, rules), "", "");
  for (const char* error : {"ape", "rpe"})
    for (const char* part : {"translation_m", "rotation_rad"})
      EXPECT_NEAR(here[error][part]["rmse"].get<double>(), there[error][part]["rmse"].get<double>(), 1e-10);
}

// Mutation: se3 for poses in the plane, whose positions on a line do not say how to roll.
TEST(Evaluation, AlignsPlanarPosesInThePlane) {
  Trajectory truth = winding_path(20);
  EXPECT_EQ(evaluate(truth, truth, {}).align, AlignmentKind::kSe3);
  truth.is_planar = true;
  for (PoseInSpace& pose : truth.poses) pose.position_m.tail<2>().setZero();
  const Evaluation evaluation = evaluate(truth, truth, {});
  EXPECT_EQ(evaluation.align, AlignmentKind::kSe2);
  EXPECT_LT(statistics_of(evaluation.absolute.translation_m).max, 1e-12);
}

}  // namespace
}  // namespace stereobench::harness
