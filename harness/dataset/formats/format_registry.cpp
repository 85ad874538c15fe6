#include "harness/dataset/formats/format_registry.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/dataset/formats/kitti_format.h"
#include "harness/dataset/formats/stereobench_format.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

/// One row a format: name, what it holds, what it refuses, how it starts.
constexpr auto kFormats = std::to_array<DatasetFormat>({
    {"stereobench", "ids, depth, calibration and truth", check_stereobench_format, stereobench_writer},
    {"kitti", "disparity and calibration as in KITTI stereo 2015", check_kitti_format, kitti_writer},
});

}  // namespace

std::span<const DatasetFormat> dataset_formats() {
  return kFormats;
}

const DatasetFormat& dataset_format(std::string_view name) {
  const auto* const found = std::ranges::find(kFormats, name, &DatasetFormat::name);
  if (found != kFormats.end()) return *found;
  std::vector<std::string_view> names;
  for (const DatasetFormat& format : kFormats) names.push_back(format.name);
  const auto meant = worlds::nearest_word(name, names);
  throw std::runtime_error(fmt::format("--format: no format is called '{}'{}; there are {}", name,
                                       meant ? fmt::format(", did you mean {}?", *meant) : "",
                                       fmt::join(names, ", ")));
}

}  // namespace stereobench::harness
