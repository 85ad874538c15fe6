#include "harness/dataset/draws_file.h"

#include <nlohmann/json.hpp>

#include "worlds/generate/randomise.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a point.
Json number(double value, bool is_whole) {
  return is_whole ? Json(static_cast<long>(value)) : Json(value);
}

Json line_of(std::uint64_t seed, const worlds::Draw& draw) {
  Json line = {{"seed", seed}, {"key", draw.key}};
  if (draw.names.empty()) {
    line["value"] = number(draw.value, draw.is_whole);
    line["from"] = {number(draw.from.least, draw.is_whole), number(draw.from.most, draw.is_whole)};
  } else {
    line["value"] = draw.names[static_cast<std::size_t>(draw.value)];
    line["from"] = draw.names;
  }
  return line;
}

}  // namespace

std::string draws_jsonl(const worlds::Scenario& scenario, std::span<const std::uint64_t> seeds) {
  std::string lines;
  for (const std::uint64_t seed : seeds) {
    const worlds::SeedWorld made = worlds::seed_world(scenario, seed);
    for (const worlds::Draw& draw : made.draws) lines += line_of(seed, draw).dump() + "\n";
    for (const std::string& key : made.left_out)
      lines += Json{{"seed", seed}, {"key", key}, {"left_out", true}}.dump() + "\n";
  }
  return lines;
}

}  // namespace stereobench::harness
