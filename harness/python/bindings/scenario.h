/// A scenario as Python holds it.
#pragma once

#include <memory>
#include <string>

#include "harness/commands/scenario_arguments.h"
#include "harness/experiment/types.h"

namespace stereobench::harness::bindings {

/// What the program's command line would say, and the experiment that this makes of the file.
struct PyScenario {
  ScenarioArguments arguments;
  Experiment experiment;
};

/// The fingerprint of pixels_of, found in this process: none is forked where a GL context may live, since its
/// rasteriser's threads would be missing in the child.
std::string pixels_here(const PyScenario& scenario);

using ScenarioPointer = std::shared_ptr<const PyScenario>;

}  // namespace stereobench::harness::bindings
