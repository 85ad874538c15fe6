/// Faults of scenario files and of `--set`, and what is said of them.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::worlds {

/// What reading a file with overrides is refused with.
using Complaint = std::string(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// A fault planted into the small scenario, and the line:key and the words of the complaint about it.
struct Fault {
  const char* piece;
  const char* instead;
  const char* complaint;
};

inline void PrintTo(const Fault& fault, std::ostream* out) {
  *out << plain(fault.instead) << " at " << plain(fault.complaint);
}

/// It is refused in one line that names the place and what is expected there.
inline void expect_refused(const Fault& fault, const std::function<Complaint>& complaint_about) {
  const ScenarioFolder folder;
  const auto file = folder.write("bad.yaml", small_scenario_with(fault.piece, fault.instead));
  const std::string complaint = complaint_about(file, {});
  EXPECT_THAT(complaint, testing::StartsWith(file.string() + ":" + fault.complaint));
  EXPECT_THAT(complaint, testing::Not(testing::HasSubstr("\n")));
}

/// An override that cannot be, and the complaint about it.
struct BadOverride {
  const char* text;
  const char* complaint;
};

inline void PrintTo(const BadOverride& bad, std::ostream* out) {
  *out << plain(bad.text);
}

/// The complaint blames the command line, not the file.
inline void expect_blamed(const BadOverride& bad, const std::function<Complaint>& complaint_about) {
  const ScenarioFolder folder;
  const auto file = folder.write("good.yaml", kSmallScenario);
  EXPECT_THAT(complaint_about(file, {bad.text}), testing::StartsWith(bad.complaint));
}

}  // namespace stereobench::worlds
