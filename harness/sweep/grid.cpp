#include "harness/sweep/grid.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {

Variation parse_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw std::runtime_error(fmt::format("--vary: expected key=a,b,c, got '{}'", text));
  Variation variation{.key = text.substr(0, equals), .values = {}};
  std::istringstream stream(text.substr(equals + 1));
  for (std::string value; std::getline(stream, value, ',');) {
    if (value.empty())
      throw std::runtime_error(fmt::format("--vary {}: an empty value in '{}'", variation.key, text));
    if (std::find(variation.values.begin(), variation.values.end(), value) != variation.values.end())
      throw std::runtime_error(fmt::format("--vary {}: the value {} stands twice", variation.key, value));
    variation.values.push_back(value);
  }
  if (text.back() == ',')
    throw std::runtime_error(fmt::format("--vary {}: an empty value in '{}'", variation.key, text));
  return variation;
}

std::vector<Cell> grid(const std::vector<Variation>& variations) {
  constexpr std::size_t kMaxCells = 10'000;
  std::set<std::string> keys;
  std::vector<Cell> cells = {{}};
  for (const Variation& variation : variations) {
    if (!keys.insert(variation.key).second)
      throw std::runtime_error(
          fmt::format("--vary: {} is varied twice; give all its values at once", variation.key));
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

std::vector<std::string> overrides_of(const std::vector<Variation>& variations, const Cell& cell) {
  std::vector<std::string> overrides;
  for (std::size_t i = 0; i < variations.size(); ++i) overrides.push_back(variations[i].key + "=" + cell[i]);
  return overrides;
}

}  // namespace stereobench::harness
