#include "harness/regression/result_folder.h"

#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/json_file.h"
#include "harness/vision_scoring/detection_table.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSeeds = 1'000'000;
constexpr double kLargest = std::numeric_limits<double>::max();

fs::path file_of(const fs::path& path) {
  if (!fs::is_directory(path)) return path;
  fs::path file = path / "run.json";
  if (!fs::exists(file))
    throw std::runtime_error(fmt::format(
        "{}: expected a folder with a run.json; run and slam write it last, so theirs did not end here",
        path.string()));
  return file;
}

std::vector<double> values_of(const JsonValue& list, std::size_t seeds) {
  std::vector<double> values;
  for (const JsonValue& value : list.list(seeds, seeds))
    values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                     : value.number(-kLargest, kLargest));
  return values;
}

}  // namespace

SeedTable seed_table_of(const JsonValue& run) {
  SeedTable table;
  for (const JsonValue& seed : run.at("seeds").list(1, kMostSeeds))
    table.seeds.push_back(seed.natural_number());
  table.is_one_log = run.find("log").has_value();
  if (std::set(table.seeds.begin(), table.seeds.end()).size() != table.seeds.size())
    run.at("seeds").refuse("each seed once");
  if (!run.find("per_seed")) run.refuse("\"per_seed\", which older versions did not write: run it again");
  for (const auto& [name, values] : run.at("per_seed").entries())
    table.metrics[name] = values_of(values, table.seeds.size());
  return table;
}

StoredResult read_result(const fs::path& path) {
  const fs::path file = file_of(path);
  return read_json_file(file, [&](const JsonValue& run) {
    run.at("schema").integer(1, 1);
    StoredResult result{.scenario = run.at("scenario").text(), .seeds = seed_table_of(run)};
    const fs::path detections = file.parent_path() / kDetections;
    if (fs::exists(detections)) result.detections = detections;
    return result;
  });
}

}  // namespace stereobench::harness
