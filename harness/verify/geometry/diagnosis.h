/// Which cause makes links disagree, from all links of a data set together.
#pragma once

#include <vector>

#include "harness/verify/geometry/hypothesis.h"

namespace stereobench::harness {

/// Finds what is wrong with the geometry of a data set. The cause that leaves the least disagreement is
/// named, with what was measured; where none helps, what disagrees is named alone. Frames that are off alone
/// have faults of their own.
std::vector<Fault> diagnose(const DatasetView& view, const std::vector<Link>& links, Margins& margins);

}  // namespace stereobench::harness
