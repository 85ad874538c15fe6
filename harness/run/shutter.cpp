#include "harness/run/shutter.h"

#include <algorithm>

#include "worlds/path.h"

namespace stereobench::harness {
namespace {

constexpr int kRowsAtOnce = 4;  // rows that look at one instant

/// A step of a drive, seen around its time.
struct Step {
  renderer::Renderer& renderer;
  const worlds::GroundTruth& path;
  std::size_t index;
  const worlds::Shutter& shutter;
  int height_px;

  renderer::StereoFrame seen(double offset_s, const cv::Range& rows) const {
    return renderer.render(worlds::pose_near(path, index, offset_s),
                           worlds::pose_near(path, index, offset_s + shutter.right_delay_s), rows);
  }
};

void append(const renderer::EyeFrame& rows, renderer::EyeFrame& picture) {
  picture.colour.push_back(rows.colour);
  picture.ball_id.push_back(rows.ball_id);
  picture.depth_m.push_back(rows.depth_m);
}

/// The picture whose middle row looks at an offset from the step's time.
renderer::StereoFrame rolled(const Step& step, double offset_s) {
  const double readout_s = step.shutter.readout_s;
  if (readout_s == 0.0) return step.seen(offset_s, cv::Range::all());
  renderer::StereoFrame frame;
  const int height = step.height_px;
  for (int first = 0; first < height; first += kRowsAtOnce) {
    const cv::Range rows(first, std::min(first + kRowsAtOnce, height));
    const double share = (0.5 * (rows.start + rows.end) - 0.5 * height) / height;
    const renderer::StereoFrame band = step.seen(offset_s + share * readout_s, rows);
    append(band.left, frame.left);
    append(band.right, frame.right);
  }
  return frame;
}

}  // namespace

renderer::StereoFrame open_shutter(renderer::Renderer& renderer, const worlds::GroundTruth& path,
                                   std::size_t index, const worlds::Shutter& shutter, double late_s) {
  const Step step = {renderer, path, index, shutter, renderer.height_px()};
  renderer::StereoFrame frame = rolled(step, late_s);
  if (shutter.open_s == 0.0) return frame;
  cv::Mat left = cv::Mat::zeros(frame.left.colour.size(), CV_32SC3);
  cv::Mat right = left.clone();
  for (int i = 0; i < shutter.samples; ++i) {
    const double share = (i + 0.5) / shutter.samples - 0.5;
    const renderer::StereoFrame instant = rolled(step, late_s + share * shutter.open_s);
    cv::add(left, instant.left.colour, left, cv::noArray(), CV_32S);
    cv::add(right, instant.right.colour, right, cv::noArray(), CV_32S);
  }
  left.convertTo(frame.left.colour, CV_8U, 1.0 / shutter.samples);
  right.convertTo(frame.right.colour, CV_8U, 1.0 / shutter.samples);
  return frame;
}

}  // namespace stereobench::harness
