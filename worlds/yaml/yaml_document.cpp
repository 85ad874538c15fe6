#include "worlds/yaml/yaml_document.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "worlds/yaml/key_group.h"
#include "worlds/yaml/parse_yaml.h"

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
    documents = parse_yaml(text);
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

/// One "key.path=value" on its way into a document.
class Override {
 public:
  Override(std::string text, const KeyGroup& keys) : text_(std::move(text)), keys_(keys) {
    const std::size_t equals = text_.find('=');
    if (equals == std::string::npos) refuse("expected key.path=value (got no =)");
    path_ = text_.substr(0, equals);
  }

  const std::string& path() const { return path_; }

  void put_into(const YAML::Node& root) const {
    YAML::Node value;
    try {
      const std::vector<YAML::Node> documents = parse_yaml(text_.substr(path_.size() + 1));
      if (!documents.empty()) value = documents.front();
    } catch (const YAML::Exception& error) {
      refuse(fmt::format("expected a YAML value ({})", error.msg));
    }
    node_in(root) = value;
  }

 private:
  [[noreturn]] void refuse(const std::string& expected) const {
    throw std::runtime_error(fmt::format("--set {}: {}", text_.substr(0, text_.find('=')), expected));
  }

  /// The node that the path names; groups and lists with defaults that are missing on the way are made.
  YAML::Node node_in(const YAML::Node& root) const {
    YAML::Node node = root;
    for (std::size_t begin = 0; begin <= path_.size();) {
      const std::size_t end = std::min(path_.find('.', begin), path_.size());
      const std::string part = path_.substr(begin, end - begin);
      const std::string key = part.substr(0, part.find('['));
      if (key.empty()) refuse("expected key.path=value (got an empty key)");
      if (node.IsSequence())
        refuse(fmt::format("expected an entry of the list, e.g. {}[0]", path_.substr(0, begin - 1)));
      if (node.IsDefined() && node.IsScalar()) refuse("expected a path of keys (got one below a value)");
      YAML::Node child = node[key];
      if (key.size() < part.size()) {
        if (!child.IsDefined()) make_list(root, path_.substr(0, begin + key.size()), child);
        child.reset(entry_of(child, part.substr(key.size())));
      }
      node.reset(child);
      begin = end + 1;
    }
    return node;
  }

  /// A list that is left out has its declared default.
  void make_list(const YAML::Node& root, const std::string& path, YAML::Node& list) const {
    const Key* const key = declared_key(keys_, path);
    if (key == nullptr) return;
    if (!key->fallback.empty()) list = YAML::Load(key->fallback);
    if (key->same_as.empty()) return;
    const std::string other(key->same_as);
    const std::size_t dot = other.find('.');
    const YAML::Node group = root[other.substr(0, dot)];
    const YAML::Node written = group && group.IsMap() ? group[other.substr(dot + 1)] : YAML::Node();
    if (written && written.IsSequence())
      list = YAML::Clone(written);
    else
      make_list(root, other, list);
  }

  /// @param places "[1]", or "[1][0]" in a list of lists
  YAML::Node entry_of(YAML::Node list, std::string_view places) const {
    while (!places.empty()) {
      std::size_t place = 0;
      const auto [end, error] = std::from_chars(places.data() + 1, places.data() + places.size(), place);
      if (places.front() != '[' || error != std::errc() || end == places.data() + places.size() ||
          *end != ']')
        refuse("expected the place of an entry in brackets, e.g. corners_m[0][1]");
      if (!list.IsDefined() || !list.IsSequence()) refuse("expected a list there, to set an entry of");
      if (place >= list.size())
        refuse(fmt::format("expected a place from 0 to {} (the list has {} entries)",
                           std::max<std::size_t>(list.size(), 1) - 1, list.size()));
      list.reset(list[place]);
      places.remove_prefix(static_cast<std::size_t>(end + 1 - places.data()));
    }
    return list;
  }

  std::string text_;
  const KeyGroup& keys_;
  std::string path_;
};

}  // namespace

bool lies_within(const std::string& key, const std::string& group) {
  return key.starts_with(group) &&
         (key.size() == group.size() || key[group.size()] == '.' || key[group.size()] == '[');
}

YamlDocument load_yaml(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const KeyGroup& keys) {
  YamlDocument document{.file = file, .root = parse_one_document(file)};
  if (!document.root.IsMap()) {
    throw std::runtime_error(fmt::format("{}:1: expected a map of keys at the top", file.string()));
  }
  for (const std::string& text : overrides) {
    const Override change(text, keys);
    change.put_into(document.root);
    document.overridden.push_back(change.path());
  }
  return document;
}

std::string blame(const YamlDocument& document, const std::string& key, const YAML::Mark& mark) {
  for (const auto& [put, place] : document.put_by)
    if (lies_within(key, put)) return fmt::format("{}: {}", place, key);
  if (mark.is_null()) return "--set " + key;  // in a group that was made on the way to an override
  for (const std::string& overridden : document.overridden) {
    if (lies_within(key, overridden)) return "--set " + key;
    if (!key.empty() && lies_within(overridden, key)) return "--set " + overridden;
  }
  if (key.empty()) return fmt::format("{}:{}", document.file.string(), mark.line + 1);
  return fmt::format("{}:{}: {}", document.file.string(), mark.line + 1, key);
}

}  // namespace stereobench::worlds
