#include "harness/run/shutter.h"

#include "worlds/path.h"

namespace stereobench::harness {

renderer::StereoFrame open_shutter(renderer::Renderer& renderer, const worlds::GroundTruth& path,
                                   std::size_t index, const worlds::Shutter& shutter) {
  const auto frame_at = [&](double offset_s) {
    return renderer.render(worlds::pose_near(path, index, offset_s),
                           worlds::pose_near(path, index, offset_s + shutter.right_delay_s));
  };
  renderer::StereoFrame frame = frame_at(0.0);
  if (shutter.open_s == 0.0) return frame;
  cv::Mat left = cv::Mat::zeros(frame.left.colour.size(), CV_32SC3);
  cv::Mat right = left.clone();
  for (int i = 0; i < shutter.samples; ++i) {
    const double share = (i + 0.5) / shutter.samples - 0.5;
    const renderer::StereoFrame instant = frame_at(share * shutter.open_s);
    cv::add(left, instant.left.colour, left, cv::noArray(), CV_32S);
    cv::add(right, instant.right.colour, right, cv::noArray(), CV_32S);
  }
  left.convertTo(frame.left.colour, CV_8U, 1.0 / shutter.samples);
  right.convertTo(frame.right.colour, CV_8U, 1.0 / shutter.samples);
  return frame;
}

}  // namespace stereobench::harness
