#include "harness/completion/option_values.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "harness/completion/key_candidates.h"
#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/truth/truth_request.h"
#include "harness/experiment/experiment.h"
#include "harness/experiment/fault_presets.h"
#include "harness/regression/gates.h"
#include "harness/regression/metric_names.h"
#include "harness/verify/readers/reader_registry.h"
#include "renderer/backend.h"
#include "slam/filter_registry.h"

namespace stereobench::harness {
namespace {

/// A word that is a list, "ekf,uf": the last entry of it, and none that stands there already.
std::vector<Candidate> in_list(std::string_view word, std::vector<Candidate> entries) {
  const std::size_t comma = word.rfind(',');
  if (comma == std::string_view::npos) return entries;
  const std::string before = fmt::format(",{}", word.substr(0, comma + 1));
  std::erase_if(entries, [&](const Candidate& entry) {
    return before.find(fmt::format(",{},", entry.text)) != std::string::npos;
  });
  for (Candidate& entry : entries) entry.text = before.substr(1) + entry.text;
  return entries;
}

std::vector<Candidate> filters(std::string_view word) {
  std::vector<Candidate> found;
  for (const slam::FilterKind& kind : slam::filter_kinds())
    found.push_back({std::string(kind.name), std::string(kind.title)});
  return in_list(word, std::move(found));
}

std::vector<Candidate> backends(std::string_view) {
  std::vector<Candidate> found;
  for (const renderer::Backend backend : renderer::kBackends)
    found.push_back({renderer::name_of(backend), ""});
  return found;
}

std::vector<Candidate> formats(std::string_view word) {
  std::vector<Candidate> found;
  for (const DatasetFormat& format : dataset_formats())
    found.push_back({std::string(format.name), std::string(format.holds)});
  return in_list(word, std::move(found));
}

std::vector<Candidate> formats_that_are_read(std::string_view) {
  std::vector<Candidate> found;
  for (const DatasetReader& reader : dataset_readers()) found.push_back({std::string(reader.format), ""});
  return found;
}

std::vector<Candidate> formats_that_are_imported(std::string_view) {
  std::vector<Candidate> found;
  for (const DatasetReader& reader : dataset_readers())
    if (reader.not_imported.empty()) found.push_back({std::string(reader.format), ""});
  return found;
}

std::vector<Candidate> truth(std::string_view word) {
  std::vector<Candidate> found;
  for (const TruthKind kind : parse_truth("all")) found.push_back({name_of(kind), ""});
  if (word.find(',') == std::string_view::npos) found.push_back({"all", ""});
  return in_list(word, std::move(found));
}

std::vector<Candidate> identities(std::string_view) {
  std::vector<Candidate> found;
  for (const std::string_view name : declared_key(experiment_keys(), "identity")->names)
    found.push_back({std::string(name), ""});
  return found;
}

std::vector<Candidate> faults(std::string_view) {
  std::vector<Candidate> found;
  for (const FaultPreset& fault : fault_presets())
    found.push_back({std::string(fault.name), std::string(fault.says)});
  return found;
}

std::vector<Candidate> scenario_keys(std::string_view word) {
  return key_candidates(experiment_keys(), word);
}

std::vector<Candidate> faults_with_severities(std::string_view word) {
  return key_candidates(fault_keys(), word);
}

/// Lines that vary together are joined by ':', "path.step_s:rig.width_px=".
std::vector<Candidate> varied_keys(std::string_view word) {
  const std::size_t colon = word.substr(0, word.find('=')).rfind(':');
  const std::string before(colon == std::string_view::npos ? "" : word.substr(0, colon + 1));
  std::vector<Candidate> found = scenario_keys(word.substr(before.size()));
  for (Candidate& one : found) {
    one.text = before + one.text;
    one.is_whole = false;  // more values may follow
  }
  return found;
}

/// Numbers of a run of all filters, one part of the path at a time.
std::vector<Candidate> metrics(std::string_view word) {
  static const std::vector<std::string> paths = [] {
    Experiment all;
    all.filters = slam::filter_names();
    return metric_names(result_without_values(all));
  }();
  std::vector<Candidate> found;
  for (const std::string& path : paths) {
    if (!path.starts_with(word)) continue;
    const std::size_t dot = path.find('.', word.size());
    const std::string text = dot == std::string::npos ? path : path.substr(0, dot + 1);
    if (found.empty() || found.back().text != text) found.push_back({text, "", dot == std::string::npos});
  }
  return found;
}

/// The same, where a limit or a change follows.
std::vector<Candidate> metrics_with_more(std::string_view word) {
  std::vector<Candidate> found = metrics(word);
  for (Candidate& one : found) one.is_whole = false;
  return found;
}

/// The words that a validator of CLI11 lists: "TEXT:{auto,linear,srgb}".
std::vector<Candidate> checked_words(const std::string& type_name) {
  std::vector<Candidate> found;
  const std::size_t end = type_name.find('}');
  std::size_t begin = type_name.find('{');
  if (begin == std::string::npos || end == std::string::npos) return {};
  while (begin < end) {
    const std::size_t next = std::min(type_name.find(',', begin + 1), end);
    found.push_back({type_name.substr(begin + 1, next - begin - 1), ""});
    begin = next;
  }
  return found;
}

}  // namespace

std::vector<ValueSource> value_sources() {
  return {{"", "--filters", filters},
          {"", "--backend", backends},
          {"", "--set", scenario_keys},
          {"", "--faults", faults_with_severities},
          {"", "--vary", varied_keys},
          {"", "--metric", metrics},
          {"", "--gate", metrics_with_more},
          {"", "--format", formats},
          {"export", "--as", formats},
          {"verify", "--as", formats_that_are_read},
          {"preview", "--as", formats_that_are_read},
          {"import", "--as", formats_that_are_imported},
          {"render", "--truth", truth},
          {"slam", "--identity", identities},
          {"compare", "--only", metrics},
          {"history", "--only", metrics},
          {"compare", "--margin", metrics_with_more},
          {"history", "--margin", metrics_with_more},
          {"metrics", "part", metrics},
          {"faults", "part", faults}};
}

std::vector<Candidate> values_of(const CLI::App& command, const CLI::Option& option, std::string_view word) {
  for (const ValueSource& source : value_sources()) {
    if (!source.command.empty() && source.command != command.get_name()) continue;
    if (option.check_name(std::string(source.option))) return that_begin_with(word, source.find(word));
  }
  return that_begin_with(word, checked_words(option.get_type_name()));
}

}  // namespace stereobench::harness
