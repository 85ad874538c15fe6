/// What the shipped scenarios promise by their gates, run with their own seeds.
#include <algorithm>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "harness/experiment/experiment.h"
#include "renderer/surfaces/mesh_cache.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/regression/gate_distance.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

class ShippedScenario : public testing::TestWithParam<const char*> {};

// A limit that is far from what is measured lets much pass before it breaks.
// Mutations: edges mixed into balls before them (the corridor's normalised error is 1.5); a gate that is set
// to a round number, such as the corridor's range_rms_m to 0.0175.
TEST_P(ShippedScenario, KeepsItsGatesAndHasThemNear) {
  const TestFolder scratch;
  const Outcome outcome =
      run_stereobench({"run", scenario_path(GetParam()), "--jobs", "2", "--out", scratch.path().string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("gates hold"));
  renderer::MeshCache meshes;
  const Experiment experiment = read_experiment(scenario_path(GetParam()), {}, meshes.occluders());
  const auto run = nlohmann::ordered_json::parse(bytes_of(scratch.path() / "run.json"));
  const std::vector<GateDistance> distances = gate_distances(run, experiment.gates);
  EXPECT_FALSE(distances.empty());
  for (const GateDistance& distance : distances)
    EXPECT_FALSE(distance.is_far()) << distance.gate.metric << "\n" << distance_table(distances);
}

// A suite each, so that they run side by side.
INSTANTIATE_TEST_SUITE_P(BallCircle, ShippedScenario, testing::Values("ball_circle"));
INSTANTIATE_TEST_SUITE_P(Corridor, ShippedScenario, testing::Values("corridor"));
INSTANTIATE_TEST_SUITE_P(Office, ShippedScenario, testing::Values("office"));
INSTANTIATE_TEST_SUITE_P(OpenField, ShippedScenario, testing::Values("open_field"));
INSTANTIATE_TEST_SUITE_P(Room, ShippedScenario, testing::Values("room"));

// Mutation: a scenario without a gate on its NIS.
TEST_P(ShippedScenario, LimitsWhatMayGoWrongBothWays) {
  renderer::MeshCache meshes;
  const Experiment experiment = read_experiment(scenario_path(GetParam()), {}, meshes.occluders());
  const auto has = [&](const std::string& metric, Gate::Relation relation) {
    return std::ranges::any_of(experiment.gates, [&](const Gate& gate) {
      return gate.metric == metric && gate.relation == relation;
    });
  };
  const std::string nis = "filters.smoother.consistency.nis.per_run.mean";
  EXPECT_TRUE(has(nis, Gate::Relation::kAtLeast) && has(nis, Gate::Relation::kAtMost));
  if (experiment.scenario.sensor != worlds::SensorKind::kStereo) return;
  EXPECT_TRUE(has("vision.recall", Gate::Relation::kAtLeast));
  EXPECT_TRUE(has("vision.range_rms_m", Gate::Relation::kAtMost));
  EXPECT_TRUE(has("vision.normalised_error", Gate::Relation::kAtLeast));
  EXPECT_TRUE(has("vision.normalised_error", Gate::Relation::kAtMost));
}

}  // namespace
}  // namespace stereobench::harness
