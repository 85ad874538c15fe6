#include "harness/dataset/formats/rectified_pair.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace stereobench::harness {

using vision::Side;

std::string projection_row(const vision::StereoRig& rig, double from_left_m) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const double f = camera.focal_px;
  return fmt::format("{} 0 {} {} 0 {} {} 0 0 0 1 0", f, camera.cx_px,
                     from_left_m == 0.0 ? 0.0 : -f * from_left_m, f, camera.cy_px);
}

std::string kitti_projections(const vision::StereoRig& rig, int first) {
  std::string lines;
  for (int camera = first; camera < 4; ++camera)
    lines += fmt::format("P{}: {}\n", camera, projection_row(rig, camera % 2 == 0 ? 0.0 : rig.baseline_m));
  return lines;
}

cv::Mat grey_of(const cv::Mat& picture) {
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Mat disparity_of(DatasetPair& pair, Side side) {
  return renderer::disparity_px(pair.to_other_camera(side), side);
}

cv::Mat seen_by_both(DatasetPair& pair, Side side) {
  constexpr int kThisOneAlone = 128;
  const renderer::Correspondence& found = pair.to_other_camera(side);
  cv::Mat mask(found.occlusion.size(), CV_8UC1, cv::Scalar(kThisOneAlone));
  mask.setTo(255, found.occlusion == static_cast<std::uint8_t>(renderer::Occlusion::kSeen));
  mask.setTo(0, found.occlusion == static_cast<std::uint8_t>(renderer::Occlusion::kNothing));
  return mask;
}

std::string middlebury_calibration(const vision::StereoRig& rig, const cv::Mat& disparity_px) {
  constexpr double kMm = 1000.0;
  const vision::Intrinsics& camera = rig.intrinsics;
  const std::string matrix =
      fmt::format("[{0} 0 {1}; 0 {0} {2}; 0 0 1]", camera.focal_px, camera.cx_px, camera.cy_px);
  double least = 0.0, most = 0.0;
  const cv::Mat there = disparity_px < std::numeric_limits<float>::infinity();
  if (cv::countNonZero(there) > 0) cv::minMaxLoc(disparity_px, &least, &most, nullptr, nullptr, there);
  const auto from = static_cast<int>(std::floor(least)), to = static_cast<int>(std::ceil(most));
  return fmt::format(
      "cam0={0}\ncam1={0}\ndoffs=0\nbaseline={1}\nwidth={2}\nheight={3}\nndisp={4}\nisint=0\nvmin={5}\n"
      "vmax={6}\ndyavg=0\ndymax=0\n",
      matrix, kMm * rig.baseline_m, camera.width_px, camera.height_px, to + 1, from, to);
}

}  // namespace stereobench::harness
