#include "harness/shards/shard.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostShards = 1'000'000;

/// Variables in which schedulers say which task of an array a process is, from 0.
constexpr std::array kIndexVariables = {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"};

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The number of the shard that a scheduler's variable says.
std::size_t number_of_environment(std::size_t count) {
  const char* variable = nullptr;
  for (const char* name : kIndexVariables) {
    if (std::getenv(name) == nullptr) continue;
    if (variable != nullptr)
      throw std::runtime_error(
          fmt::format("--shard: expected one of {} to be set, not both", fmt::join(kIndexVariables, ", ")));
    variable = name;
  }
  if (variable == nullptr)
    throw std::runtime_error(
        fmt::format("--shard: auto needs one of {} to be set; or say which shard it is, as --shard 1/{}",
                    fmt::join(kIndexVariables, ", "), count));
  const char* const text = std::getenv(variable);
  const auto index = whole_number(text);
  if (!index || *index >= count)
    throw std::runtime_error(fmt::format("--shard: expected {} to be a number from 0 to {} (got '{}')",
                                         variable, count - 1, worlds::excerpt(text)));
  return *index + 1;
}

}  // namespace

std::string Shard::in_words() const {
  return fmt::format("{} of {}", number, count);
}

Shard parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::string_view which = text.substr(0, slash);
  const bool is_auto = which == "auto";
  const auto number = is_auto ? std::optional<std::size_t>(1) : whole_number(which);
  const auto count = slash == std::string_view::npos ? std::nullopt : whole_number(text.substr(slash + 1));
  if (!number || !count || *number > *count || *count < 1 || *count > kMostShards)
    throw std::runtime_error(
        fmt::format("--shard: expected one of several shards, as 1/3, 2/3 or 3/3, or auto/3 (got '{}')",
                    worlds::excerpt(text)));
  return {is_auto ? number_of_environment(*count) : *number, *count};
}

}  // namespace stereobench::harness
