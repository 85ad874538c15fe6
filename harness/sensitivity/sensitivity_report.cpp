#include "harness/sensitivity/sensitivity_report.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench::harness {
namespace {

/// Shares to three decimals; "-" where there is none, and 0 without a sign.
std::string share_text(double share) {
  if (!std::isfinite(share)) return "-";
  const std::string text = fmt::format("{:.3f}", share);
  return text == "-0.000" ? "0.000" : text;
}

std::string interval_text(const Interval& interval) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return "-";
  return fmt::format("{} to {}", share_text(interval.low), share_text(interval.high));
}

std::string with_interval_text(const IndexEstimate& index) {
  return fmt::format("{} ({})", share_text(index.value), interval_text(index.interval));
}

/// How much of the variance is chance, where one stream stands for all of it.
std::vector<std::string> remark_on_chance(const Sensitivity& study) {
  if (study.factors.streams.size() != 1 || study.factors.keys.empty()) return {};
  const IndexEstimate& total = study.indices.factors.back().total;
  return {fmt::format("Chance: where every key is known, {} of the variance is left: the total index of {}.",
                      with_interval_text(total), study.factors.streams.front())};
}

std::vector<std::string> remarks_on_interactions(const Sensitivity& study) {
  std::vector<std::string> remarks;
  for (const std::size_t factor : order_by_total(study.indices)) {
    const IndexEstimate& interactions = study.indices.factors[factor].interactions;
    if (interactions.interval.low > 0.0)
      remarks.push_back(fmt::format("{} acts together with other factors: total less first is {}.",
                                    study.factors.name(factor), with_interval_text(interactions)));
  }
  return remarks;
}

/// Of the factors whose first index cannot be told from 0. What is exactly 0 has no error.
std::vector<std::string> remark_on_zeros(const Sensitivity& study) {
  std::vector<std::string> names;
  for (const std::size_t factor : order_by_total(study.indices)) {
    const FactorIndices& indices = study.indices.factors[factor];
    if (indices.first.interval.low <= 0.0 && indices.total.value > 0.0)
      names.push_back(study.factors.name(factor));
  }
  if (names.empty()) return {};
  return {
      fmt::format("First index not told from 0: {}. A number below 0 is a sampling error. --samples {} would "
                  "halve the intervals.",
                  fmt::join(names, ", "), 4 * study.settings.samples)};
}

std::vector<std::string> remark_on_failures(const SobolIndices& indices) {
  if (indices.failed_runs == 0) return {};
  return {fmt::format(
      "{} runs gave no value. The {} rows of {} with one of them are left out: the indices are of "
      "the rest, in which all runs ended well.",
      indices.failed_runs, indices.rows_left_out, indices.rows + indices.rows_left_out)};
}

nlohmann::ordered_json index_json(const IndexEstimate& index) {
  return {{"value", number(index.value)},
          {"low", number(index.interval.low)},
          {"high", number(index.interval.high)}};
}

nlohmann::ordered_json factor_json(const Factors& factors, std::size_t factor) {
  if (factor >= factors.keys.size()) return {{"stream", factors.name(factor)}};
  const KeyRange& range = factors.keys[factor];
  nlohmann::ordered_json json = {{"key", range.key}, {"low", range.low}, {"high", range.high}};
  if (range.spacing == Spacing::kLogarithmic) json["spacing"] = "log";
  if (range.spacing == Spacing::kWhole) json["spacing"] = "whole";
  return json;
}

}  // namespace

std::string sensitivity_table(const Sensitivity& study) {
  const std::string interval = fmt::format("{:g} % interval", 100.0 * study.settings.level);
  AlignedTable table{.header = {"factor", "values", "first", interval, "total", interval}, .rows = {}};
  for (const std::size_t factor : order_by_total(study.indices)) {
    const FactorIndices& indices = study.indices.factors[factor];
    table.rows.push_back({study.factors.name(factor), study.factors.values(factor),
                          share_text(indices.first.value), interval_text(indices.first.interval),
                          share_text(indices.total.value), interval_text(indices.total.interval)});
  }
  return plain_text(table);
}

std::vector<std::string> sensitivity_remarks(const Sensitivity& study) {
  std::vector<std::string> remarks = {
      "first: the share of the variance that is gone where this factor is known. total: the share that is "
      "left "
      "where all others are known."};
  const auto add = [&](const std::vector<std::string>& more) {
    remarks.insert(remarks.end(), more.begin(), more.end());
  };
  if (study.indices.sd > 0.0) {
    add(remark_on_chance(study));
    add(remarks_on_interactions(study));
    add(remark_on_zeros(study));
  } else {
    add({std::isfinite(study.indices.sd)
             ? "The metric is the same in all runs: there is no variance to share."
             : "Too few rows are left: 10 are needed."});
  }
  add(remark_on_failures(study.indices));
  return remarks;
}

std::string sensitivity_text(const Sensitivity& study) {
  std::string text = fmt::format("{} of {}: mean {}, sd {}, over {} runs\n\n", study.metric, study.scenario,
                                 format_number(study.indices.mean), format_number(study.indices.sd),
                                 count_of_points(study.factors, study.settings.samples));
  text += sensitivity_table(study);
  for (const std::string& remark : sensitivity_remarks(study)) text += remark + "\n";
  return text;
}

nlohmann::ordered_json sensitivity_json(const Sensitivity& study) {
  nlohmann::ordered_json factors = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < study.factors.size(); ++i) {
    nlohmann::ordered_json factor = factor_json(study.factors, i);
    const FactorIndices& indices = study.indices.factors[i];
    factor["first"] = index_json(indices.first);
    factor["total"] = index_json(indices.total);
    factor["interactions"] = index_json(indices.interactions);
    factors.push_back(std::move(factor));
  }
  return {{"schema", 1},
          {"scenario", study.scenario},
          {"metric", study.metric},
          {"samples", study.settings.samples},
          {"seed", study.settings.seed},
          {"interval", study.settings.level},
          {"runs", count_of_points(study.factors, study.settings.samples)},
          {"failed_runs", study.indices.failed_runs},
          {"rows", study.indices.rows},
          {"rows_left_out", study.indices.rows_left_out},
          {"mean", number(study.indices.mean)},
          {"sd", number(study.indices.sd)},
          {"factors", std::move(factors)}};
}

}  // namespace stereobench::harness
