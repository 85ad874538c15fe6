// What a folder is after it went through a layout and back.
#pragma once

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {

inline std::vector<std::string> names_in(const std::string& list) {
  std::istringstream text(list);
  std::vector<std::string> names;
  for (std::string name; std::getline(text, name, ',');) names.push_back(name);
  return names;
}

/// The lines of a detector's answers, of all of a folder's pictures.
inline std::string detected(const std::filesystem::path& pictures, const std::vector<std::string>& more) {
  const Outcome outcome = run_stereobench(with({"detect", pictures.string()}, more));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.out;
}

/// Where two texts differ, without printing all of them; nothing where they are the same bytes.
inline std::string first_difference(const std::string& got, const std::string& wanted) {
  if (got == wanted) return "";
  const auto at = static_cast<std::size_t>(std::ranges::mismatch(got, wanted).in1 - got.begin());
  const std::size_t from = at < 20 ? 0 : at - 20;
  return fmt::format("byte {}: {}, wanted {}", at, got.substr(from, 40),
                     wanted.substr(std::min(from, wanted.size()), 40));
}

inline void import_to(const std::filesystem::path& out, const std::filesystem::path& from,
                      const std::vector<std::string>& more = {}) {
  const Outcome outcome = run_stereobench(with({"import", from.string(), "--out", out.string()}, more));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace stereobench::harness
