#include "harness/reference/reference_pages.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

std::string tracked(const std::string& page) {
  const std::filesystem::path root =
      std::filesystem::path(__FILE__).parent_path().parent_path().parent_path().parent_path();
  std::ostringstream text;
  text << std::ifstream(root / "docs/guide" / page).rdbuf();
  return text.str();
}

// Mutation: a key's sentence or range changed, and the page not made anew.
TEST(ReferencePages, OfScenariosIsWhatTheProgramPrints) {
  EXPECT_EQ(tracked("scenario_reference.md"), scenario_reference()) << "stereobench schema --markdown";
}

// Mutation: a metric added, and the page not made anew.
TEST(ReferencePages, OfMetricsIsWhatTheProgramPrints) {
  EXPECT_EQ(tracked("metrics_reference.md"), metrics_reference()) << "stereobench metrics --markdown";
}

// Mutation: a level changed, and the page not made anew.
TEST(ReferencePages, OfFaultsIsWhatTheProgramPrints) {
  EXPECT_EQ(tracked("faults_reference.md"), faults_reference()) << "stereobench faults --markdown";
}

}  // namespace
}  // namespace stereobench::harness
