#include "harness/dataset/truth/truth_request.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stereobench::harness {
namespace {

constexpr std::array<const char*, 7> kNames = {"balls",     "surface", "range", "normal",
                                               "disparity", "match",   "flow"};

constexpr std::array<const char*, 3> kFormatNames = {"exact", "kitti", "tiff"};

TruthKind truth_named(const std::string& name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end())
    throw std::runtime_error(
        fmt::format("--truth: nothing is called '{}'; there are {}, or all", name, fmt::join(kNames, ", ")));
  return static_cast<TruthKind>(found - kNames.begin());
}

}  // namespace

const char* name_of(TruthKind kind) {
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<TruthKind> parse_truth(const std::string& text) {
  std::vector<TruthKind> kinds;
  std::istringstream names(text == "all" ? fmt::format("{}", fmt::join(kNames, ",")) : text + ",");
  for (std::string name; std::getline(names, name, ',');) kinds.push_back(truth_named(name));
  std::sort(kinds.begin(), kinds.end());
  kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
  return kinds;
}

const char* name_of(TruthFormat format) {
  return kFormatNames[static_cast<std::size_t>(format)];
}

TruthFormat parse_truth_format(const std::string& text) {
  const auto found = std::find(kFormatNames.begin(), kFormatNames.end(), text);
  if (found == kFormatNames.end())
    throw std::runtime_error(fmt::format("--truth-format: nothing is called '{}'; there are {}", text,
                                         fmt::join(kFormatNames, ", ")));
  return static_cast<TruthFormat>(found - kFormatNames.begin());
}

const char* float_extension(TruthFormat format) {
  return format == TruthFormat::kTiff ? ".tiff" : ".pfm";
}

}  // namespace stereobench::harness
