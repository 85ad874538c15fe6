#include <fmt/format.h>

#include "harness/io/file_list.h"
#include "harness/verify/checks/checks.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

Fault changed_file(const fs::path& folder, const std::string& name) {
  std::error_code error;  // a name may be too long for one
  if (!fs::exists(folder / name, error))
    return {name, "", fmt::format("missing file: {} lists it", kManifest)};
  return {
      name, "",
      fmt::format("checksum: its bytes are not those that {} lists (a flipped bit, or edited)", kManifest)};
}

}  // namespace

ChecksumResult check_checksums(const fs::path& folder) {
  ChecksumResult result;
  if (!fs::exists(folder / kManifest)) {
    result.cannot.push_back(fmt::format("bytes of files: there is no {}", kManifest));
    return result;
  }
  for (const ListedFile& file : listed_files(folder)) {
    if (!file.expected.empty()) {
      result.faults.push_back({kManifest, "", fmt::format("line {}: expected {}", file.line, file.expected)});
      continue;
    }
    if (!is_as_listed(folder / file.name, file.hash))
      result.faults.push_back(changed_file(folder, file.name));
    ++result.files;
  }
  return result;
}

}  // namespace stereobench::harness
