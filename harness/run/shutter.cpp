#include "harness/run/shutter.h"

#include "worlds/path.h"

namespace stereobench::harness {

renderer::StereoFrame open_shutter(renderer::Renderer& renderer, const worlds::GroundTruth& path,
                                   std::size_t index, const worlds::CameraSensor& camera) {
  const auto frame_at = [&](double offset_s) {
    return renderer.render(worlds::pose_near(path, index, offset_s),
                           worlds::pose_near(path, index, offset_s + camera.right_delay_s));
  };
  renderer::StereoFrame frame = frame_at(0.0);
  if (camera.shutter_s == 0.0) return frame;
  cv::Mat left = cv::Mat::zeros(frame.left.colour.size(), CV_32SC3);
  cv::Mat right = left.clone();
  for (int i = 0; i < camera.shutter_samples; ++i) {
    const double share = (i + 0.5) / camera.shutter_samples - 0.5;
    const renderer::StereoFrame instant = frame_at(share * camera.shutter_s);
    cv::add(left, instant.left.colour, left, cv::noArray(), CV_32S);
    cv::add(right, instant.right.colour, right, cv::noArray(), CV_32S);
  }
  left.convertTo(frame.left.colour, CV_8U, 1.0 / camera.shutter_samples);
  right.convertTo(frame.right.colour, CV_8U, 1.0 / camera.shutter_samples);
  return frame;
}

}  // namespace stereobench::harness
