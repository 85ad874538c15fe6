#include "worlds/yaml/yaml_value.h"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "worlds/yaml/excerpt.h"

namespace stereobench::worlds {
namespace {

/// What a node holds, in words that fit into one line.
std::string describe(const YAML::Node& node) {
  if (node.IsMap()) return "a group of keys";
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (!node.IsScalar()) return "nothing";
  const std::string text = excerpt(node.Scalar(), 40);
  return node.Tag() == "!" ? '"' + text + '"' : text;
}

bool is_plain_scalar(const YAML::Node& node) {
  return node.IsScalar() && node.Tag() != "!";
}

template <class Number>
std::optional<Number> parse(const YAML::Node& node) {
  if (!is_plain_scalar(node)) return std::nullopt;
  const std::string& text = node.Scalar();
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

YamlValue::YamlValue(const YamlDocument& document, std::string key, YAML::Node node, YAML::Mark mark)
    : document_(&document), key_(std::move(key)), node_(std::move(node)), mark_(mark) {}

double YamlValue::number(const Interval& within) const {
  const std::optional<double> number = parse<double>(node_);
  if (!number || !std::isfinite(*number) || *number < within.least || *number > within.most) {
    fail(fmt::format("expected a number from {:g} to {:g}", within.least, within.most));
  }
  return *number;
}

int YamlValue::integer(int least, int most) const {
  const std::optional<int> number = parse<int>(node_);
  if (!number || *number < least || *number > most) {
    fail(fmt::format("expected a whole number from {} to {}", least, most));
  }
  return *number;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("expected text");
  return node_.Scalar();
}

std::filesystem::path YamlValue::path() const {
  return std::filesystem::absolute(folder() / text()).lexically_normal();
}

bool YamlValue::flag() const {
  if (!is_plain_scalar(node_) || (node_.Scalar() != "true" && node_.Scalar() != "false")) {
    fail("expected true or false");
  }
  return node_.Scalar() == "true";
}

std::size_t YamlValue::choice(std::span<const std::string_view> names) const {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (node_.IsScalar() && node_.Scalar() == names[i]) return i;
  }
  fail(fmt::format("expected one of {}", fmt::join(names, ", ")));
}

std::vector<YamlValue> YamlValue::list(std::size_t least, std::size_t most) const {
  if (!node_.IsSequence() || node_.size() < least || node_.size() > most) {
    fail(least == most ? fmt::format("expected a list of {}", least)
                       : fmt::format("expected a list of {} to {}", least, most));
  }
  std::vector<YamlValue> entries;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    entries.emplace_back(*document_, fmt::format("{}[{}]", key_, i), node_[i], node_[i].Mark());
  }
  return entries;
}

std::string YamlValue::place() const {
  return excerpt(blame(*document_, key_, mark_), 1000);  // a key may be as long as the file
}

void YamlValue::fail(std::string_view expected) const {
  refuse(fmt::format("{} (got {})", expected, describe(node_)));
}

void YamlValue::refuse(std::string_view reason) const {
  throw std::runtime_error(fmt::format("{}: {}", place(), reason));
}

}  // namespace stereobench::worlds
