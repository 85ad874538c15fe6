#include "worlds/scenario_parts.h"

namespace stereobench::worlds {
namespace {

Gate read_gate(const YamlValue& value) {
  const YamlMap map(value, {"metric", "at_most", "at_least"});
  constexpr Interval kLimit = {-1e12, 1e12};
  const auto at_most = map.find("at_most");
  const auto at_least = map.find("at_least");
  if (at_most.has_value() == at_least.has_value()) value.refuse("expected either at_most or at_least");
  return {map.at("metric").text(), at_most ? Gate::Relation::kAtMost : Gate::Relation::kAtLeast,
          (at_most ? at_most : at_least)->number(kLimit)};
}

}  // namespace

std::vector<Gate> read_gates(const YamlValue& value) {
  std::vector<Gate> gates;
  for (const YamlValue& gate : value.list(0, 1000)) gates.push_back(read_gate(gate));
  return gates;
}

}  // namespace stereobench::worlds
