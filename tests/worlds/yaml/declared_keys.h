/// Laws of every table of keys: what is declared is read, and people are told of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/worlds/scenario/minimal_group.h"

namespace stereobench::worlds {

/// What a reader has to say of a small scenario with overrides, a line each.
using Complaints = std::function<std::vector<std::string>(const std::vector<std::string>&)>;

/// Every declared key is asked for by the reader: nothing can be three lists deep, so that a key which is
/// read is a key that is complained about.
/// @return how many keys there are
inline std::size_t expect_all_read(const KeyGroup& top, const Complaints& complaints_about) {
  std::size_t keys = 0;
  for (const Context& context : all_contexts(top)) {
    for (const Key* const key : keys_of(context)) {
      const std::string path = path_of(context, key->name);
      const auto complaints = complaints_about(overrides_with(context, *key, "[[[]]]"));
      ++keys;
      EXPECT_FALSE(complaints.empty()) << path << " is declared and not read";
      if (complaints.empty()) continue;
      EXPECT_THAT(complaints[0], testing::HasSubstr(path)) << context.kind;
    }
  }
  return keys;
}

/// Each key that may be left out says what it is then. Constants are those that members start with
/// (fields_test.cpp).
inline void expect_defaults_said(const KeyGroup& top, const Complaints& complaints_about) {
  for (const Context& context : all_contexts(top)) {
    for (const Key* const key : keys_of(context)) {
      const bool is_said = !key->fallback.empty() || !key->fallback_says.empty() || !key->same_as.empty();
      EXPECT_TRUE(is_said || is_needed(*key, context.kind) || key->kind == ValueKind::kGroup)
          << path_of(context, key->name);
      EXPECT_THAT(key->says, testing::EndsWith(".")) << path_of(context, key->name);
    }
    EXPECT_NO_THROW({  // a std::logic_error where a reader asks for what is not declared
      complaints_about(overrides_of(context, minimal(*context.group, context.kind)));
    }) << context.path;
  }
}

}  // namespace stereobench::worlds
