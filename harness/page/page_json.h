/// A page as data for its script.
#pragma once

#include <nlohmann/json.hpp>

#include "harness/page/page.h"

namespace stereobench::harness {

/// Numbers have six significant digits; what is not finite is null. Pictures are in base64 (RFC 4648).
/// @throws std::invalid_argument as page_html
nlohmann::ordered_json page_json(const Page& page);

}  // namespace stereobench::harness
