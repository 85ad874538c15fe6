/// Histories for people and for programs.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "harness/history/history.h"

namespace stereobench::harness {

/// A line for each result: its number from 1, where it lies, its scenario and seeds.
/// @param places and scenarios one a result
std::string result_list(std::span<const std::string> places, std::span<const std::string> scenarios,
                        std::span<const SeedTable> results);

/// A line for each step, the worst first; empty where there is none.
std::string step_table(const History& history);

/// Lines on how much was looked at, and which metrics are without some of their values.
std::string history_summary(const History& history, std::size_t results);

/// A line that begins with "warning: " where there are too few seeds for any step; else empty.
std::string history_warning(const History& history, const HistorySettings& settings);

/// The histories for programs: each metric's means and steps.
/// @param places of the results
nlohmann::ordered_json history_json(const History& history, const HistorySettings& settings,
                                    std::span<const std::string> places);

}  // namespace stereobench::harness
