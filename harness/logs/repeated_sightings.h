/// Sightings that stand in a log more than once.
#pragma once

#include <vector>

#include "harness/logs/recorded_streams.h"

namespace stereobench::harness {

/// Takes out sightings that stand in the log already: within 1 ms of another, of the same identity and
/// colour, with exactly its range and bearing. A sensor with noise does not measure the same twice, and
/// filters would take both for evidence.
/// @param sightings in order of time; the first of equals stays
/// @return how many were taken out
long drop_repeated(std::vector<LoggedSighting>& sightings);

/// @param sightings in order of time, without repeated ones
/// @return how many name a landmark that another one within 1 ms before names as well
long count_concurrent(const std::vector<LoggedSighting>& sightings);

}  // namespace stereobench::harness
