#include "harness/sweep/grid.h"

#include <set>

#include <gmock/gmock.h>

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Mutation: the first one fastest.
TEST(Grid, TheLastVariationMovesFastest) {
  const std::vector<Variation> variations = {{{"a"}, {"1", "2"}}, {{"b"}, {"x", "y", "z"}}};
  EXPECT_THAT(grid(variations), ElementsAre(Cell{"1", "x"}, Cell{"1", "y"}, Cell{"1", "z"}, Cell{"2", "x"},
                                            Cell{"2", "y"}, Cell{"2", "z"}));
}

// Each combination once, whatever the sizes: as many different cells as the product of the numbers of values.
TEST(Grid, HasEachCombinationOnce) {
  for (std::size_t first = 1; first <= 4; ++first)
    for (std::size_t second = 1; second <= 4; ++second) {
      std::vector<Variation> variations = {{{"a"}, {}}, {{"b"}, {}}, {{"c"}, {"0", "1"}}};
      for (std::size_t i = 0; i < first; ++i) variations[0].values.push_back(std::to_string(i));
      for (std::size_t i = 0; i < second; ++i) variations[1].values.push_back(std::to_string(i));
      const std::vector<Cell> cells = grid(variations);
      EXPECT_EQ(cells.size(), 2 * first * second);
      EXPECT_EQ(std::set<Cell>(cells.begin(), cells.end()).size(), cells.size());
      for (const Cell& cell : cells) EXPECT_EQ(cell.size(), 3U);
    }
}

TEST(Grid, OfNothingIsTheScenarioItself) {
  EXPECT_THAT(grid({}), ElementsAre(Cell{}));
}

// Mutation: letting a key stand twice.
TEST(Grid, HasALimitAndEachKeyOnce) {
  const std::vector<std::string> hundred(100, "1");
  EXPECT_EQ(grid({{{"a"}, hundred}, {{"b"}, hundred}}).size(), 10'000U);
  EXPECT_THROW(grid({{{"a"}, hundred}, {{"b"}, hundred}, {{"c"}, {"1", "2"}}}), std::runtime_error);
  EXPECT_THAT(([] {
                grid({{{"a"}, {"1"}}, {{"a"}, {"2"}}});
              }),
              ThrowsMessage<std::runtime_error>(HasSubstr("a is varied twice")));
}

TEST(Grid, ACellOverridesEachKeyWithItsOwnValue) {
  EXPECT_THAT(overrides_of({{{"path.laps"}, {"1", "2"}}, {{"particles"}, {"10"}}}, {"2", "10"}),
              ElementsAre("path.laps=2", "particles=10"));
}

// Mutation: each key with the whole value.
TEST(Grid, LinesThatVaryTogetherEachTakeTheirPart) {
  const Variation noise = parse_variation("oracle.range_sd_m:oracle.bearing_sd_deg=0.1:1,0.3:3");
  EXPECT_EQ(noise.name(), "oracle.range_sd_m:oracle.bearing_sd_deg");
  EXPECT_EQ(grid({noise}).size(), 2U);
  EXPECT_THAT(overrides_of({noise}, {"0.3:3"}),
              ElementsAre("oracle.range_sd_m=0.3", "oracle.bearing_sd_deg=3"));
}

TEST(ParseVariation, ASingleKeyTakesColonsAsTheyAre) {
  EXPECT_THAT(overrides_of({parse_variation("a=x:y")}, {"x:y"}), ElementsAre("a=x:y"));
}

TEST(ParseVariation, KeepsValuesAsTheyWereWritten) {
  const Variation variation = parse_variation("camera.noise_sd_levels=0,1.50,-2e1,x=y");
  EXPECT_THAT(variation.keys, ElementsAre("camera.noise_sd_levels"));
  EXPECT_THAT(variation.values, ElementsAre("0", "1.50", "-2e1", "x=y"));
}

// Mutation: letting a value stand twice.
TEST(ParseVariation, RefusesWhatIsEmptyOrRepeated) {
  for (const char* text : {"", "key", "=1", "key=", "key=,1", "key=1,,2", "key=1,", "key=1,2,1"})
    EXPECT_THAT([&] { parse_variation(text); }, ThrowsMessage<std::runtime_error>(HasSubstr("--vary")))
        << text;
}

// Mutation: lists taken apart at their own commas and colons.
TEST(Grid, ListsAndGroupsAreValues) {
  const Variation turn = parse_variation("believed_rig.right_turn_deg=[0,0,0],[0.05,0,0]");
  EXPECT_THAT(turn.values, ElementsAre("[0,0,0]", "[0.05,0,0]"));
  const Variation light = parse_variation("world.light={ambient: 0.3, diffuse: 0.5},{ambient: 0.4}");
  EXPECT_THAT(light.values, ElementsAre("{ambient: 0.3, diffuse: 0.5}", "{ambient: 0.4}"));
  const Variation both =
      parse_variation("rig.distortion:world.light=[0,0,0,0,0]:{ambient: 0.3},[1,0,0,0,0]:{}");
  EXPECT_THAT(overrides_of({both}, {"[1,0,0,0,0]:{}"}),
              ElementsAre("rig.distortion=[1,0,0,0,0]", "world.light={}"));
  EXPECT_THAT(parse_variation("rig.distortion[0]=-0.1,0.1").values, ElementsAre("-0.1", "0.1"));
}

}  // namespace
}  // namespace stereobench::harness
