/// Which lines of a scenario a stage of the chain depends on: world and cameras make pictures, a detector
/// sees them, filters are told what it saw.
#pragma once

#include <string>

namespace stereobench::harness {

/// The lines that pictures depend on. Scenarios in which they are equal have the same pictures for a seed.
/// @param scenario as of with_overrides
std::string lines_of_pictures(const std::string& scenario);

/// The lines that a detector's answers depend on, before anything makes them worse: those of the pictures,
/// the detector itself, and what it believes of the rig.
/// @param scenario as of with_overrides
std::string lines_of_sight(const std::string& scenario);

}  // namespace stereobench::harness
