#include "harness/io/file_list.h"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/sha256.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kGap = "  ";  ///< between hash and name, as sha256sum has it

/// A name as BagIt writes it: line ends and % are %0A, %0D, %25.
std::string bag_name(std::string name) {
  for (const auto& [code, letter] : {std::pair("%0A", "\n"), std::pair("%0D", "\r"), std::pair("%25", "%")})
    for (std::size_t at = name.find(code); at != std::string::npos; at = name.find(code, at + 1))
      name.replace(at, 3, letter);
  return name;
}

bool is_within(const fs::path& place) {
  return place.is_relative() && place.has_filename() && *place.begin() != ".." && *place.begin() != ".";
}

/// 64 hexadecimal digits, blanks and perhaps an asterisk, and a name.
ListedFile listed_file(const fs::path& folder, const std::string& text, long line) {
  ListedFile file = {.line = line, .name = {}, .hash = text.substr(0, kSha256Digits), .expected = {}};
  const std::size_t name_at = text.find_first_not_of(" \t*", kSha256Digits);
  if (file.hash.size() != kSha256Digits || name_at == kSha256Digits ||
      file.hash.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
    file.expected = "64 hexadecimal digits and the name of a file";
    return file;
  }
  for (char& digit : file.hash)
    if (digit >= 'A' && digit <= 'F') digit = static_cast<char>(digit - 'A' + 'a');
  std::string name = name_at == std::string::npos ? "" : text.substr(name_at);
  std::error_code error;                                         // a name may be too long for one
  if (!fs::exists(folder / name, error)) name = bag_name(name);  // sha256sum has them as they are
  const fs::path place = fs::path(name).lexically_normal();
  file.name = place.generic_string();
  if (!is_within(place)) file.expected = "the name of a file in the folder";
  return file;
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

std::vector<ListedFile> listed_files(const fs::path& folder) {
  std::istringstream lines(read_text(folder / kManifest));
  std::vector<ListedFile> files;
  for (std::string line; std::getline(lines, line);)
    files.push_back(listed_file(folder, line, std::ssize(files) + 1));
  return files;
}

FileHashes read_manifest(const fs::path& folder) {
  FileHashes files;
  for (const ListedFile& file : listed_files(folder)) {
    const bool is_new = !file.expected.empty() || files.emplace(file.name, file.hash).second;
    if (!file.expected.empty() || !is_new)
      throw std::runtime_error(fmt::format("{}:{}: expected {}", (folder / kManifest).string(), file.line,
                                           is_new ? file.expected : "each file once"));
  }
  return files;
}

bool is_as_listed(const fs::path& file, const std::string& hash) {
  std::error_code error;
  return fs::is_regular_file(file, error) && sha256_of_file(file) == hash;
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
