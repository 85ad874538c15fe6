/// Laws of worlds that are left to chance: what is drawn, from where, and that nothing else moves.
#include "worlds/generate/randomise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/worlds/generate/random_circle.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "worlds/generate/paint.h"

namespace stereobench::worlds {
namespace {

const std::vector<std::string> kGroups = {"ball_colours", "walls",   "floor",
                                          "light",        "clutter", "distractors"};

/// Where a thing stands is what is left of several attempts.
bool is_of_a_place(const std::string& key) {
  return key.ends_with(".step") || key.ends_with(".range_m") || key.ends_with(".bearing_deg");
}

std::map<std::string, double> values_of(const Scenario& scenario, std::uint64_t seed) {
  std::map<std::string, double> values;
  for (const Draw& draw : seed_world(scenario, seed).draws)
    EXPECT_TRUE(values.emplace(draw.key, draw.value).second) << draw.key << " is drawn twice";
  return values;
}

// A uniform draw has mean 1/2 and variance 1/12 of its range; whole numbers of n values (n^2 - 1) / (12 n^2).
// 600 seeds, some 150 keys: 5 standard errors are passed by chance once in ten thousand tests.
// Mutation: one stream for all keys that begin alike.
TEST(Randomise, DrawsUniformlyWithinItsRanges) {
  constexpr int kSeeds = 600;
  std::map<std::string, std::vector<double>> shares;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const Draw& draw : seed_world(everything(), seed).draws) {
      const Range from = draw.from;
      ASSERT_TRUE(draw.value >= from.least && draw.value <= from.most) << draw.key;
      ASSERT_TRUE(draw.names.empty() || static_cast<double>(draw.names.size()) == from.most + 1.0);
      if (is_of_a_place(draw.key) || from.least == from.most) continue;
      const double width = from.most - from.least + (draw.is_whole ? 1.0 : 0.0);
      const double middle = draw.value - from.least + (draw.is_whole ? 0.5 : 0.0);
      shares[draw.key].push_back(middle / width - 0.5);
      const double whole_less = draw.is_whole ? 1.0 / (width * width) : 0.0;
      shares[draw.key + " squared"].push_back(shares[draw.key].back() * shares[draw.key].back() -
                                              (1.0 - whole_less) / 12.0);
    }
  }
  EXPECT_GT(shares.size(), 200U);
  for (const auto& [key, all] : shares) {
    if (all.size() < 100) continue;  // of things of which there seldom are so many
    double sum = 0.0;
    for (const double share : all) sum += share;
    const double sd = key.ends_with("squared") ? std::sqrt(1.0 / 180.0) : std::sqrt(1.0 / 12.0);
    EXPECT_LT(std::abs(sum), 5.0 * sd * std::sqrt(static_cast<double>(all.size()))) << key;
  }
}

// Mutation: one stream for all keys that begin alike.
TEST(Randomise, KeysAreUncorrelated) {
  constexpr int kSeeds = 600;
  const std::vector<std::string> keys = {"light.azimuth_deg",      "light.ambient", "walls[0].shade",
                                         "walls[1].shade",         "walls[0].red",  "ball_colours[0].shade",
                                         "ball_colours[10].shade", "clutter.count", "distractors.count"};
  Eigen::MatrixXd table(kSeeds, std::ssize(keys));
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto values = values_of(everything(), static_cast<std::uint64_t>(seed));
    for (std::size_t k = 0; k < keys.size(); ++k)
      table(seed, static_cast<Eigen::Index>(k)) = values.at(keys[k]);
  }
  const Eigen::MatrixXd centred = table.rowwise() - table.colwise().mean();
  for (Eigen::Index i = 0; i < table.cols(); ++i)
    for (Eigen::Index k = 0; k < i; ++k)
      EXPECT_LT(
          std::abs(centred.col(i).dot(centred.col(k))) / (centred.col(i).norm() * centred.col(k).norm()),
          4.0 / std::sqrt(kSeeds))
          << i << ' ' << k;
}

// Each group alone draws what it draws among all others, and so does all that stays when one is left out.
// Mutation: one stream for all keys, numbered as they come.
TEST(Randomise, NoKeyMovesAnother) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto all = values_of(everything(), seed);
    for (const std::string& group : kGroups) {
      const auto alone = values_of(scenario_with("randomise={" + group + ": {}}"), seed);
      EXPECT_FALSE(alone.empty());
      for (const auto& [key, value] : alone) EXPECT_TRUE(is_of_a_place(key) || all.at(key) == value) << key;
    }
    const auto narrower = values_of(
        read_scenario(kCircle, {kAll, "path.laps=1", "randomise.light.ambient=0.4"}, obj_solid), seed);
    EXPECT_EQ(narrower.at("light.ambient"), 0.4);
    for (const auto& [key, value] : narrower)
      EXPECT_TRUE(key == "light.ambient" || all.at(key) == value) << key;
  }
}

TEST(Randomise, IsOffByDefault) {
  const Scenario scenario = read_scenario(kCircle, {"placement_jitter_m=0"});
  const SeedWorld made = seed_world(scenario, 7);
  EXPECT_TRUE(made.draws.empty() && made.left_out.empty());
  EXPECT_EQ(made.world.meshes.size(), scenario.world.meshes.size());
  EXPECT_FALSE(made.world.balls.front().paint_rgb);
}

template <typename Vector>
void add(std::string& text, const Vector& numbers) {
  for (const double number : numbers)
    text.append(reinterpret_cast<const char*>(&number), sizeof(number));  // NOLINT: every bit counts
}

/// Everything of a world that is seen, bit for bit.
std::string print(const World& world) {
  std::string text;
  for (const Ball& ball : world.balls) {
    add(text, ball.centre_m);
    add(text, std::array{ball.radius_m});
    add(text, paint_of(ball));
    text += std::to_string(ball.colour);
  }
  for (const Wall& wall : world.walls) {
    add(text, wall.tint_rgb);
    text += std::to_string(static_cast<int>(wall.material));
  }
  for (const MeshInstance& mesh : world.meshes) {
    add(text, mesh.position_m);
    add(text, mesh.scale);
    add(text, mesh.tint_rgb);
    add(text,
        std::array{mesh.heading_rad, static_cast<double>(mesh.material), static_cast<double>(mesh.shape)});
    text += mesh.file;
  }
  add(text, world.floor_tint_rgb);
  add(text, world.light.towards_light);
  add(text, std::array{world.light.ambient, world.light.diffuse, static_cast<double>(world.floor)});
  return text;
}

// Mutation: the floor's tint not written.
TEST(Randomise, WrittenOutItIsAPlainScenarioOfTheSameWorld) {
  const ScenarioFolder folder;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto copy = folder.write("copy.yaml", written_out(kCircle, {kAll, "path.laps=1"}, seed, obj_solid));
    const Scenario plain = read_scenario(copy);
    EXPECT_EQ(print(plain.world), print(world_for_seed(everything(), seed))) << seed;
    EXPECT_EQ(print(world_for_seed(plain, 99)), print(plain.world)) << "something is still left to chance";
    EXPECT_THAT(seed_world(plain, seed).draws, testing::IsEmpty());
  }
}

// The log alone says what the world is: here of all that is not computed further.
TEST(Randomise, TheLogIsWhatWasPutIntoTheWorld) {
  const SeedWorld made = seed_world(everything(), 3);
  const auto values = values_of(everything(), 3);
  const World& world = made.world;
  EXPECT_EQ(world.light.ambient, values.at("light.ambient"));
  EXPECT_EQ(world.light.diffuse, values.at("light.diffuse"));
  const double azimuth = values.at("light.azimuth_deg") * M_PI / 180.0;
  const double elevation = values.at("light.elevation_deg") * M_PI / 180.0;
  EXPECT_LT((world.light.towards_light - Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                         std::cos(elevation) * std::sin(azimuth),
                                                         std::sin(elevation)))
                .norm(),
            1e-12);
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    const std::string name = "walls[" + std::to_string(i) + "].";
    const double shade = values.at(name + "shade");
    EXPECT_EQ(world.walls[i].tint_rgb.x(), shade * (1.0 + values.at(name + "red")));
    EXPECT_EQ(world.walls[i].tint_rgb.z(), shade * (1.0 + values.at(name + "blue")));
  }
  const std::size_t given = everything().world.meshes.size();
  const double things = values.at("clutter.count") + values.at("distractors.count");
  EXPECT_EQ(static_cast<double>(world.meshes.size() - given + made.left_out.size()), things);
}

// Mutation: colours given by the number of the ball.
TEST(Randomise, ShuffledColoursTellApartWhatWasToldApart) {
  Scenario scenario = everything();
  scenario.world.balls[5].colour = scenario.world.balls[2].colour;
  std::map<int, int> first;
  constexpr int kSeeds = 1800;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    scenario.randomise.clutter.reset();
    scenario.randomise.distractors.reset();
    const World world = world_for_seed(scenario, seed);
    for (std::size_t i = 0; i < world.balls.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        ASSERT_EQ(world.balls[i].colour == world.balls[k].colour,
                  scenario.world.balls[i].colour == scenario.world.balls[k].colour);
    ++first[world.balls[0].colour];
  }
  double chi_square = 0.0;  // 17 degrees of freedom: 42.9 is passed once in 2,000
  for (int colour = 0; colour < 18; ++colour) chi_square += std::pow(first[colour] - 100.0, 2) / 100.0;
  EXPECT_LT(chi_square, 42.9);
}

struct BadRange {
  std::string text;
  std::string complaint;
};

void PrintTo(const BadRange& value, std::ostream* out) {
  *out << value.text;
}

class BadRandomisation : public testing::TestWithParam<BadRange> {};

TEST_P(BadRandomisation, NamesFileLineAndKey) {
  const ScenarioFolder folder;
  const auto file = folder.write(
      "bad.yaml", small_scenario_with("placement_jitter_m: 0.01", "randomise: {" + GetParam().text + "}"));
  EXPECT_THAT([&] { read_scenario(file); }, testing::ThrowsMessage<std::runtime_error>(testing::StartsWith(
                                                file.string() + ":18: randomise." + GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(
    Ranges, BadRandomisation,
    testing::Values(
        BadRange{"light: {ambient: [0.6, 0.2]}", "light.ambient: expected the least first"},
        BadRange{"light: {ambient: [0.6, 1.2]}", "light.ambient[1]: expected a number from 0 to 1 (got 1.2)"},
        BadRange{"light: {ambient: [0.6]}", "light.ambient: expected a list of 2"},
        BadRange{"light: {ambient: .nan}", "light.ambient: expected a number from 0 to 1 (got .nan)"},
        BadRange{"light: {colour: 3}", "light.colour: unknown key"},
        BadRange{"lights: {}", "lights: unknown key, did you mean light?"},
        BadRange{"light: true", "light: expected a group of keys"},
        BadRange{"walls: {materials: [lava]}", "walls.materials[0]: expected one of plain, tiles"},
        BadRange{"walls: {materials: []}", "walls.materials: expected a list of 1 to 100"},
        BadRange{"clutter: {count: [1, 2.5]}", "clutter.count[1]: expected a whole number from 0 to 1000"},
        BadRange{"clutter: {size_m: [0, 1]}", "clutter.size_m[0]: expected a number from 0.001 to 10"},
        BadRange{"distractors: {shapes: [cone]}", "distractors.shapes[0]: expected one of box, ball"},
        BadRange{"ball_colours: {shuffle: 2}", "ball_colours.shuffle: expected true or false"},
        BadRange{"balls_in_view: -1", "balls_in_view: expected a whole number from 0 to 254"}));

TEST(BadRandomisation, IsNotForTheOracle) {
  const ScenarioFolder folder;
  const auto file = folder.write(
      "bad.yaml", small_scenario_with("sensor: stereo", "randomise: {light: {}}\nsensor: oracle"));
  EXPECT_THAT([&] { read_scenario(file); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("randomise: the oracle has no")));
}

}  // namespace
}  // namespace stereobench::worlds
