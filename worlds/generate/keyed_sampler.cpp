#include "worlds/generate/keyed_sampler.h"

#include <algorithm>

#include "slam/math/random.h"

namespace stereobench::worlds {
namespace {

/// A name as 64 bits (Fowler, Noll and Vo's FNV-1a).
std::uint64_t number_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  return hash;
}

}  // namespace

double KeyedSampler::uniform(std::string_view key, std::uint64_t attempt) const {
  return slam::RandomStream(seed_, slam::Stream::kRandomise, number_of(key) + attempt).uniform();
}

double KeyedSampler::number(const std::string& key, const Range& from, std::uint64_t attempt) {
  const double value = from.least + (from.most - from.least) * uniform(key, attempt);
  log_.push_back({.key = key, .value = std::min(value, from.most), .from = from});
  return log_.back().value;
}

int KeyedSampler::whole(const std::string& key, int least, int most, std::uint64_t attempt) {
  const int count = most - least + 1;
  const int value = least + std::min(static_cast<int>(count * uniform(key, attempt)), count - 1);
  log_.push_back({.key = key,
                  .value = static_cast<double>(value),
                  .from = {static_cast<double>(least), static_cast<double>(most)},
                  .is_whole = true});
  return value;
}

std::size_t KeyedSampler::choice(const std::string& key, std::span<const std::string_view> names) {
  const int index = whole(key, 0, static_cast<int>(names.size()) - 1);
  log_.back().names.assign(names.begin(), names.end());
  return static_cast<std::size_t>(index);
}

}  // namespace stereobench::worlds
