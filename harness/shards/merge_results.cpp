#include "harness/shards/merge_results.h"

#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "harness/json/cbor.h"
#include "harness/shards/shard_conflict.h"
#include "harness/store/answer_store.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// How many digits of a key name a drive.
constexpr std::size_t kShownDigits = 12;

/// How many numbers of shards a complaint lists.
constexpr std::size_t kShownShards = 20;

void require_same_work(const fs::path& one, const ShardRecord& first, const fs::path& other,
                       const ShardRecord& second) {
  if (first.command != second.command || first.shard.count != second.shard.count ||
      first.version != second.version)
    throw std::runtime_error(fmt::format("{} and {}: are shards of different commands, or of another number",
                                         one.string(), other.string()));
  if (first.plan == second.plan) return;
  const std::string pixels =
      first.pixels == second.pixels
          ? "a file that the command reads, or the program, has changed between them"
          : fmt::format("their machines render different pixels ({} and {}; see `stereobench doctor`)",
                        first.pixels, second.pixels);
  throw ShardConflict(fmt::format("{} and {}: the same command is not the same work: {}", one.string(),
                                  other.string(), pixels));
}

[[noreturn]] void refuse_incomplete(std::vector<std::size_t> numbers, const ShardRecord& record,
                                    const char* what) {
  const std::size_t count = numbers.size();
  if (count > kShownShards) numbers.resize(kShownShards);
  throw std::runtime_error(fmt::format("{} of {} shards {}: {}{}; run them with --shard N/{}", count,
                                       record.shard.count, what, fmt::join(numbers, ", "),
                                       count > kShownShards ? ", ..." : "", record.shard.count));
}

/// A file must have been written to its end, and hold what was written.
void require_whole(const AnswerReader& results) {
  const AnswerIndex& index = results.index();
  const auto refuse = [&](const std::string& what) {
    throw ShardConflict(
        fmt::format("{}: {} since it was written; remove the folder, and run that shard again",
                    results.file().string(), what));
  };
  if (!index.damaged.empty())
    refuse(fmt::format("the result of drive {} has changed", index.damaged.front().substr(0, kShownDigits)));
  if (index.end < index.size)
    refuse(fmt::format("the file has changed behind byte {} of {}", index.end, index.size));
}

nlohmann::json without_time(const std::string& answer) {
  nlohmann::json result = json_of(answer);
  if (result.is_object()) result.erase("timing");
  return result;
}

/// Where two results differ first: "/runs/1/score/failed: true and false". NaN is NaN.
std::string difference_of(const nlohmann::json& one, const nlohmann::json& other) {
  const auto shown = [](const nlohmann::json& json, const nlohmann::json::json_pointer& place) {
    return json.contains(place) ? json.at(place).dump() : std::string("nothing");
  };
  for (const nlohmann::json& step : nlohmann::json::diff(one, other)) {
    const nlohmann::json::json_pointer place(step.at("path").get<std::string>());
    const std::string before = shown(one, place), after = shown(other, place);
    if (before != after)
      return fmt::format("{}: {} and {}", place.to_string(), worlds::excerpt(before), worlds::excerpt(after));
  }
  return "in numbers that are not finite";
}

/// A result, and the file that it is from.
struct Result {
  std::string bytes;
  const fs::path& file;
};

/// @throws ShardConflict where two results are not the same but for the time that they took
void require_same_result(const std::string& key, const Result& one, const Result& other) {
  if (one.bytes == other.bytes) return;
  const nlohmann::json first = without_time(one.bytes), second = without_time(other.bytes);
  if (bytes_of(first) == bytes_of(second)) return;
  throw ShardConflict(fmt::format(
      "{} and {}: have different results of drive {}: {}; one of the machines computes "
      "differently (see `stereobench doctor` there)",
      one.file.string(), other.file.string(), key.substr(0, kShownDigits), difference_of(first, second)));
}

/// The results of a shard. @return none where it had no work
/// @throws ShardConflict where they are gone
std::unique_ptr<AnswerReader> results_of(const fs::path& shard) {
  const fs::path file = shard / kDrivesFile;
  if (fs::exists(file)) return std::make_unique<AnswerReader>(file);
  const ShardRecord record = read_shard_record(shard);
  if (!record.store.empty() && record.drives > 0)
    throw ShardConflict(fmt::format("{}: is gone; run that shard again", file.string()));
  return nullptr;
}

}  // namespace

ShardRecord check_shards(const std::vector<fs::path>& shards) {
  const ShardRecord first = read_shard_record(shards.front());
  std::set<std::size_t> there;
  std::vector<std::size_t> unfinished;
  bool needs_measured = false;
  for (const fs::path& folder : shards) {
    const ShardRecord record = read_shard_record(folder);
    require_same_work(shards.front(), first, folder, record);
    there.insert(record.shard.number);
    needs_measured = needs_measured || record.needs_measured;
    if (!record.is_finished) unfinished.push_back(record.shard.number);
  }
  std::vector<std::size_t> missing;
  for (std::size_t number = needs_measured ? 0 : 1; number <= first.shard.count; ++number)
    if (!there.contains(number)) missing.push_back(number);
  if (!missing.empty()) refuse_incomplete(missing, first, "are missing");
  if (!unfinished.empty()) refuse_incomplete(unfinished, first, "are not finished");
  return first;
}

namespace {

void add_results(const std::vector<fs::path>& shards, const fs::path& file, AnswerStore& merged,
                 const std::function<void(double)>& on_progress) {
  std::map<std::string, fs::path> owners;
  for (std::size_t i = 0; i < shards.size(); ++i) {
    on_progress(static_cast<double>(i) / static_cast<double>(shards.size()));
    const std::unique_ptr<AnswerReader> results = results_of(shards[i]);
    if (!results) continue;
    require_whole(*results);
    for (const auto& [key, place] : results->index().places) {
      const auto owner = owners.try_emplace(key, merged.holds(key) ? file : results->file()).first;
      if (merged.holds(key))
        require_same_result(key, {merged.read(key), owner->second}, {results->read(key), results->file()});
      else
        merged.append_unsynced(key, results->read(key));
    }
  }
  merged.sync();
}

}  // namespace

void merge_results(const std::vector<fs::path>& shards, const fs::path& out,
                   const std::function<void(double)>& on_progress) {
  const fs::path file = out / kDrivesFile;
  AnswerStore merged(file);
  try {
    add_results(shards, file, merged, on_progress);
  } catch (const ShardConflict&) {
    merged.remove();
    throw;
  }
}

}  // namespace stereobench::harness
