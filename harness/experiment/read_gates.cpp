#include "harness/experiment/experiment_parts.h"

namespace stereobench::harness {
namespace {

using worlds::Fields;
using worlds::Key;
using worlds::number;
using worlds::text;
using worlds::YamlMap;
using worlds::YamlValue;

constexpr worlds::Interval kLimit = {-1e12, 1e12};

std::function<void(const YamlValue&, Gate&)> limit(Gate::Relation relation) {
  return [relation](const YamlValue& value, Gate& gate) {
    gate.relation = relation;
    gate.limit = value.number(kLimit);
  };
}

std::function<YAML::Node(const Gate&)> written_limit(Gate::Relation relation) {
  return [relation](const Gate& gate) {
    return gate.relation == relation ? written(Key{}, gate.limit) : YAML::Node();
  };
}

void check_gate(const YamlMap& map, Gate&) {
  if (map.find("at_most") && map.find("at_least")) map.value().refuse("expected either at_most or at_least");
}

}  // namespace

const Fields<Gate>& gate_keys() {
  static const Fields<Gate> keys(
      {
          text("metric",
               "Keys of a number in run.json, joined by dots, e.g. vision.recall; "
               "`stereobench metrics` lists them.")
              .needed()
              .fills(&Gate::metric),
          number("at_most", kLimit, "Largest value that passes.")
              .needed_unless("at_least")
              .by<Gate>(limit(Gate::Relation::kAtMost), written_limit(Gate::Relation::kAtMost)),
          number("at_least", kLimit, "Smallest value that passes.")
              .otherwise_says("at_most")
              .by<Gate>(limit(Gate::Relation::kAtLeast), written_limit(Gate::Relation::kAtLeast)),
      },
      check_gate);
  return keys;
}

}  // namespace stereobench::harness
