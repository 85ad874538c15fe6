// What the arcs of an outline say of its place, and how well.
#include "vision/arc_fit.h"

#include <cmath>

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
  return arc_offsets(pixels, colours, outline, 0.0)[0].variance_px2;
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

}  // namespace
}  // namespace stereobench::vision
