#include "harness/completion/key_candidates.h"

#include <string>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

using worlds::Key;
using worlds::KeyGroup;
using worlds::ValueKind;

/// The most whole numbers that are listed one by one.
constexpr double kMostListed = 20.0;

std::vector<std::string> values_of_key(const Key& key) {
  switch (key.kind) {
    case ValueKind::kChoice:
      return {key.names.begin(), key.names.end()};
    case ValueKind::kFlag:
      return {"true", "false"};
    case ValueKind::kWhole: {
      std::vector<std::string> numbers;
      if (key.within.most - key.within.least > kMostListed) return {};
      for (double n = key.within.least; n <= key.within.most; ++n) numbers.push_back(fmt::format("{}", n));
      return numbers;
    }
    case ValueKind::kNumber:
    case ValueKind::kText:
    case ValueKind::kGroup:
      break;
  }
  return {};
}

/// @param begun all up to the entry that is being written: "path.kind=", "filters=[ekf,"
std::vector<Candidate> value_candidates(const Key& key, std::string_view begun) {
  std::vector<Candidate> found;
  for (const std::string& value : values_of_key(key)) {
    const bool in_brackets = begun.find('[') != std::string_view::npos;
    found.push_back({fmt::format("{}{}", begun, value), "", !in_brackets});
  }
  return found;
}

/// What follows a key's name.
std::string_view end_of(const Key& key) {
  if (key.kind != ValueKind::kGroup) return "=";
  return key.lengths.most == 0 ? "." : "[";
}

}  // namespace

std::vector<Candidate> key_candidates(const KeyGroup& top, std::string_view word) {
  if (const std::size_t equals = word.find('='); equals != std::string_view::npos) {
    const Key* const key = declared_key(top, word.substr(0, equals));
    if (!key) return {};
    const std::size_t entry = word.find_last_of("=[,");
    return that_begin_with(word, value_candidates(*key, word.substr(0, entry + 1)));
  }
  const std::size_t dot = word.rfind('.');
  const std::string_view path = dot == std::string_view::npos ? "" : word.substr(0, dot);
  const Key* const above = path.empty() ? nullptr : declared_key(top, path);
  if (!path.empty() && (!above || !above->group)) return {};
  std::vector<Candidate> found;
  for (const Key& key : above ? above->group->keys : top.keys)
    found.push_back(
        {fmt::format("{}{}{}{}", path, path.empty() ? "" : ".", key.name, end_of(key)), key.says, false});
  return that_begin_with(word, std::move(found));
}

}  // namespace stereobench::harness
