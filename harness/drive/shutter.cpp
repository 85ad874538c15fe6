#include "harness/drive/shutter.h"

#include <algorithm>
#include <cmath>

#include "harness/drive/picture_motion.h"
#include "slam/math/random.h"
#include "worlds/drive/path.h"

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

void append(const renderer::RenderedImage& rows, renderer::RenderedImage& picture) {
  picture.colour.push_back(rows.colour);
  picture.ball_id.push_back(rows.ball_id);
  picture.depth_m.push_back(rows.depth_m);
}

/// The picture whose middle row looks at an offset from the step's time.
renderer::StereoFrame rolled(const Step& step, double offset_s) {
  const std::vector<RowBand> bands = row_bands(step.shutter, step.height_px);
  if (bands.size() == 1) return step.seen(offset_s, cv::Range::all());
  renderer::StereoFrame frame;
  for (const RowBand& band : bands) {
    const renderer::StereoFrame rows = step.seen(offset_s + band.offset_s, band.rows);
    append(rows.left, frame.left);
    append(rows.right, frame.right);
  }
  return frame;
}

/// How many instants a blur is the average of.
/// @param way_px the longest way of a point
int blur_samples(const worlds::Shutter& shutter, double way_px) {
  const int most = std::max(shutter.samples, shutter.most_samples);
  return std::max(shutter.samples, static_cast<int>(std::min<double>(most, std::ceil(way_px))));
}

}  // namespace

std::vector<RowBand> row_bands(const worlds::Shutter& shutter, int height_px) {
  if (shutter.readout_s == 0.0) return {{cv::Range(0, height_px), 0.0}};
  std::vector<RowBand> bands;
  for (int first = 0; first < height_px; first += kRowsAtOnce) {
    const cv::Range rows(first, std::min(first + kRowsAtOnce, height_px));
    const double share = (0.5 * (rows.start + rows.end) - 0.5 * height_px) / height_px;
    bands.push_back({rows, share * shutter.readout_s});
  }
  return bands;
}

std::optional<double> lateness_s(const worlds::Shutter& shutter, std::uint64_t seed, std::size_t step) {
  slam::RandomStream chance(seed, slam::Stream::kFrameLoss, step);
  if (chance.uniform() < shutter.drop_probability) return std::nullopt;
  return chance.uniform() < shutter.late_probability ? shutter.late_s : 0.0;
}

ExposedFrame open_shutter(renderer::Renderer& renderer, const worlds::GroundTruth& path, std::size_t index,
                          const worlds::Shutter& shutter, double late_s) {
  const Step step = {renderer, path, index, shutter, renderer.height_px()};
  renderer::StereoFrame frame = rolled(step, late_s);
  if (shutter.open_s == 0.0) return {frame};
  const double way_px =
      longest_way_px(frame, renderer.rig(), {path, index, late_s, shutter.open_s, shutter.right_delay_s});
  const int samples = blur_samples(shutter, way_px);
  cv::Mat left = cv::Mat::zeros(frame.left.colour.size(), CV_32SC3);
  cv::Mat right = left.clone();
  for (int i = 0; i < samples; ++i) {
    const double share = (i + 0.5) / samples - 0.5;
    const renderer::StereoFrame instant = rolled(step, late_s + share * shutter.open_s);
    cv::add(left, instant.left.colour, left, cv::noArray(), CV_32S);
    cv::add(right, instant.right.colour, right, cv::noArray(), CV_32S);
  }
  const int depth = frame.left.colour.depth();
  left.convertTo(frame.left.colour, depth, 1.0 / samples);
  right.convertTo(frame.right.colour, depth, 1.0 / samples);
  return {frame, way_px / samples};
}

}  // namespace stereobench::harness
