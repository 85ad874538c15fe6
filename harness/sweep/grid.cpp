#include "harness/sweep/grid.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stereobench::harness {

namespace {

/// The parts of a text between separators; "a,," has three, the last two of them empty. Lists and groups are
/// not taken apart: "[1,2],[3,4]" has two.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts = {""};
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == separator && depth == 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The parts of one value, one for each key. A single key takes its value whole, colons and all.
std::vector<std::string> parts_of(const Variation& variation, const std::string& value) {
  if (variation.keys.size() == 1) return {value};
  return split(value, ':');
}

}  // namespace

std::string Variation::name() const {
  return fmt::format("{}", fmt::join(keys, ":"));
}

Variation parse_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw std::runtime_error(fmt::format("--vary: expected key=a,b,c, got '{}'", text));
  Variation variation{.keys = split(text.substr(0, equals), ':'), .values = {}};
  for (const std::string& key : variation.keys)
    if (key.empty()) throw std::runtime_error(fmt::format("--vary: an empty key in '{}'", text));
  for (const std::string& value : split(text.substr(equals + 1), ',')) {
    const std::vector<std::string> parts = parts_of(variation, value);
    if (std::find(parts.begin(), parts.end(), "") != parts.end())
      throw std::runtime_error(fmt::format("--vary {}: an empty value in '{}'", variation.name(), text));
    if (parts.size() != variation.keys.size())
      throw std::runtime_error(fmt::format("--vary {}: expected {} parts between colons, got '{}'",
                                           variation.name(), variation.keys.size(), value));
    if (std::find(variation.values.begin(), variation.values.end(), value) != variation.values.end())
      throw std::runtime_error(fmt::format("--vary {}: the value {} stands twice", variation.name(), value));
    variation.values.push_back(value);
  }
  return variation;
}

std::vector<Cell> grid(const std::vector<Variation>& variations) {
  constexpr std::size_t kMaxCells = 10'000;
  std::set<std::string> keys;
  std::vector<Cell> cells = {{}};
  for (const Variation& variation : variations) {
    for (const std::string& key : variation.keys)
      if (!keys.insert(key).second)
        throw std::runtime_error(fmt::format("--vary: {} is varied twice; give all its values at once", key));
    if (cells.size() * variation.values.size() > kMaxCells)
      throw std::runtime_error(fmt::format("--vary: more than {} cells", kMaxCells));
    std::vector<Cell> longer;
    for (const Cell& cell : cells)
      for (const std::string& value : variation.values) {
        longer.push_back(cell);
        longer.back().push_back(value);
      }
    cells = std::move(longer);
  }
  return cells;
}

std::vector<Setting> settings_of(const std::vector<Variation>& variations, const Cell& cell) {
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < variations.size(); ++i) {
    const std::vector<std::string> parts = parts_of(variations[i], cell[i]);
    for (std::size_t k = 0; k < parts.size(); ++k) settings.push_back({variations[i].keys[k], parts[k]});
  }
  return settings;
}

std::string name_of(const std::vector<Variation>& variations, const Cell& cell) {
  std::vector<std::string> parts;
  for (const Setting& setting : settings_of(variations, cell))
    parts.push_back(fmt::format("{} = {}", setting.key, setting.value));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::string> overrides_of(const std::vector<Variation>& variations, const Cell& cell) {
  std::vector<std::string> overrides;
  for (const Setting& setting : settings_of(variations, cell))
    overrides.push_back(setting.key + "=" + setting.value);
  return overrides;
}

}  // namespace stereobench::harness
