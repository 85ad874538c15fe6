#include "harness/cluster/shard_states.h"

#include <array>
#include <filesystem>

#include <fmt/format.h>

#include "harness/collection/collection_record.h"
#include "harness/io/file_list.h"
#include "harness/shards/shard_record.h"

namespace stereobench::harness {
namespace {

ShardState state_of(const std::filesystem::path& folder) {
  const bool is_collection = std::filesystem::exists(folder / kCollectionFile);
  if (is_collection && std::filesystem::exists(folder / kManifest))
    return ShardState::kFinished;  // all of it
  if (!std::filesystem::exists(folder / kShardFile)) return ShardState::kNotBegun;
  if (read_shard_record(folder).is_finished) return ShardState::kFinished;
  return is_under_way(folder) ? ShardState::kRunning : ShardState::kStopped;
}

}  // namespace

std::string_view name_of(ShardState state) {
  constexpr std::array<std::string_view, 4> kNames = {"not begun", "stopped", "running", "finished"};
  return kNames.at(static_cast<std::size_t>(state));
}

std::vector<ShardState> states_of(const ClusterJob& job) {
  std::vector<ShardState> states;
  for (std::size_t number = job.first_shard(); number <= job.shards; ++number)
    states.push_back(state_of(job.shard_folder(number)));
  return states;
}

std::string ranges_of(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += text.empty() ? "" : ",";
    text += last == i ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace stereobench::harness
