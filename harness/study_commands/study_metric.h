/// The metric that a study asks for.
#pragma once

#include <string>
#include <vector>

#include "harness/commands/scenario_arguments.h"
#include "harness/run/seed_metrics.h"

namespace stereobench::harness {

/// Makes sure that a run has a metric, and lets it run no other filter than the metric is of unless the
/// command line names filters.
/// @param metric a name of run.json; ".mean" may be left out
/// @return the name that SeedMetrics has
/// @throws std::runtime_error that names a metric that may be meant, and for what the sensor does not have
std::string choose_metric(const std::string& metric, ScenarioArguments& base);

/// Studies hold no result against gates. @throws std::runtime_error where the command line names one
void refuse_gates(const ScenarioArguments& base);

/// The metric of each seed; NaN where it has none.
std::vector<double> values_of_metric(const SeedMetrics& metrics, const std::string& metric,
                                     std::size_t seeds);

}  // namespace stereobench::harness
