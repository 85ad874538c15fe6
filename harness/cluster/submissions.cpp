#include "harness/cluster/submissions.h"

#include "harness/io/atomic_file.h"
#include "harness/io/json_file.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {

std::vector<std::string> read_submissions(const std::filesystem::path& folder) {
  constexpr std::size_t kMostJobs = 100'000;
  std::vector<std::string> arrays;
  if (!std::filesystem::exists(folder / kSubmissionsFile)) return arrays;
  read_json_file(folder / kSubmissionsFile, [&](const JsonValue& json) {
    for (const JsonValue& job : json.at("arrays").list(0, kMostJobs)) arrays.push_back(job.text());
    return 0;
  });
  return arrays;
}

void write_submissions(const std::filesystem::path& folder, const std::vector<std::string>& arrays) {
  write_file_atomically(folder / kSubmissionsFile, json_text({{"arrays", arrays}}));
}

}  // namespace stereobench::harness
