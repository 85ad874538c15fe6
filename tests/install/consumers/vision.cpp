// The outline of a ball in front of the camera, and a pair of pictures without balls.
#include <cmath>
#include <cstdio>

#include "vision/observe.h"
#include "vision/stereo/sphere.h"

using namespace stereobench;

int main() {
  const vision::StereoRig rig;
  const auto outline = vision::sphere_outline(rig.intrinsics, {0.0, 0.0, 2.0}, 0.1);
  if (!outline) return 1;
  const double expected_px = rig.intrinsics.focal_px * 0.1 / std::sqrt(2.0 * 2.0 - 0.1 * 0.1);
  const cv::Mat grey(rig.intrinsics.height_px, rig.intrinsics.width_px, CV_8UC3, cv::Scalar::all(100));
  const auto balls = vision::observe({grey, grey}, rig, vision::ObserverSettings{});
  std::printf("radius %.3f px, %zu balls\n", outline->radius_px(), balls.size());
  return std::abs(outline->radius_px() - expected_px) < 1e-9 && balls.empty() ? 0 : 1;
}
