/// Photographs of balls that nothing was tuned on: what is asked of them is met.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/studies/photograph_score.h"
#include "vision/observe.h"

namespace stereobench {
namespace {

constexpr std::uint64_t kHeldOut = 2000;  // those that were looked at while it was made are below 1100
constexpr std::uint64_t kPictures = 30;

/// Colours of four pictures, and what is found in others by them.
PhotographScore held_out() {
  const auto palette = palette_of_four_photographs(900'000);
  const vision::ColourTable table = vision::table_of(palette, vision::Levels::kSrgb);
  PhotographScore all;
  for (std::uint64_t seed = kHeldOut; seed < kHeldOut + kPictures; ++seed) {
    const photograph::Photograph photograph = photograph::take(seed);
    all.add(score_of(photograph, look_at(photograph.levels, table)));
  }
  return all;
}

/// A share, and three standard errors of it.
double three_errors(double share, long of) {
  return 3.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(of));
}

// Measured on 150 pictures, these 30 among them: 0.955 found, 0.879 of these trusted. Leaves, boxes and
// boards are of the balls' colours: 0.19 of them a picture are trusted; three standard errors of Poisson's.
// One test, since each test is a process and would take the photographs anew. Mutations: what is rougher than
// round trusted; outlines of which little is seen. Not tried here, but by the study: no steps looked for at
// the circle (0.73 trusted).
TEST(Photographs, ShowTheirWholeBallsAndNothingElseThatIsTrusted) {
  const PhotographScore score = held_out();
  ASSERT_GT(score.whole, 60);
  const auto share = [](long part, long whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  };
  EXPECT_GE(share(score.found, score.whole), 0.96 - three_errors(0.96, score.whole));
  EXPECT_GE(share(score.trusted, score.found), 0.88 - three_errors(0.88, score.found));
  const auto pictures = static_cast<double>(score.pictures);
  EXPECT_LE(static_cast<double>(score.nothings_trusted) / pictures, 0.19 + 3.0 * std::sqrt(0.19 / pictures));
  EXPECT_LE(score.hidden_trusted, std::max(1L, score.hidden / 10)) << "of " << score.hidden;
}

}  // namespace
}  // namespace stereobench
