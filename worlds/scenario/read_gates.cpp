#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {

const KeyGroup& gate_keys() {
  constexpr Interval kLimit = {-1e12, 1e12};
  static const KeyGroup keys = {
      .keys = {
          text("metric",
               "Keys of a number in run.json, joined by dots, e.g. vision.recall; "
               "`stereobench metrics` lists them.")
              .needed(),
          number("at_most", kLimit, "Largest value that passes.").needed_unless("at_least"),
          number("at_least", kLimit, "Smallest value that passes.").otherwise_says("at_most"),
      }};
  return keys;
}

Gate read_gate(const YamlValue& value) {
  const YamlMap map(value, gate_keys());
  if (map.find("at_most") && map.find("at_least")) value.refuse("expected either at_most or at_least");
  const bool at_most = map.find("at_most").has_value();
  return {map.at("metric").text(), at_most ? Gate::Relation::kAtMost : Gate::Relation::kAtLeast,
          map.number(at_most ? "at_most" : "at_least")};
}

}  // namespace stereobench::worlds
