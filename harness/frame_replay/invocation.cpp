#include "harness/frame_replay/invocation.h"

#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "harness/experiment/write_experiment.h"
#include "harness/io/json_file.h"
#include "harness/io/sha256.h"
#include "renderer/backend.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOverrides = 10'000;

/// What a run's scenario was, as run.json has it.
struct ScenarioHashes {
  std::string scenario;
  std::map<std::string, std::string> files;
};

Invocation invocation_of(const JsonValue& value) {
  value.allow({"scenario", "folder", "overrides", "backend"});
  Invocation invocation{.scenario = value.at("scenario").text(), .folder = value.at("folder").text()};
  for (const JsonValue& entry : value.at("overrides").list(0, kMostOverrides))
    invocation.overrides.push_back(entry.text());
  try {
    invocation.backend = renderer::backend_named(value.at("backend").text());
  } catch (const std::runtime_error&) {
    value.at("backend").refuse("the name of a back end");
  }
  return invocation;
}

ScenarioHashes hashes_in(const JsonValue& run) {
  const JsonValue made_from = run.at("made_from");
  ScenarioHashes hashes{.scenario = made_from.at("scenario_sha256").text()};
  for (const auto& [name, hash] : made_from.at("files_sha256").entries()) hashes.files[name] = hash.text();
  return hashes;
}

void check_unchanged(const fs::path& result, const Invocation& invocation, const ScenarioHashes& hashes) {
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{}: {} is not as it was when this result was made: run it again",
                                         result.string(), what));
  };
  if (sha256_of(with_overrides(invocation.scenario, invocation.overrides)) != hashes.scenario)
    refuse(fmt::format("the scenario {}", invocation.scenario.string()));
  const auto now = hashes_of_named_files(invocation.scenario, invocation.overrides);
  for (const auto& [name, hash] : hashes.files) {
    const auto found = now.find(name);
    if (found == now.end() || found->second != hash)
      refuse(fmt::format("the file {} of {}", name, invocation.scenario.string()));
  }
}

fs::path folder_of(const fs::path& result) {
  return fs::is_directory(result) ? result : result.parent_path();
}

/// Which folders in this one have a result, e.g. those of a suite's cases: "; in it have one: noisy, plain".
std::string runs_within(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (fs::exists(entry.path() / "run.json")) names.insert(entry.path().filename().string());
  if (names.empty()) return "";
  constexpr std::size_t kMostNamed = 10;
  while (names.size() > kMostNamed) names.erase(std::prev(names.end()));
  return fmt::format("; in it have one: {}", fmt::join(names, ", "));
}

}  // namespace

std::string invocation_text(const Invocation& invocation) {
  using Json = nlohmann::ordered_json;
  const Json json = {{"scenario", invocation.scenario.string()},
                     {"folder", invocation.folder.string()},
                     {"overrides", invocation.overrides},
                     {"backend", renderer::name_of(invocation.backend)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string replayable_folder(const fs::path& result) {
  const fs::path folder = folder_of(result);
  return fs::exists(folder / kInvocation) ? folder.string() : "";
}

Invocation read_invocation(const fs::path& result, const fs::path& scenario) {
  const fs::path folder = folder_of(result);
  const fs::path run = folder / "run.json", file = folder / kInvocation;
  if (!fs::exists(run))
    throw std::runtime_error(fmt::format("{}: expected a folder with a run.json, which `run` writes last{}",
                                         result.string(), runs_within(folder)));
  if (!fs::exists(file))
    throw std::runtime_error(
        fmt::format("{}: has no {}, which `run` alone writes, and older versions did not: run it again",
                    result.string(), kInvocation));
  Invocation invocation = read_json_file(file, invocation_of);
  if (!scenario.empty()) invocation.scenario = fs::absolute(scenario);
  if (!fs::exists(invocation.scenario))
    throw std::runtime_error(fmt::format("{}: the scenario {} is not there: --scenario says where it is now",
                                         result.string(), invocation.scenario.string()));
  check_unchanged(result, invocation, read_json_file(run, hashes_in));
  return invocation;
}

}  // namespace stereobench::harness
