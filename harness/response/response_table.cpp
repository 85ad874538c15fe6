#include "harness/response/response_table.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"
#include "harness/response/response_words.h"

namespace stereobench::harness {
namespace {

std::vector<const CurveFit*> curves_with_law(const ResponseFit& fit) {
  std::vector<const CurveFit*> curves;
  if (fit.bound && fit.bound->law) curves.push_back(&*fit.bound);
  for (const CurveFit& filter : fit.filters)
    if (filter.law) curves.push_back(&filter);
  return curves;
}

nlohmann::ordered_json value_json(const ResponseValue& value) {
  return {{"value", number(value.value)},
          {"ci95_low", number(value.interval.low)},
          {"ci95_high", number(value.interval.high)}};
}

nlohmann::ordered_json law_json(const ResponseLaw& law, double farthest_level) {
  return {{"floor_m", value_json(law.floor_m)},
          {"slope_m_per_unit", value_json(law.slope)},
          {"knee", value_json(law.knee)},
          {"upper_knee", value_json(law.upper_knee)},
          {"upper_exponent", value_json(law.exponent)},
          {"upper_exponent_of_law", number(law.exponent_of_law)},
          {"floor_over_bound", value_json(law.floor_over_bound)},
          {"farthest_level", farthest_level},
          {"holds", law.holds}};
}

nlohmann::ordered_json curve_json(const CurveFit& curve, const std::vector<double>& levels) {
  nlohmann::ordered_json json = {{"name", curve.name}, {"law", nullptr}};
  if (curve.law) json["law"] = law_json(*curve.law, levels[curve.law->farthest]);
  json["levels"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LevelError& error = curve.levels[i];
    json["levels"].push_back({{"level", levels[i]},
                              {"runs", error.runs},
                              {"error_rms_m", value_json(error.error_m)},
                              {"over_bound", value_json(error.over_bound)},
                              {"off_law", number(error.off_law)},
                              {"is_off_by_chance", error.is_off_by_chance}});
  }
  return json;
}

}  // namespace

std::string response_table(const ResponseFit& fit) {
  const std::vector<const CurveFit*> curves = curves_with_law(fit);
  if (curves.empty()) return {};
  AlignedTable table;
  table.header = response_header(fit);
  for (const CurveFit* const curve : curves) table.rows.push_back(response_row(fit, *curve));
  std::string text = fmt::format("response to {}, {} seeds\n", fit.parameter, fit.seeds) + plain_text(table);
  for (const std::string& sentence : response_sentences(fit)) text += sentence + "\n";
  return text;
}

nlohmann::ordered_json response_json(const ResponseFit& fit) {
  nlohmann::ordered_json json = {{"schema", 1},
                                 {"parameter", fit.parameter},
                                 {"seeds", fit.seeds},
                                 {"bound", nullptr},
                                 {"filters", nlohmann::ordered_json::array()},
                                 {"sentences", response_sentences(fit)}};
  if (fit.bound) json["bound"] = curve_json(*fit.bound, fit.levels);
  for (const CurveFit& filter : fit.filters) json["filters"].push_back(curve_json(filter, fit.levels));
  return json;
}

}  // namespace stereobench::harness
