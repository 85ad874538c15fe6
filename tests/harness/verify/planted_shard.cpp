#include "tests/harness/verify/planted_shard.h"

#include <fmt/format.h>

#include "harness/dataset/formats/container/tar_file.h"

namespace stereobench::harness {

Members members_of(const PlantedSet& set) {
  constexpr std::size_t kTarBlock = 512, kSizeAt = 124;
  const std::string bytes = set.text(kShard);
  Members members;
  for (std::size_t at = 0; bytes.at(at) != '\0';) {
    const std::size_t size = std::stoul(bytes.substr(at + kSizeAt, 11), nullptr, 8);
    members.emplace_back(bytes.substr(at).c_str(), bytes.substr(at + kTarBlock, size));
    at += kTarBlock + (size + kTarBlock - 1) / kTarBlock * kTarBlock;
  }
  return members;
}

void write_members(const PlantedSet& set, const Members& members) {
  AtomicFile file(set.path(kShard));
  TarFile tar(file);
  for (const auto& [name, bytes] : members) tar.add(name, bytes);
  tar.finish();
  file.move_into_place();
}

void change_samples(const PlantedSet& set,
                    const std::function<void(nlohmann::ordered_json& sample, std::size_t i)>& change) {
  change_members(set, [&](Members& members) {
    std::size_t i = 0;
    for (auto& [name, bytes] : members) {
      if (!name.ends_with(".json")) continue;
      nlohmann::ordered_json sample = nlohmann::ordered_json::parse(bytes);
      change(sample, i++);
      bytes = sample.dump();
    }
    ASSERT_EQ(i, 6U);
  });
}

}  // namespace stereobench::harness
