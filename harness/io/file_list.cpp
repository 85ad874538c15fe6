#include "harness/io/file_list.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/sha256.h"
#include "harness/io/text_file.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// Whether a name is a file's place within a folder, in the one form that names it: left_depth/000012.pfm.
bool is_place_within(const std::string& name) {
  const fs::path path(name);
  return path.is_relative() && path.has_filename() && path == path.lexically_normal() &&
         *path.begin() != ".." && *path.begin() != ".";
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

nlohmann::ordered_json file_list(const fs::path& folder, const std::set<std::string>& names) {
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
    if (!is_place_within(name)) value.refuse("the name of a file in the folder");
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
