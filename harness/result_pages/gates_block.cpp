#include "harness/result_pages/gates_block.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/result_pages/filter_blocks.h"

namespace stereobench::harness {

Block gates_block(std::span<const Gate> gates, const nlohmann::ordered_json& json) {
  PageTable table{.header = {"gate", "verdict", "value", "limit", "room"}, .quiet = "gates that hold"};
  for (const Gate& gate : gates) {
    const std::optional<double> value = limited_value(json, gate);
    const bool at_most = gate.relation == Gate::Relation::kAtMost;
    const double room = !value ? std::nan("") : at_most ? gate.limit - *value : *value - gate.limit;
    const bool holds = value && room >= 0.0;
    const PageCell verdict{.text = holds ? "HOLDS" : "BROKEN",
                           .number = holds ? 1.0 : 0.0,
                           .mark = holds ? CellMark::kGood : CellMark::kBad};
    const PageCell limit{
        .text = fmt::format("{} {}", at_most ? "at most" : "at least", format_number(gate.limit)),
        .number = gate.limit};
    table.rows.push_back({{{.text = gate.metric},
                           verdict,
                           number_cell(value.value_or(std::nan(""))),
                           limit,
                           number_cell(room)},
                          holds});
  }
  std::ranges::stable_sort(table.rows, {}, [](const PageRow& row) { return row.cells[1].number; });
  const auto broken = std::ranges::count_if(
      table.rows, [](const PageRow& row) { return row.cells[1].mark == CellMark::kBad; });
  Block block{.title = "Gates",
              .note = broken == 0 ? fmt::format("All {} gates hold.", gates.size())
                                  : fmt::format("{} of {} gates are broken.", broken, gates.size())};
  if (gates.empty()) {
    block.note = "";
    block.content = PageText{{"No gate limits this result."}};
  } else {
    block.content = std::move(table);
  }
  return block;
}

}  // namespace stereobench::harness
