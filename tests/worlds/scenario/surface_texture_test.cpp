/// Textures of walls and floors as scenarios say and draw them.
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "worlds/generate/randomise.h"

namespace stereobench::worlds {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A folder with two pictures, of which nobody looks at the inside, and a scenario.
class TexturedScenario : public testing::Test {
 protected:
  TexturedScenario() {
    folder_.write("a.png", "a");
    std::filesystem::create_directory(folder_.path() / "more");
    folder_.write("more/b.jpg", "b");
  }

  std::filesystem::path write(const std::string& piece, const std::string& instead,
                              const std::string& after = "") const {
    return folder_.write("scenario.yaml", small_scenario_with(piece, instead) + after);
  }
  std::string complaint(const std::string& piece, const std::string& instead) const {
    return complaint_of([&] { read_scenario(write(piece, instead)); });
  }

  ScenarioFolder folder_;
};

TEST_F(TexturedScenario, NamesPicturesFromItsFolder) {
  const World world =
      read_scenario(write("material: wood", "texture: {file: more/b.jpg, tile_m: 1.5}")).world;
  ASSERT_EQ(world.walls.size(), 3U);
  for (const Wall& wall : world.walls) {
    EXPECT_EQ(wall.material, Material::kFile);
    EXPECT_EQ(wall.texture.file, (folder_.path() / "more/b.jpg").string());
    EXPECT_EQ(wall.texture.tile_m, 1.5);
    EXPECT_THAT(wall.texture.stated_at, EndsWith("scenario.yaml:24: world.walls[0].texture.file"));
  }
  EXPECT_EQ(world.floor, Material::kBricks);
  const World other = read_scenario(write("floor: bricks", "floor_texture: {file: a.png}")).world;
  EXPECT_EQ(other.floor, Material::kFile);
  EXPECT_EQ(other.floor_texture.tile_m, 1.0);
  EXPECT_EQ(other.walls.front().material, Material::kWood);
}

TEST_F(TexturedScenario, SaysWhereItIsWrong) {
  const std::map<std::string, std::string> walls = {
      {"texture: {file: c.png}",
       "24: world.walls[0].texture.file: expected a picture that exists (got c.png)"},
      {"texture: {file: more}", "24: world.walls[0].texture.file: expected a picture that exists (got more)"},
      {"texture: {tile_m: 2}", "24: world.walls[0].texture.file: this key is missing"},
      {"texture: {file: a.png, tile_m: 0}",
       "24: world.walls[0].texture.tile_m: expected a number from 0.001 to 1000 (got 0)"},
      {"texture: {file: a.png, tiles: 2}", "24: world.walls[0].texture.tiles: unknown key"},
      {"texture: {file: a.png}, material: wood",
       "24: world.walls[0].texture: expected no material beside it"},
      {"material: file", "24: world.walls[0].material: expected one of plain"}};
  for (const auto& [line, message] : walls)
    EXPECT_THAT(complaint("material: wood", line), HasSubstr(message));
  EXPECT_THAT(complaint("floor: bricks", "floor: bricks\n  floor_texture: {file: a.png}"),
              HasSubstr("world.floor_texture: expected no floor beside it"));
  EXPECT_THAT(complaint("placement_jitter_m: 0.01", "randomise: {walls: {textures: [{file: c.png}]}}"),
              HasSubstr("18: randomise.walls.textures[0].file: expected a picture that exists (got c.png)"));
  EXPECT_THAT(complaint("placement_jitter_m: 0.01", "randomise: {clutter: {textures: [{file: a.png}]}}"),
              HasSubstr("randomise.clutter.textures: unknown key"));
}

/// How often each seed's floor is what.
std::map<std::string, int> floors(const Scenario& scenario, int seeds) {
  std::map<std::string, int> count;
  for (int seed = 0; seed < seeds; ++seed) {
    const SeedWorld made = seed_world(scenario, static_cast<std::uint64_t>(seed));
    for (const Draw& draw : made.draws)
      if (draw.key == "floor.material") ++count[draw.names.at(static_cast<std::size_t>(draw.value))];
    const bool has_texture = made.world.floor == Material::kFile;
    EXPECT_EQ(has_texture, !made.world.floor_texture.file.empty());
  }
  return count;
}

// 300 seeds: within 5 standard deviations of a third or a half. Mutation: materials in any case.
TEST_F(TexturedScenario, DrawsFromTexturesAndMaterials) {
  const std::string textures = "textures: [{file: a.png}, {file: more/b.jpg, tile_m: 3}]";
  auto count =
      floors(read_scenario(write("placement_jitter_m: 0.01", "randomise: {floor: {" + textures + "}}")), 300);
  EXPECT_EQ(count.size(), 2U);
  EXPECT_NEAR(count["a.png"], 150, 44);
  count = floors(read_scenario(write("placement_jitter_m: 0.01",
                                     "randomise: {floor: {materials: [wood], " + textures + "}}")),
                 300);
  EXPECT_EQ(count.size(), 3U);
  EXPECT_NEAR(count["wood"], 100, 41);
  EXPECT_NEAR(count["b.jpg"], 100, 41);
}

// What a seed has drawn, written out and read again from another folder, is the same world.
// Mutations: tile_m left out; the scenario's own floor kept beside the texture.
TEST_F(TexturedScenario, IsTheSameOnceWrittenOut) {
  const auto file = write("placement_jitter_m: 0.01",
                          "randomise: {walls: {textures: [{file: a.png}, {file: more/b.jpg, tile_m: 3}]}, "
                          "floor: {materials: [wood], textures: [{file: a.png, tile_m: 0.7}]}}");
  const ScenarioFolder other;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const World drawn = seed_world(read_scenario(file), seed).world;
    const World again = read_scenario(other.write("plain.yaml", written_out(file, {}, seed))).world;
    ASSERT_EQ(again.walls.size(), drawn.walls.size());
    for (std::size_t i = 0; i < drawn.walls.size(); ++i) {
      EXPECT_EQ(again.walls[i].material, drawn.walls[i].material);
      EXPECT_EQ(again.walls[i].texture.file, drawn.walls[i].texture.file);
      EXPECT_EQ(again.walls[i].texture.tile_m, drawn.walls[i].texture.tile_m);
    }
    EXPECT_EQ(again.floor, drawn.floor);
    EXPECT_EQ(again.floor_texture.file, drawn.floor_texture.file);
    EXPECT_EQ(again.floor_texture.tile_m, drawn.floor_texture.tile_m);
  }
}

// Whatever is not drawn keeps its names. Meant to catch: those of walls left as they are.
TEST_F(TexturedScenario, FindsItsPicturesFromAnotherFolder) {
  const auto file = write("material: wood", "texture: {file: more/b.jpg}",
                          "randomise: {floor: {textures: [{file: a.png}]}}\n");
  const ScenarioFolder other;
  const Scenario again = read_scenario(other.write("plain.yaml", written_out(file, {}, std::nullopt)));
  EXPECT_EQ(again.world.walls.front().texture.file, (folder_.path() / "more/b.jpg").string());
  ASSERT_TRUE(again.randomise.floor.has_value());
  EXPECT_EQ(again.randomise.floor->textures.at(0).file, (folder_.path() / "a.png").string());
}

}  // namespace
}  // namespace stereobench::worlds
