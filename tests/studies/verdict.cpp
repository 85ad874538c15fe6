#include "tests/studies/verdict.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench {
namespace {

using harness::number;

std::string name_of(Verdict verdict) {
  if (verdict == Verdict::kNoLimit) return "";
  return verdict == Verdict::kMet ? "met" : "short";
}

std::string text_of(const Limit& limit) {
  const bool below = std::isfinite(limit.at_most), above = std::isfinite(limit.at_least);
  if (below && limit.at_least == -limit.at_most) return fmt::format("within {}", limit.at_most);
  if (below && above) return fmt::format("{} .. {}", limit.at_least, limit.at_most);
  if (below) return fmt::format("<= {}", limit.at_most);
  return above ? fmt::format(">= {}", limit.at_least) : "";
}

std::string measured_text(const Line& line) {
  if (std::isfinite(line.half_width) && line.half_width > 0.0)
    return harness::format_interval(line.measured, line.half_width);
  if (line.measured == std::round(line.measured)) return fmt::format("{:.0f}", line.measured);  // a count
  return harness::format_number(line.measured);
}

}  // namespace

Verdict verdict_of(const Line& line) {
  if (!std::isfinite(line.limit.at_least) && !std::isfinite(line.limit.at_most)) return Verdict::kNoLimit;
  const bool met = line.measured >= line.limit.at_least && line.measured <= line.limit.at_most;
  return met ? Verdict::kMet : Verdict::kShort;
}

bool all_met(const std::vector<Section>& sections) {
  return std::ranges::all_of(sections, [](const Section& section) {
    return std::ranges::none_of(section.lines,
                                [](const Line& line) { return verdict_of(line) == Verdict::kShort; });
  });
}

std::string tables_of(const std::vector<Section>& sections) {
  std::string text;
  for (const Section& section : sections) {
    harness::AlignedTable table{.header = {section.title, "measured", "limit", "verdict"}, .rows = {}};
    for (const Line& line : section.lines)
      table.rows.push_back({line.what, measured_text(line), text_of(line.limit), name_of(verdict_of(line))});
    text += (text.empty() ? "" : "\n") + harness::plain_text(table);
  }
  return text;
}

nlohmann::ordered_json json_of(const std::vector<Section>& sections) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const Section& section : sections) {
    nlohmann::ordered_json lines = nlohmann::ordered_json::array();
    for (const Line& line : section.lines)
      lines.push_back({{"what", line.what},
                       {"measured", number(line.measured)},
                       {"ci95_half_width", line.half_width > 0.0 ? number(line.half_width) : nullptr},
                       {"at_least", number(line.limit.at_least)},
                       {"at_most", number(line.limit.at_most)},
                       {"verdict", name_of(verdict_of(line))}});
    array.push_back({{"title", section.title}, {"lines", lines}});
  }
  return array;
}

}  // namespace stereobench
