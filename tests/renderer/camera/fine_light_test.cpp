/// Light of 16 bits: the same pictures to the rounding, and no steps in what is stored otherwise than as it
/// is.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "renderer/camera/expose.h"
#include "renderer/camera/sensor_model.h"
#include "renderer/renderer.h"
#include "tests/renderer/frames.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer {
namespace {

class FineLight : public testing::TestWithParam<std::tuple<std::uint64_t, bool>> {};

// Ids, depth and primitives are the same bytes; light is the same to what eight bits round: half a level
// where nothing is mixed, a little more where rounded light was mixed. Mutations: identities in steps of 256;
// edges mixed as if of eight bits; light that is cut, not rounded.
TEST_P(FineLight, IsTheSamePictureToTheRounding) {
  const auto [seed, has_lens] = GetParam();
  const worlds::World world = test::random_room(seed);
  const slam::Pose pose = test::random_pose(seed);
  vision::StereoRig rig = test::small_rig();
  if (has_lens) rig.distortion = {.k1 = -0.25, .k2 = 0.08, .p1 = 0.001};
  const StereoFrame coarse = Renderer(world, rig).render(pose);
  const StereoFrame fine = Renderer(world, rig, Backend::kSoftware, LightDepth::kSixteenBits).render(pose);
  for (const auto& [a, b] : {std::pair(&coarse.left, &fine.left), std::pair(&coarse.right, &fine.right)}) {
    EXPECT_TRUE(test::same(a->ball_id, b->ball_id));
    EXPECT_TRUE(test::same(a->depth_m, b->depth_m));
    ASSERT_EQ(b->colour.type(), CV_16UC3);
    cv::Mat levels, apart;
    b->colour.convertTo(levels, CV_32F, 1.0 / kStepsOfALevel);
    cv::absdiff(levels, cv::Mat_<cv::Vec3f>(a->colour), apart);
    double worst = 0.0;
    cv::minMaxLoc(apart.reshape(1), nullptr, &worst);
    EXPECT_LE(worst, 1.6) << "mixed up to three times, each time of rounded light and rounded";
    const float rounding = has_lens ? 1.02F : 0.52F;  // of the place's light, and of the mean of places
    int mixed = 0;
    for (const cv::Vec3f& by : cv::Mat_<cv::Vec3f>(apart))
      mixed += std::max({by[0], by[1], by[2]}) > rounding ? 1 : 0;
    EXPECT_LE(mixed, 2000) << "of 120,000";
    EXPECT_LE(cv::mean(levels - cv::Mat_<cv::Vec3f>(a->colour))[1], 0.02) << "rounded to one side";
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, FineLight,
                         testing::Combine(testing::Range(std::uint64_t{0}, std::uint64_t{3}),
                                          testing::Bool()));

/// A dark ball before the sky, shaded from a tenth of the light down to nothing, as a camera stores it.
std::set<int> stored_greens(const worlds::CameraSensor& sensor) {
  worlds::World world = test::flat_sky({{{0.6, 0.0, 0.9}, 0.25, 1}});
  world.light = {.towards_light = {-1.0, 0.3, 0.2}, .ambient = 0.0, .diffuse = 0.1};
  const vision::StereoRig rig = test::rig_looking_up();
  const StereoFrame frame = Renderer(world, rig, Backend::kSoftware, light_for(sensor)).render({});
  const cv::Mat stored = expose(frame, sensor, 0, 0).left;
  std::set<int> levels;
  for (int v = 0; v < stored.rows; ++v)
    for (int u = 0; u < stored.cols; ++u)
      if (frame.left.ball_id.at<std::uint8_t>(v, u) == 1) levels.insert(stored.at<cv::Vec3b>(v, u)[1]);
  return levels;
}

// Red before: 23 levels of 86, in steps of up to 13. Mutation: light_for always of eight bits.
TEST(FineLightStored, AsSrgbDoesNotBand) {
  const std::set<int> levels = stored_greens({.encoding = worlds::Encoding::kSrgb});
  EXPECT_GE(levels.size(), 70U);
  int widest = 0;
  for (auto level = std::next(levels.begin()); level != levels.end(); ++level)
    widest = std::max(widest, *level - *std::prev(level));
  EXPECT_LE(widest, 2);
}

// Red before: steps of ten levels.
TEST(FineLightStored, WithGainDoesNotBand) {
  EXPECT_GE(stored_greens({.gain = 10.0}).size(), 150U);
}

TEST(FineLightStored, IsAskedForByCamerasThatDoMoreThanAddNoise) {
  EXPECT_EQ(light_for({}), LightDepth::kEightBits);
  EXPECT_EQ(light_for({.noise_sd_levels = 2.0}), LightDepth::kEightBits);
  EXPECT_EQ(light_for({.encoding = worlds::Encoding::kSrgb}), LightDepth::kSixteenBits);
  EXPECT_EQ(light_for({.exposure = 0.3}), LightDepth::kSixteenBits);
  EXPECT_EQ(light_for({.full_well_electrons = 9000.0}), LightDepth::kSixteenBits);
}

// What 16 bits say in whole levels is developed as those levels are.
TEST(FineLightStored, OfWholeLevelsIsWhatTheLevelsAre) {
  const cv::Mat levels =
      Renderer(test::random_room(1), test::small_rig()).render(test::random_pose(1)).left.colour;
  cv::Mat fine;
  levels.convertTo(fine, CV_16U, kStepsOfALevel);
  for (const worlds::CameraSensor& sensor :
       {worlds::CameraSensor{.vignette = 0.3, .encoding = worlds::Encoding::kSrgb},
        worlds::CameraSensor{.full_well_electrons = 5000.0, .read_noise_electrons = 5.0},
        worlds::CameraSensor{.noise_sd_levels = 1.5, .gain = 2.0}})
    EXPECT_TRUE(test::same(develop(levels, sensor, 3, 4), develop(fine, sensor, 3, 4)));
  EXPECT_TRUE(test::same(in_levels(fine), levels));
}

}  // namespace
}  // namespace stereobench::renderer
