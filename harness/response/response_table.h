/// A response as a table for terminals and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "harness/response/response_fit.h"

namespace stereobench::harness {

/// One row for the bound and each filter with its law, and the sentences below.
/// @return empty where no curve has a law
std::string response_table(const ResponseFit& fit);

/// All that is known, level by level and of the laws. What is infinite or not known is null.
nlohmann::ordered_json response_json(const ResponseFit& fit);

}  // namespace stereobench::harness
