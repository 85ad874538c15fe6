#include "worlds/yaml_document.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::worlds {
namespace {

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw std::runtime_error(fmt::format("{}: no such file; expected a scenario (.yaml)", file.string()));
  }
  if (std::filesystem::is_directory(file, error)) {
    throw std::runtime_error(fmt::format("{}: expected a scenario file (got a folder)", file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream.is_open() || stream.bad()) {
    throw std::runtime_error(fmt::format("{}: expected a file that can be read", file.string()));
  }
  return text.str();
}

YAML::Node parse_one_document(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(
        fmt::format("{}:{}: expected YAML ({})", file.string(), error.mark.line + 1, error.msg));
  }
  if (documents.size() != 1) {
    throw std::runtime_error(
        fmt::format("{}:1: expected one YAML document (got {})", file.string(), documents.size()));
  }
  return documents.front();
}

[[noreturn]] void refuse(const std::string& override_text, const std::string& expected) {
  const std::string key = override_text.substr(0, override_text.find('='));
  throw std::runtime_error(fmt::format("--set {}: {}", key, expected));
}

/// The node that a dotted path names; groups that are missing on the way are made.
YAML::Node node_at(YAML::Node node, std::string_view path, const std::string& override_text) {
  while (true) {
    if (node.IsSequence()) refuse(override_text, "expected a path of keys (a list is only replaced whole)");
    if (node.IsDefined() && node.IsScalar())
      refuse(override_text, "expected a path of keys (got one below a value)");
    const std::size_t dot = path.find('.');
    const std::string key(path.substr(0, dot));
    if (key.empty()) refuse(override_text, "expected key.path=value (got an empty key)");
    YAML::Node child = node[key];
    if (dot == std::string_view::npos) return child;
    path.remove_prefix(dot + 1);
    node.reset(child);
  }
}

void put_in_place(YamlDocument& document, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse(text, "expected key.path=value (got no =)");
  YAML::Node value;
  try {
    value = YAML::Load(text.substr(equals + 1));
  } catch (const YAML::Exception& error) {
    refuse(text, fmt::format("expected a YAML value ({})", error.msg));
  }
  node_at(document.root, std::string_view(text).substr(0, equals), text) = value;
  document.overridden.push_back(text.substr(0, equals));
}

bool lies_within(const std::string& key, const std::string& group) {
  return key.starts_with(group) &&
         (key.size() == group.size() || key[group.size()] == '.' || key[group.size()] == '[');
}

}  // namespace

YamlDocument load_yaml(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  YamlDocument document{file, {}, parse_one_document(file)};
  if (!document.root.IsMap()) {
    throw std::runtime_error(fmt::format("{}:1: expected a map of keys at the top", file.string()));
  }
  for (const std::string& text : overrides) put_in_place(document, text);
  return document;
}

std::string blame(const YamlDocument& document, const std::string& key, const YAML::Mark& mark) {
  if (mark.is_null()) return "--set " + key;  // in a group that was made on the way to an override
  for (const std::string& overridden : document.overridden) {
    if (lies_within(key, overridden)) return "--set " + key;
    if (!key.empty() && lies_within(overridden, key)) return "--set " + overridden;
  }
  if (key.empty()) return fmt::format("{}:{}", document.file.string(), mark.line + 1);
  return fmt::format("{}:{}: {}", document.file.string(), mark.line + 1, key);
}

}  // namespace stereobench::worlds
