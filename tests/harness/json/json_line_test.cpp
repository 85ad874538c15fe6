#include "harness/json/json_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "worlds/yaml/parse_yaml.h"

namespace stereobench::harness {
namespace {

/// A right line of detections but for a colour that is lists within each other.
std::string nested_line(std::size_t levels) {
  return R"({"frame": 0, "balls": [{"colour": )" + std::string(levels, '[') + std::string(levels, ']') +
         "}]}";
}

// The brackets are closed again, so that it is JSON. Mutation: no limit (a message that shows the value runs
// out of stack at 80,000 levels).
TEST(JsonLine, IsReadToTheLimitOfNestingAndRefusedBeyond) {
  constexpr std::size_t kAround = 3;  // the object, its balls, a ball
  EXPECT_NO_THROW(parse_line(nested_line(worlds::kMostNesting - kAround)));
  for (const std::size_t levels : {worlds::kMostNesting - kAround + 1, std::size_t{80'000}})
    EXPECT_THAT([&] { parse_line(nested_line(levels)); },
                testing::ThrowsMessage<BadLine>(testing::AllOf(
                    testing::StartsWith("expected lists and objects at most 64 deep (got '{\"frame\": 0"),
                    testing::Not(testing::HasSubstr("\n")))));
}

TEST(JsonLine, MaybeDeepestWithinWhatIsKnown) {
  const auto deepest = parse_line(nested_line(50));
  EXPECT_THAT(
      [&] { JsonValue(deepest, "").at("balls").list(0, 9).at(0).at("colour").integer(0, 17); },
      testing::ThrowsMessage<BadLine>(testing::StartsWith("balls[0].colour: expected a whole number")));
}

}  // namespace
}  // namespace stereobench::harness
