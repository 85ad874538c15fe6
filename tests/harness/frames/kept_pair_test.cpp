/// Which stereo pairs of a run are kept, and their files.
#include "harness/frames/kept_pair.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "harness/frames/pair_files.h"
#include "slam/math/random.h"
#include "tests/picture_codecs/codecs.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

std::vector<KeptPair> random_pairs(std::size_t count, std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  std::vector<KeptPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const long faults = std::max(0L, std::lround(random.normal()));
    const double nis = std::round(std::abs(4.0 * random.normal()));  // many are as bad as others
    pairs.push_back({.seed = i % 5, .frame = i / 5, .badness = {faults, nis}});
  }
  return pairs;
}

std::vector<std::pair<std::uint64_t, std::size_t>> names_of(const std::vector<KeptPair>& pairs) {
  std::vector<std::pair<std::uint64_t, std::size_t>> names;
  for (const KeptPair& pair : pairs) names.emplace_back(pair.seed, pair.frame);
  return names;
}

// Law: those that come one by one are chosen as if all were sorted, in whatever order they come. Mutations:
// the error before the faults; equal ones by their coming; one too many kept.
TEST(WorstPairs, AreTheFirstOfAllSorted) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<KeptPair> all = random_pairs(100, seed);
    WorstPairs forwards(12), backwards(12);
    for (std::size_t i = 0; i < all.size(); ++i) {
      forwards.offer(all[i]);
      backwards.offer(all[all.size() - 1 - i]);
    }
    std::ranges::sort(all, [](const KeptPair& a, const KeptPair& b) {
      if (a.badness.faults != b.badness.faults) return a.badness.faults > b.badness.faults;
      if (a.badness.worst_nis != b.badness.worst_nis) return a.badness.worst_nis > b.badness.worst_nis;
      return std::tie(a.seed, a.frame) < std::tie(b.seed, b.frame);
    });
    all.resize(12);
    EXPECT_EQ(names_of(forwards.pairs()), names_of(all));
    EXPECT_EQ(names_of(backwards.pairs()), names_of(all));
  }
}

// Mutation: pictures taken of each pair that is offered, which takes a second a drive.
TEST(WorstPairs, TakePicturesOfThoseAloneThatAreKept) {
  WorstPairs worst(2);
  int taken = 0;
  const auto take = [&](KeptPair& pair) { pair.left_jpeg = std::to_string(++taken); };
  for (const double nis : {5.0, 4.0, 3.0, 2.0, 6.0}) worst.offer({.badness = {0, nis}}, take);
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(worst.pairs().at(0).left_jpeg, "3");
  WorstPairs none(0);
  none.offer({}, take);
  EXPECT_EQ(taken, 3);
  EXPECT_TRUE(none.pairs().empty());
}

// Mutations: the right picture not counted; the one that is too much kept.
TEST(WorstPairs, AreCutWhereTheirPicturesGetTooLarge) {
  std::vector<KeptPair> pairs(5);
  for (KeptPair& pair : pairs) pair.left_jpeg = pair.right_jpeg = std::string(10, 'x');
  EXPECT_EQ(within_bytes(pairs, 59).size(), 2U);
  EXPECT_EQ(within_bytes(pairs, 60).size(), 3U);
  EXPECT_EQ(within_bytes(pairs, 1000).size(), 5U);
}

// Mutations: one of the faults left out; errors that are no numbers; the last one for the largest.
TEST(PairBadness, CountsEveryFaultAndTheLargestError) {
  VisionScore score{.visible = 9, .found = 7, .misidentified = 3, .spurious = 10, .repeated = 20};
  score.normalised_errors = {0.5, 2.5, 1.0, std::nan("")};
  EXPECT_EQ(badness_of(score).faults, 35);
  EXPECT_EQ(badness_of(score).worst_nis, 2.5);
  EXPECT_EQ(badness_of({}).worst_nis, 0.0);
}

cv::Mat decoded(const std::string& jpeg) {
  return cv::imdecode(std::vector<uchar>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
}

cv::Mat gradient(int width, int height, int blue) {
  cv::Mat picture(height, width, CV_8UC3);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      picture.at<cv::Vec3b>(v, u) = {cv::saturate_cast<uchar>(blue),
                                     cv::saturate_cast<uchar>(255 * u / width),
                                     cv::saturate_cast<uchar>(255 * v / height)};
  return picture;
}

// OpenCV reads back what was seen. Mutations: red and blue swapped; left and right swapped; wide pictures
// kept as they are, or their height kept.
TEST(KeptPair, HasThePicturesAsTheyWereTaken) {
  KeptPair kept;
  keep_pictures(kept, {gradient(320, 240, 40), gradient(320, 240, 200)});
  EXPECT_LT(cv::norm(decoded(kept.left_jpeg), gradient(320, 240, 40), cv::NORM_L1) / (3.0 * 320 * 240), 2.0);
  EXPECT_LT(cv::norm(decoded(kept.right_jpeg), gradient(320, 240, 200), cv::NORM_L1) / (3.0 * 320 * 240),
            2.0);
  keep_pictures(kept, {gradient(2048, 512, 40), gradient(2048, 512, 40)});
  EXPECT_EQ(decoded(kept.left_jpeg).size(), cv::Size(1024, 256));
  EXPECT_LT(cv::norm(decoded(kept.left_jpeg), gradient(1024, 256, 40), cv::NORM_L1) / (3.0 * 1024 * 256),
            2.0);
}

// Mutations: pairs of an earlier run left there, where a comparison would find them; other pictures removed.
TEST(PairFiles, AreReadBackAndReplaceThoseOfAnEarlierRun) {
  TestFolder folder;
  folder.write("frames/seed0_step0000.png", "drawn");
  vision::StereoRig rig;
  rig.distortion.k1 = -0.125;
  const std::vector<KeptPair> old = {{3, 7, {}, "old left", "old right"}};
  const std::vector<KeptPair> pairs = {{3, 41, {}, "left", "right"}, {~std::uint64_t{0}, 0, {}, "l", "r"}};
  EXPECT_FALSE(rig_of_pairs(folder.path()));
  write_pairs(folder.path(), old, rig);
  write_pairs(folder.path(), pairs, rig);
  EXPECT_FALSE(read_pair(folder.path(), 3, 7));
  EXPECT_EQ(read_pair(folder.path(), 3, 41).value().left_jpeg, "left");
  EXPECT_EQ(read_pair(folder.path(), 3, 41)->right_jpeg, "right");
  EXPECT_EQ(read_pair(folder.path(), ~std::uint64_t{0}, 0).value().right_jpeg, "r");
  EXPECT_EQ(rig_of_pairs(folder.path()).value().distortion.k1, -0.125);
  EXPECT_EQ(rig_of_pairs(folder.path())->intrinsics.width_px, rig.intrinsics.width_px);
  EXPECT_EQ(folder.read("frames/seed0_step0000.png"), "drawn");
  write_pairs(folder.path(), {}, rig);
  EXPECT_FALSE(rig_of_pairs(folder.path()));
}

}  // namespace
}  // namespace stereobench::harness
