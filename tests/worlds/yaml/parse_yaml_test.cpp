#include "worlds/yaml/parse_yaml.h"

#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::worlds {
namespace {

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

/// A way to nest lists or maps.
struct Nesting {
  std::string kind;
  std::function<std::string(int levels)> text;
};
void PrintTo(const Nesting& nesting, std::ostream* out) {
  *out << nesting.kind;
}
class NestedYaml : public testing::TestWithParam<Nesting> {};

std::string complaint_about(const std::string& text) {
  try {
    parse_yaml(text);
  } catch (const YAML::Exception& error) {
    return error.what();
  }
  return "";
}

// Mutations: no count of an alias' own levels (chains of aliases pass); a limit on maps alone.
TEST_P(NestedYaml, IsReadToTheLimitAndRefusedBeyond) {
  EXPECT_EQ(complaint_about(GetParam().text(kMostNesting)), "");
  for (const int levels : {kMostNesting + 1, 500, 80'000})
    EXPECT_THAT(complaint_about(GetParam().text(levels)), testing::HasSubstr("at most 64 deep")) << levels;
}

INSTANTIATE_TEST_SUITE_P(
    All, NestedYaml,
    testing::Values(Nesting{"Lists", [](int n) { return repeated("[", n) + repeated("]", n); }},
                    Nesting{"Maps", [](int n) { return repeated("{a: ", n) + "1" + repeated("}", n); }},
                    Nesting{"ListsThatAreNotClosed",
                            [](int n) { return repeated("[", n) + repeated("]", n % 80'000); }},
                    Nesting{"BlocksOfLists", [](int n) { return repeated("- ", n) + "1"; }},
                    Nesting{"Keys", [](int n) { return repeated("? ", n) + "1"; }},
                    Nesting{"AliasesOfAliases",
                            [](int n) {  // the map, and a list for each line from the second on
                              std::string text = "a0: &a0 1\n";
                              for (int i = 1; i < n; ++i)
                                text += fmt::format("a{}: &a{} [*a{}]\n", i, i, i - 1);
                              return text;
                            }}),
    [](const auto& test) { return test.param.kind; });

// Found by fuzzing: the parser stands still there. Mutation: no look at where documents begin (the test does
// not end).
TEST(ParseYaml, RefusesASeparatorOutsideOfAnyList) {
  for (const char* text : {",", ", 1]\na: 1", "--- ,", "%YAML:1.0\n,---\na: 1"})
    EXPECT_THAT(complaint_about(text), testing::HasSubstr("outside of any list or map")) << text;
  EXPECT_EQ(parse_yaml("a: 1\n---\nb: ~\n---\n---\nc: 1").size(), 4U);
  EXPECT_EQ(parse_yaml("").size(), 0U);
}

// Mutation: an alias within its own anchor let through (whoever walks the node never ends).
TEST(ParseYaml, RefusesAnAliasWithinWhatItStandsFor) {
  EXPECT_THAT(complaint_about("a: &a [1, *a]"), testing::HasSubstr("within what it stands for"));
  EXPECT_EQ(complaint_about("a: &a [1]\nb: [*a, *a]"), "");
}

TEST(ParseYaml, ReadsEachDocument) {
  const auto documents = parse_yaml("a: 1\n---\n[2, 3]\n");
  ASSERT_EQ(documents.size(), 2U);
  EXPECT_EQ(documents[0]["a"].as<int>(), 1);
  EXPECT_EQ(documents[1][1].as<int>(), 3);
  EXPECT_TRUE(parse_yaml("").empty());
}

}  // namespace
}  // namespace stereobench::worlds
