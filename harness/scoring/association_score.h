/// Whether a filter told landmarks apart: its decisions against the truth behind each sighting.
#pragma once

#include <span>
#include <vector>

#include "harness/types.h"
#include "slam/association/decisions.h"

namespace stereobench::harness {

/// The true landmark of each sighting of a log, in the order in which a filter is given them; kUnknown for a
/// sighting of nothing. Empty when the log does not say so at every step.
std::vector<int> true_landmarks(const MeasurementLog& log);

/// @return whether every sighting of a log carries an identity
bool knows_identities(const MeasurementLog& log);

/// Counts the decisions about one frame. A landmark of the map is the true one that the sighting which
/// founded it was of.
/// @param decisions of the last update (of many particles the heaviest decides)
/// @param truth by number of the sighting, as true_landmarks() gives it
void judge(const slam::Decisions& decisions, std::span<const int> truth, AssociationScore& score);

/// Counts what is twice in the final map, and what is there for nothing.
void judge_map(std::span<const slam::LandmarkEstimate> map, std::span<const int> truth,
               AssociationScore& score);

/// The sums of two runs.
AssociationScore operator+(const AssociationScore& a, const AssociationScore& b);

}  // namespace stereobench::harness
