#include "harness/run/provenance.h"

#include <filesystem>
#include <sstream>

#include "harness/io/sha256.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::map<std::string, std::string> files_of_command(std::string command) {
  for (char& letter : command)
    if (letter == '\'' || letter == '"') letter = ' ';
  std::map<std::string, std::string> files;
  std::istringstream words(command);
  std::error_code error;
  for (std::string word; words >> word;)
    if (std::filesystem::is_regular_file(word, error)) files[word] = sha256_of_file(word);
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
  const Json basis = {{"program", sha256_of_file("/proc/self/exe")},
                      {"scenario", provenance.scenario},
                      {"files", provenance.files},
                      {"pixels", provenance.pixels},
                      {"backend", backend},
                      {"detector_files", files_of_command(detector)}};
  return basis.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stereobench::harness
