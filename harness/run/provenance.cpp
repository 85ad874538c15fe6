#include "harness/run/provenance.h"

#include <filesystem>
#include <set>
#include <sstream>

#include "harness/io/sha256.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostEntries = 20'000;  ///< that are looked at below a script's folder

/// The Python files beside a script and in folders below: what it may import. Hidden folders and virtual
/// environments are left out.
std::set<std::string> modules_beside(const fs::path& script) {
  std::set<std::string> modules;
  std::error_code error;
  const fs::path folder = script.has_parent_path() ? script.parent_path() : fs::path(".");
  const auto options = fs::directory_options::skip_permission_denied;
  std::size_t entries = 0;
  for (fs::recursive_directory_iterator file(folder, options, error), end;
       file != end && !error && ++entries < kMostEntries; file.increment(error)) {
    const bool is_hidden = file->path().filename().string().starts_with(".");
    const bool is_environment = fs::exists(file->path() / "pyvenv.cfg", error);
    if ((is_hidden || is_environment) && file->is_directory(error)) file.disable_recursion_pending();
    if (is_hidden || file->path().extension() != ".py" || !file->is_regular_file(error)) continue;
    modules.insert(file->path().lexically_normal().string());
  }
  return modules;
}

}  // namespace

std::map<std::string, std::string> files_of_command(std::string command) {
  for (char& letter : command)
    if (letter == '\'' || letter == '"') letter = ' ';
  std::map<std::string, std::string> files;
  std::istringstream words(command);
  std::error_code error;
  for (std::string word; words >> word;) {
    if (!fs::is_regular_file(word, error)) continue;
    files[word] = sha256_of_file(word);
    if (fs::path(word).extension() != ".py") continue;
    for (const std::string& module : modules_beside(word)) files.try_emplace(module, sha256_of_file(module));
  }
  return files;
}

Json provenance_json(const Provenance& provenance) {
  Json json = {{"stereobench", STEREOBENCH_VERSION},
               {"scenario_sha256", sha256_of(provenance.scenario)},
               {"set", provenance.set},
               {"files_sha256", provenance.files}};
  json["pixels"] = provenance.pixels.empty() ? Json(nullptr) : Json(provenance.pixels);
  return json;
}

std::string basis_of(const Provenance& provenance, const std::string& backend, const std::string& detector) {
  static const std::string program = sha256_of_file("/proc/self/exe");
  const Json basis = {{"program", program},        {"scenario", provenance.scenario},
                      {"files", provenance.files}, {"pixels", provenance.pixels},
                      {"backend", backend},        {"detector_files", files_of_command(detector)}};
  return basis.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stereobench::harness
