#include "harness/experiment/write_experiment.h"

#include <yaml-cpp/yaml.h>

#include "harness/experiment/experiment.h"
#include "harness/experiment/scenario_file.h"
#include "harness/io/sha256.h"
#include "worlds/scenario/write_scenario.h"
#include "worlds/yaml/parse_yaml.h"

namespace stereobench::harness {
namespace {

std::string text_of(const YAML::Node& root) {
  YAML::Emitter text;
  text << root;
  return std::string(text.c_str()) + "\n";
}

void gather_files(const YAML::Node& node, std::set<std::string>& files) {
  for (const auto& entry : node) {
    const YAML::Node& value = node.IsMap() ? entry.second : entry;
    if (node.IsMap() && value.IsScalar() && entry.first.Scalar() == "file") files.insert(value.Scalar());
    if (value.IsMap() || value.IsSequence()) gather_files(value, files);
  }
}

}  // namespace

std::string with_overrides(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return text_of(load_scenario(file, overrides).root);
}

ScenarioLines lines_and_files(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const YAML::Node root = load_scenario(file, overrides).root;
  std::set<std::string> names;
  gather_files(root, names);
  ScenarioLines lines = {text_of(root), {}};
  for (const std::string& name : names) lines.files_sha256[name] = sha256_of_file(file.parent_path() / name);
  return lines;
}

std::string without_keys(const std::string& scenario, const std::set<std::string>& keys) {
  YAML::Node root = worlds::parse_yaml(scenario).front();
  for (const std::string& key : keys) root.remove(key);
  return text_of(root);
}

std::set<std::string> files_named_in(const std::filesystem::path& file,
                                     const std::vector<std::string>& overrides) {
  std::set<std::string> files;
  gather_files(load_scenario(file, overrides).root, files);
  return files;
}

std::map<std::string, std::string> hashes_of_named_files(const std::filesystem::path& file,
                                                         const std::vector<std::string>& overrides) {
  return lines_and_files(file, overrides).files_sha256;
}

std::string written_out(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                        std::optional<std::uint64_t> seed, const worlds::OccluderReader& occluders) {
  const Experiment experiment = read_experiment(file, overrides, occluders);
  worlds::YamlDocument document = load_scenario(file, overrides);
  worlds::name_file_from_anywhere(document, document.root["believed_measurement_noise"]);
  worlds::write_world(experiment.scenario, seed, document);
  if (seed) document.root["seeds"] = *seed;
  return text_of(document.root);
}

}  // namespace stereobench::harness
