/// What a study found, as a table, as sentences and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/sensitivity/sensitivity.h"

namespace stereobench::harness {

/// One row a factor, by total index: its values, first and total index, each with its interval.
std::string sensitivity_table(const Sensitivity& study);

/// What the indices mean, and what is to be known before they are believed: what is chance, which factors act
/// together, which indices cannot be told from 0, which runs failed. A sentence or two each.
std::vector<std::string> sensitivity_remarks(const Sensitivity& study);

/// The table with the remarks below it.
std::string sensitivity_text(const Sensitivity& study);

/// The content of sensitivity.json; factors in the order of the study. What does not exist is null.
nlohmann::ordered_json sensitivity_json(const Sensitivity& study);

}  // namespace stereobench::harness
