#include "harness/io/file_list.h"

#include <algorithm>
#include <array>
#include <regex>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "harness/io/json_line.h"
#include "harness/io/sha256.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 11> kTextFiles = {
    "balls.csv",       "calibration.yaml", "draws.jsonl",          "frames.csv",
    "groundtruth.csv", "instants.csv",     "landmarks.csv",        "observations.csv",
    "odometry.csv",    "surfaces.csv",     "true_calibration.yaml"};

/// Whether a place in the folder is one where `render` writes: left_depth/000012.pfm.
bool is_product(const std::string& name) {
  static const std::regex frame(R"((left|right)(_[a-z]+)*/[0-9]+\.(png|pfm|jsonl))");
  return std::ranges::find(kTextFiles, name) != kTextFiles.end() || std::regex_match(name, frame);
}

bool is_as_listed(const fs::path& file, const JsonValue& listed) {
  constexpr std::int64_t kMost = std::int64_t{1} << 50U;
  listed.allow({"bytes", "sha256"});
  const auto bytes = static_cast<std::uintmax_t>(listed.at("bytes").integer(0, kMost));
  const std::string hash = listed.at("sha256").text();
  std::error_code error;
  return fs::is_regular_file(file, error) && fs::file_size(file, error) == bytes &&
         sha256_of_file(file) == hash;
}

}  // namespace

std::vector<std::string> product_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (entry.is_regular_file() && is_product(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

nlohmann::ordered_json file_list(const fs::path& folder, const std::vector<std::string>& names) {
  nlohmann::ordered_json list = nlohmann::ordered_json::object();
  for (const std::string& name : names)
    list[name] = {{"bytes", fs::file_size(folder / name)}, {"sha256", sha256_of_file(folder / name)}};
  return list;
}

std::vector<std::string> changed_files(const fs::path& folder, const nlohmann::json& list) {
  if (!list.is_object()) JsonValue(list, kFiles).refuse("an object");
  std::vector<std::string> changed;
  for (const auto& [name, listed] : list.items()) {
    const JsonValue value(listed, fmt::format("{}.{}", kFiles, excerpt(name)));
    if (!is_product(name)) value.refuse("the name of a file that `render` writes");
    if (!is_as_listed(folder / name, value)) changed.push_back(name);
  }
  return changed;
}

void require_as_rendered(const fs::path& folder) {
  const fs::path marker = folder / kFinishedDataset;
  if (!fs::exists(marker)) return;
  try {
    const nlohmann::json json = parse_line(read_text(marker));
    const auto list = json.find(kFiles);
    if (list == json.end()) return;
    nlohmann::json texts = nlohmann::json::object();
    for (const auto& [name, listed] : list->items())
      if (name.find('/') == std::string::npos) texts[name] = listed;
    const std::vector<std::string> changed = changed_files(folder, texts);
    if (changed.empty()) return;
    throw std::runtime_error(fmt::format(
        "{}: is not as it was rendered; run the same `render` again, which restores it, or remove {} "
        "to use it as it is",
        (folder / changed.front()).string(), marker.string()));
  } catch (const BadLine& error) {
    throw std::runtime_error(fmt::format("{}: {}", marker.string(), error.what()));
  }
}

}  // namespace stereobench::harness
