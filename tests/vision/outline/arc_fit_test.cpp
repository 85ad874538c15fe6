// What the arcs of an outline say of its place, and how well.
#include "vision/outline/arc_fit.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace stereobench::vision {
namespace {

// One pixel on the outline of a ball whose arcs have disturbing texture beside them, and nothing else.
double variance_beside_texture(double radius_px, std::size_t arcs, double texture_variance) {
  const Intrinsics camera;
  const OutlineModel outline(camera, {camera.cx_px, camera.cy_px}, radius_px);
  ScratchVector<ArcColours> colours(arcs);
  colours[0].texture_variance = texture_variance;
  colours[0].usable = true;
  const ScratchVector<UnmixedPixel> pixels = {
      {.position_px = {camera.cx_px + radius_px, camera.cy_px}, .shown = 0.5, .whole = 1.0}};
  return arc_offsets(pixels, colours, outline, 0.0, false)[0].variance_px2;
}

// An arc as long as four bits of texture averages them; one that is shorter than a bit sees one all the same.
// Mutation: arcs of any length are disturbed alike.
TEST(ArcOffsets, LongArcsAverageWhatDisturbsThem) {
  constexpr double kRadius_px = 100.0;
  const auto disturbed = [&](std::size_t arcs) {
    return variance_beside_texture(kRadius_px, arcs, 1.0) - variance_beside_texture(kRadius_px, arcs, 0.0);
  };
  const double shorter = disturbed(300);
  EXPECT_GT(shorter, 0.5);
  EXPECT_NEAR(disturbed(400) / shorter, 1.0, 1e-9) << "both shorter than texture";
  EXPECT_NEAR(disturbed(25) / disturbed(50), 0.5, 1e-9);
  EXPECT_LT(disturbed(50) / shorter, 0.3);
}

// Pixels that are far off are passed over before it is known what the edge leaves of them.
// Mutations: pixels whose corner alone is crossed passed over; those of a ramp by the sharp edge's reach.
TEST(ArcOffsets, EveryPixelSpeaksThatTheEdgeCrosses) {
  const Intrinsics camera;
  const Eigen::Vector2d centre(camera.cx_px + 150.0, camera.cy_px - 90.0);
  for (const auto& [blur_px, ramp_px] : {std::pair(0.0, 0.0), std::pair(0.0, 2.5), std::pair(0.8, 0.0)}) {
    const OutlineModel outline(camera, centre, 12.0, blur_px);
    ScratchVector<ArcColours> colours(1);
    colours[0].noise_variance = 1.0;
    int crossed = 0;
    for (int i = 0; i < 4000; ++i) {
      const double turn = 0.37 * i;
      const double reach_px = 12.0 + 4.0 * std::sin(1.7 * i);
      const Eigen::Vector2d pixel = centre + reach_px * Eigen::Vector2d(std::cos(turn), std::sin(turn));
      const RimPoint rim = outline.rim_point(pixel);
      const Coverage covered = ramp_px > 0.0 ? ramp_coverage(rim, ramp_px) : outline.coverage(rim);
      const ScratchVector<UnmixedPixel> pixels = {{.position_px = pixel, .shown = 0.5, .whole = 1e6}};
      const bool speaks = arc_offsets(pixels, colours, outline, ramp_px, false)[0].weight > 0.0;
      ASSERT_EQ(speaks, covered.per_px * 1e6 > 1.0) << rim.distance_px << " px off";
      crossed += speaks;
    }
    EXPECT_GT(crossed, 300);
  }
}

}  // namespace
}  // namespace stereobench::vision
