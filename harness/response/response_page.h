/// A response on a page of results.
#pragma once

#include <vector>

#include "harness/page/page.h"
#include "harness/response/response_fit.h"

namespace stereobench::harness {

/// The sentences, the laws as a table, and charts of the errors and of their ratios to the bound.
/// @return nothing where no curve has a law
std::vector<Block> response_blocks(const ResponseFit& fit);

}  // namespace stereobench::harness
