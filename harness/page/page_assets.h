/// The parts of a page that are the same for all, put into the program when it is built: the program that is
/// installed has no source tree.
#pragma once

#include <string_view>

namespace stereobench::harness {

extern const std::string_view kPageStyle;   ///< CSS
extern const std::string_view kChartJs;     ///< Debian's libjs-chart.js
extern const std::string_view kPageScript;  ///< ours

}  // namespace stereobench::harness
