#include "harness/verify/readers/reader_registry.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/verify/readers/plain_reader.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

std::vector<std::string_view> known_formats() {
  std::vector<std::string_view> names;
  for (const DatasetReader& reader : dataset_readers()) names.push_back(reader.format);
  return names;
}

}  // namespace

std::span<const DatasetReader> dataset_readers() {
  static constexpr std::array kReaders = {
      DatasetReader{"plain", looks_plain, read_plain_view,
                    "depth, identities, balls and poses; disparity and flow where they were rendered"},
  };
  return kReaders;
}

const DatasetReader& dataset_reader(std::string_view name) {
  for (const DatasetReader& reader : dataset_readers())
    if (reader.format == name) return reader;
  throw std::runtime_error(fmt::format("--as: no format is called '{}', {}", name,
                                       worlds::advice(std::string(name), known_formats())));
}

const DatasetReader& reader_of(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: no such folder", folder.string()));
  for (const DatasetReader& reader : dataset_readers())
    if (reader.recognises(folder)) return reader;
  throw std::runtime_error(
      fmt::format("{}: expected a data set ({}); where it is one, say which by --as", folder.string(),
                  fmt::join(known_formats(), ", ")));
}

}  // namespace stereobench::harness
