#include "harness/verify/readers/scene/picture_pairs.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::array kSideFolders = {"left", "right"};

/// A picture's name without its camera's folder, and the camera.
struct SplitName {
  fs::path rest;
  std::optional<std::size_t> side;
};

SplitName split(const std::string& name) {
  SplitName result;
  for (const fs::path& part : fs::path(name)) {
    const auto* const side = std::ranges::find(kSideFolders, part.string());
    if (!result.side && side != kSideFolders.end())
      result.side = static_cast<std::size_t>(side - kSideFolders.begin());
    else
      result.rest /= part;
  }
  return result;
}

std::string other_half(const std::string& name) {
  fs::path other;
  bool is_replaced = false;
  for (const fs::path& part : fs::path(name)) {
    const auto* const side = std::ranges::find(kSideFolders, part.string());
    if (is_replaced || side == kSideFolders.end()) {
      other /= part;
      continue;
    }
    other /= kSideFolders[side == kSideFolders.begin() ? 1 : 0];
    is_replaced = true;
  }
  return other.string();
}

}  // namespace

std::vector<PicturePair> picture_pairs(const std::vector<std::string>& names) {
  std::map<std::pair<std::string, bool>, PicturePair> pairs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const SplitName name = split(names[i]);
    PicturePair& pair = pairs[{name.rest.string(), name.side.has_value()}];
    pair.name = (name.rest.parent_path() / name.rest.stem()).string();
    auto& place = pair.place[name.side.value_or(0)];
    if (!place) place = i;
  }
  std::vector<PicturePair> list;
  for (auto& [key, pair] : pairs) list.push_back(std::move(pair));
  return list;
}

std::vector<std::pair<std::string, std::string>> missing_halves(const std::vector<PicturePair>& pairs,
                                                                const std::vector<std::string>& names) {
  const auto is_whole = [](const PicturePair& pair) { return pair.place[0] && pair.place[1]; };
  if (2 * std::ranges::count_if(pairs, is_whole) <= static_cast<std::ptrdiff_t>(pairs.size())) return {};
  std::vector<std::pair<std::string, std::string>> missing;
  for (const PicturePair& pair : pairs) {
    if (is_whole(pair)) continue;
    const std::string& there = names[pair.place[0] ? *pair.place[0] : *pair.place[1]];
    if (const std::string other = other_half(there); other != there) missing.emplace_back(other, there);
  }
  return missing;
}

}  // namespace stereobench::harness
