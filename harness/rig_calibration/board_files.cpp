#include "harness/rig_calibration/board_files.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/picture_reader.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// A pattern such as "left*": a folder, and what stands before and after the star in a file's name.
struct Pattern {
  fs::path folder;
  std::string before, after;
};

Pattern read_pattern(const fs::path& folder, const std::string& text) {
  const fs::path whole = folder / text;
  const std::string name = whole.filename().string();
  if (std::count(text.begin(), text.end(), '*') != 1 || std::count(name.begin(), name.end(), '*') != 1)
    throw std::runtime_error(fmt::format("'{}': expected a pattern with one * in a file's name", text));
  const std::size_t star = name.find('*');
  return {whole.parent_path(), name.substr(0, star), name.substr(star + 1)};
}

/// The pictures that match, by what the star stands for.
std::map<std::string, fs::path> matches(const Pattern& pattern) {
  std::map<std::string, fs::path> found;
  if (!fs::is_directory(pattern.folder))
    throw std::runtime_error(fmt::format("{}: no such folder", pattern.folder.string()));
  for (const fs::directory_entry& entry : fs::directory_iterator(pattern.folder)) {
    const std::string name = entry.path().filename().string();
    const bool fits = name.size() >= pattern.before.size() + pattern.after.size() &&
                      name.starts_with(pattern.before) && name.ends_with(pattern.after);
    if (!fits || !entry.is_regular_file() || !is_picture_name(entry.path())) continue;
    const std::size_t length = name.size() - pattern.before.size() - pattern.after.size();
    found[name.substr(pattern.before.size(), length)] = entry.path();
  }
  return found;
}

std::array<std::string, 2> usual_patterns(const fs::path& folder) {
  const bool folders = fs::is_directory(folder / "left") && fs::is_directory(folder / "right");
  return folders ? std::array<std::string, 2>{"left/*", "right/*"}
                 : std::array<std::string, 2>{"left*", "right*"};
}

}  // namespace

std::vector<ViewFiles> find_view_files(const fs::path& folder, const std::array<std::string, 2>& patterns) {
  const auto texts = patterns[0].empty() && patterns[1].empty() ? usual_patterns(folder) : patterns;
  const auto left = matches(read_pattern(folder, texts[0]));
  const auto right = matches(read_pattern(folder, texts[1]));
  std::vector<ViewFiles> views;
  for (const auto& [name, file] : left)
    if (const auto other = right.find(name); other != right.end())
      views.push_back({file.stem().string(), file, other->second});
  if (views.empty())
    throw std::runtime_error(fmt::format("{}: no pairs of pictures called {} and {} ({} and {} alone)",
                                         folder.string(), texts[0], texts[1], left.size(), right.size()));
  return views;
}

}  // namespace stereobench::harness
