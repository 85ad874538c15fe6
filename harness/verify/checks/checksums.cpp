#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/file_list.h"
#include "harness/io/sha256.h"
#include "harness/io/text_file.h"
#include "harness/verify/checks/checks.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

Fault changed_file(const fs::path& folder, const std::string& name) {
  if (!fs::exists(folder / name)) return {name, "", fmt::format("missing file: {} lists it", kManifest)};
  return {
      name, "",
      fmt::format("checksum: its bytes are not those that {} lists (a flipped bit, or edited)", kManifest)};
}

/// A name as BagIt has it: line ends and % are written as %0A, %0D, %25.
std::string bag_name(std::string name) {
  for (const auto& [code, letter] : {std::pair("%0A", "\n"), std::pair("%0D", "\r"), std::pair("%25", "%")})
    for (std::size_t at = name.find(code); at != std::string::npos; at = name.find(code, at + 1))
      name.replace(at, 3, letter);
  return name;
}

void check_manifest(const fs::path& folder, ChecksumResult& result) {
  if (!fs::exists(folder / kManifest)) {
    result.cannot.push_back(fmt::format("bytes of files: there is no {}", kManifest));
    return;
  }
  std::istringstream lines(read_text(folder / kManifest));
  long number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::size_t name_at = line.find_first_not_of(" \t*", kSha256Digits);
    const bool is_line = line.size() > kSha256Digits && name_at != std::string::npos &&
                         line.find_first_not_of("0123456789abcdefABCDEF") >= kSha256Digits;
    if (!is_line) {
      result.faults.push_back(
          {kManifest, "",
           fmt::format("line {}: expected 64 hexadecimal digits and the name of a file", number)});
      continue;
    }
    std::string name = line.substr(name_at);
    if (!fs::exists(folder / name)) name = bag_name(name);  // sha256sum has them as they are
    const fs::path place = fs::path(name).lexically_normal();
    if (place.is_absolute() || *place.begin() == "..") {
      result.faults.push_back({kManifest, "", fmt::format("line {}: expected a file in the folder", number)});
      continue;
    }
    std::string wanted = line.substr(0, kSha256Digits);
    for (char& digit : wanted)
      if (digit >= 'A' && digit <= 'F') digit = static_cast<char>(digit - 'A' + 'a');
    if (!fs::is_regular_file(folder / place) || sha256_of_file(folder / place) != wanted)
      result.faults.push_back(changed_file(folder, name));
    ++result.files;
  }
}

}  // namespace

ChecksumResult check_checksums(const fs::path& folder) {
  ChecksumResult result;
  check_manifest(folder, result);
  return result;
}

}  // namespace stereobench::harness
