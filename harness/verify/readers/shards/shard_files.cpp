#include "harness/verify/readers/shards/shard_files.h"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "harness/verify/readers/reader_tools.h"

namespace stereobench::harness {
namespace {

constexpr const char* kTar = ".tar";

/// Names "DRIVE-000007" whose numbers leave one out.
void find_missing_shards(DatasetView& view, const std::set<std::string>& shards) {
  std::string before;
  int number_before = -1;
  for (const std::string& shard : shards) {
    const std::size_t dash = shard.rfind('-');
    if (dash == std::string::npos) continue;
    const std::string stem = shard.substr(0, dash), digits = shard.substr(dash + 1);
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size()) continue;
    if (stem != before) before = stem, number_before = -1;
    const auto name = [&](int of) { return fmt::format("{}-{:0{}}{}", stem, of, digits.size(), kTar); };
    if (number - number_before > 2)
      view.faults.push_back({name(number_before + 1), "",
                             fmt::format("missing files: those up to {} as well, and there is {}{}",
                                         name(number - 1), shard, kTar)});
    else if (number - number_before == 2)
      view.faults.push_back({name(number - 1), "", fmt::format("missing file: there is {}{}", shard, kTar)});
    number_before = number;
  }
}

/// A member's name, parted at the first point behind its folders.
std::pair<std::string, std::string> key_and_kind(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  const std::size_t point = name.find('.', slash == std::string::npos ? 0 : slash);
  if (point == std::string::npos) return {name, ""};
  return {name.substr(0, point), name.substr(point + 1)};
}

void add_shard(DatasetView& view, const std::string& shard, std::vector<ShardFiles>& samples) {
  TarListing listing;
  read_or_blame(view, shard, [&] { listing = list_tar(view.folder / shard); });
  if (!listing.broken.empty()) view.faults.push_back({shard, "", listing.broken});
  for (TarMember& member : listing.members) {
    const auto [key, kind] = key_and_kind(member.name);
    if (samples.empty() || samples.back().shard != shard || samples.back().key != key)
      samples.push_back({shard, key, {}});
    const std::string name = member.name;
    if (!samples.back().members.emplace(kind, std::move(member)).second)
      view.faults.push_back({shard + "/" + name, key, "the archive has a member of this name twice"});
  }
}

/// Kinds of members that more than half of the samples have.
std::set<std::string> usual_kinds(const std::vector<ShardFiles>& samples) {
  std::map<std::string, std::size_t> counts;
  for (const ShardFiles& sample : samples)
    for (const auto& [kind, member] : sample.members) ++counts[kind];
  std::set<std::string> usual;
  for (const auto& [kind, count] : counts)
    if (2 * count > samples.size()) usual.insert(kind);
  return usual;
}

}  // namespace

std::vector<ShardFiles> shard_files(DatasetView& view) {
  const std::set<std::string> shards = stems_in(view.folder, kTar);
  find_missing_shards(view, shards);
  std::vector<ShardFiles> samples;
  for (const std::string& shard : shards) add_shard(view, shard + kTar, samples);
  std::map<std::string, std::string> known;
  const std::set<std::string> usual = usual_kinds(samples);
  for (const ShardFiles& sample : samples) {
    const auto [first, is_new] = known.emplace(sample.key, sample.shard);
    if (!is_new)
      view.faults.push_back({sample.shard, sample.key,
                             fmt::format("members of this sample are also in {}, and not beside these: "
                                         "loaders take them for two samples",
                                         first->second)});
    for (const std::string& kind : usual)
      if (!sample.members.contains(kind))
        view.faults.push_back({sample.place(kind), sample.key,
                               "missing member: other samples have one, and this one has others"});
  }
  return samples;
}

}  // namespace stereobench::harness
