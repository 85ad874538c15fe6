#include "harness/suite/baseline.h"

#include "harness/io/json_file.h"
#include "harness/json/json_text.h"
#include "harness/regression/result_folder.h"
#include "harness/run/seed_metrics.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

std::string text_or_empty(const JsonValue& value) {
  return value.is_null() ? "" : value.text();
}

Baseline baseline_of(const JsonValue& top) {
  top.allow({"schema", "scenario", "blessed", "inputs", "seeds", "per_seed"});
  top.at("schema").integer(1, 1);
  const JsonValue blessed = top.at("blessed"), inputs = top.at("inputs");
  Baseline baseline{.scenario = top.at("scenario").text(),
                    .inputs = {inputs.at("sha256").text(), text_or_empty(inputs.at("pixels")),
                               inputs.at("detector").text()},
                    .blessing = {blessed.at("reason").text(), blessed.at("stereobench").text(),
                                 text_or_empty(blessed.at("instead_of"))},
                    .seeds = seed_table_of(top)};
  return baseline;
}

}  // namespace

fs::path baseline_file(const fs::path& folder, const std::string& name) {
  return folder / (name + ".json");
}

fs::path findings_file(const fs::path& folder, const std::string& name) {
  return folder / (name + ".balls.csv");
}

std::string baseline_text(const Baseline& baseline) {
  return json_text({{"schema", 1},
                    {"scenario", baseline.scenario},
                    {"blessed",
                     {{"reason", baseline.blessing.reason},
                      {"stereobench", baseline.blessing.version},
                      {"instead_of", text_or_null(baseline.blessing.instead_of)}}},
                    {"inputs",
                     {{"sha256", baseline.inputs.sha256},
                      {"pixels", text_or_null(baseline.inputs.pixels)},
                      {"detector", baseline.inputs.detector}}},
                    {"seeds", baseline.seeds.seeds},
                    {"per_seed", seed_metrics_json(baseline.seeds.metrics)}});
}

std::optional<Baseline> read_baseline(const fs::path& file) {
  if (!fs::exists(file)) return {};
  return read_json_file(file, baseline_of);
}

}  // namespace stereobench::harness
