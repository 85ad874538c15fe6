#include "harness/json/json_line.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "worlds/yaml/parse_yaml.h"

namespace stereobench::harness {

using Json = nlohmann::json;

void JsonValue::refuse(std::string_view expectation) const {
  const std::string got = excerpt(value_->dump(-1, ' ', true, Json::error_handler_t::replace));
  throw BadLine(
      fmt::format("{}{}expected {} (got {})", place_, place_.empty() ? "" : ": ", expectation, got));
}

double JsonValue::number(double least, double most) const {
  const double number = value_->is_number() ? value_->get<double>() : std::nan("");
  if (!(number >= least && number <= most)) refuse(fmt::format("a number from {:g} to {:g}", least, most));
  return number;
}

std::int64_t JsonValue::integer(std::int64_t least, std::int64_t most) const {
  const bool whole = value_->is_number_integer() &&
                     (!value_->is_number_unsigned() || value_->get<std::uint64_t>() <= INT64_MAX);
  if (!whole || value_->get<std::int64_t>() < least || value_->get<std::int64_t>() > most)
    refuse(least == most ? fmt::format("{}", least)
                         : fmt::format("a whole number from {} to {}", least, most));
  return value_->get<std::int64_t>();
}

std::uint64_t JsonValue::natural_number() const {
  if (!value_->is_number_unsigned()) refuse("a whole number that is not negative");
  return value_->get<std::uint64_t>();
}

std::string JsonValue::text() const {
  if (!value_->is_string()) refuse("text");
  return value_->get<std::string>();
}

bool JsonValue::flag() const {
  if (!value_->is_boolean()) refuse("true or false");
  return value_->get<bool>();
}

std::vector<JsonValue> JsonValue::list(std::size_t least, std::size_t most) const {
  if (!value_->is_array()) refuse("a list");
  if (value_->size() < least || value_->size() > most)
    throw BadLine(fmt::format("{}: expected a list of {} entries (got {})", place_,
                              least == most ? fmt::format("{}", least) : fmt::format("at most {}", most),
                              value_->size()));
  std::vector<JsonValue> entries;
  for (std::size_t i = 0; i < value_->size(); ++i)
    entries.emplace_back((*value_)[i], fmt::format("{}[{}]", place_, i));
  return entries;
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::entries() const {
  if (!value_->is_object()) refuse("an object");
  std::vector<std::pair<std::string, JsonValue>> entries;
  for (const auto& [key, entry] : value_->items())
    entries.emplace_back(key, JsonValue(entry, (place_.empty() ? "" : place_ + ".") + excerpt(key)));
  return entries;
}

void JsonValue::allow(std::initializer_list<std::string_view> keys) const {
  if (!value_->is_object()) refuse("an object");
  for (const auto& [key, entry] : value_->items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw BadLine(fmt::format("{}{}unknown key, expected {}", place_.empty() ? "" : place_ + ".",
                                excerpt(key) + ": ", fmt::join(keys, ", ")));
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  const auto entry = value_->find(key);
  if (entry == value_->end()) return std::nullopt;
  return JsonValue(*entry, fmt::format("{}{}{}", place_, place_.empty() ? "" : ".", key));
}

JsonValue JsonValue::at(std::string_view key) const {
  if (const auto found = find(key)) return *found;
  if (!value_->is_object()) refuse("an object");
  refuse(fmt::format("\"{}\"", key));
}

Json parse_line(const std::string& line) {
  const auto limit_nesting = [&](int depth, Json::parse_event_t event, const Json&) {
    const bool begins =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (!begins || depth < worlds::kMostNesting)
      return true;  // what begins is a level deeper than its parent
    throw BadLine(fmt::format("expected lists and objects at most {} deep (got '{}')", worlds::kMostNesting,
                              excerpt(line)));
  };
  try {
    return Json::parse(line, limit_nesting);
  } catch (const Json::exception&) {  // no JSON, or a number that no double can hold
    throw BadLine(fmt::format("expected a line of JSON (got '{}')", excerpt(line)));
  }
}

}  // namespace stereobench::harness
