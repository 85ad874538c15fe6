#include "harness/io/file_list.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/sha256.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kGap = "  ";  ///< between hash and name, as sha256sum has it

/// Whether a name is a file's place within a folder, in the one form that names it: left_depth/000012.pfm.
bool is_place_within(const std::string& name) {
  const fs::path path(name);
  return path.is_relative() && path.has_filename() && path == path.lexically_normal() &&
         *path.begin() != ".." && *path.begin() != ".";
}

bool is_hash(std::string_view text) {
  return text.size() == kSha256Digits &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

bool is_as_listed(const fs::path& file, const std::string& hash) {
  std::error_code error;
  return fs::is_regular_file(file, error) && sha256_of_file(file) == hash;
}

}  // namespace

void hash_others(const fs::path& folder, FileHashes& files) {
  for (auto& [name, hash] : files)
    if (hash.empty()) hash = sha256_of_file(folder / name);
}

std::string manifest_text(const FileHashes& files) {
  std::string text;
  for (const auto& [name, hash] : files) text += fmt::format("{}{}{}\n", hash, kGap, name);
  return text;
}

FileHashes read_manifest(const fs::path& folder) {
  const fs::path manifest = folder / kManifest;
  std::istringstream lines(read_text(manifest));
  FileHashes files;
  long number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto refuse = [&](const char* expected) {
      throw std::runtime_error(fmt::format("{}:{}: expected {}", manifest.string(), number, expected));
    };
    const std::string hash = line.substr(0, kSha256Digits);
    if (!is_hash(hash) || line.compare(kSha256Digits, kGap.size(), kGap) != 0)
      refuse("a SHA-256, two spaces and the name of a file");
    const std::string name = line.substr(kSha256Digits + kGap.size());
    if (!is_place_within(name)) refuse("the name of a file in the folder");
    if (!files.emplace(name, hash).second) refuse("each file once");
  }
  return files;
}

std::vector<std::string> changed_files(const fs::path& folder, const FileHashes& files) {
  std::vector<std::string> changed;
  for (const auto& [name, hash] : files)
    if (!is_as_listed(folder / name, hash)) changed.push_back(name);
  return changed;
}

void require_as_rendered(const fs::path& folder) {
  if (!fs::exists(folder / kManifest)) return;
  FileHashes tables = read_manifest(folder);
  std::erase_if(tables, [](const auto& file) { return file.first.find('/') != std::string::npos; });
  const std::vector<std::string> changed = changed_files(folder, tables);
  if (changed.empty()) return;
  throw std::runtime_error(
      fmt::format("{}: is not as it was rendered; run the same `render` again, which restores it, or remove "
                  "{} to use it as it is",
                  (folder / changed.front()).string(), (folder / kManifest).string()));
}

}  // namespace stereobench::harness
