#include <cmath>

#include <fmt/format.h>

#include "harness/verify/checks/checks.h"

namespace stereobench::harness {
namespace {

using vision::Side;

constexpr std::array kSides = {Side::kLeft, Side::kRight};

/// A channel that was read, as messages name it.
struct Read {
  Channel channel;
  const cv::Mat& picture;
};

/// NaN, and numbers that nothing has: depths that are not ahead.
std::string bad_number(const Read& read) {
  const cv::Mat& picture = read.picture;
  if (picture.depth() != CV_32F) return {};
  const bool is_depth = read.channel == Channel::kDepth;
  const int channels = picture.channels();
  for (int v = 0; v < picture.rows; ++v) {
    const auto* row = picture.ptr<float>(v);
    for (int i = 0; i < picture.cols * channels; ++i) {
      if (std::isnan(row[i])) return fmt::format("NaN at column {}, row {}", i / channels, v);
      if (is_depth && row[i] <= 0.0F)
        return fmt::format("depth {} m at column {}, row {}: expected more than 0", row[i], i / channels, v);
    }
  }
  return {};
}

}  // namespace

std::vector<Fault> check_pictures(const DatasetView& view, const LoadedFrame& loaded) {
  std::vector<Fault> faults;
  const ViewFrame& frame = view.frames[loaded.index];
  for (const Side side : kSides) {
    const std::size_t i = index_of(side);
    const vision::Intrinsics& camera = frame.cameras[i].pinhole;
    for (const Read& read :
         {Read{Channel::kPicture, loaded.picture[i]}, Read{Channel::kDisparity, loaded.disparity_px[i]},
          Read{Channel::kDepth, loaded.depth_m[i]}, Read{Channel::kFlow, loaded.flow_px[i]},
          Read{Channel::kNextPicture, loaded.next_picture[i]}, Read{Channel::kBallId, loaded.ball_id[i]}}) {
      if (read.picture.empty()) continue;
      const std::string& file = find_channel(frame, side, read.channel)->file;
      const cv::Size size =
          camera.width_px > 0 ? cv::Size(camera.width_px, camera.height_px) : loaded.picture[0].size();
      if (read.picture.size() != size)
        faults.push_back({file, frame.name,
                          fmt::format("expected {} x {} pixels (got {} x {})", size.width, size.height,
                                      read.picture.cols, read.picture.rows)});
      if (const std::string bad = bad_number(read); !bad.empty()) faults.push_back({file, frame.name, bad});
    }
  }
  return faults;
}

std::vector<Fault> check_range(const DatasetView& view, const LoadedFrame& loaded, const cv::Mat& range_m,
                               Side side, Margins& margins) {
  const ViewFrame& frame = view.frames[loaded.index];
  const cv::Mat& depth_m = loaded.depth_m[index_of(side)];
  if (depth_m.empty() || depth_m.size() != range_m.size()) return {};
  constexpr int kStride = 7;
  constexpr double kFloat = 1e-5;
  std::size_t off = 0, all = 0;
  for (int v = 0; v < range_m.rows; v += kStride)
    for (int u = 0; u < range_m.cols; u += kStride) {
      const double range = range_m.at<float>(v, u), depth = depth_m.at<float>(v, u);
      const auto ray = ray_of(frame.cameras[index_of(side)], {u, v});
      if (!std::isfinite(range) || !std::isfinite(depth) || !ray) continue;
      ++all;
      const double share = kFloat + depth_beside(frame.cameras[index_of(side)], depth_m, {u, v});
      if (margins.is_beyond("range against depth", std::abs(depth * ray->norm() - range), share * range))
        ++off;
    }
  if (2 * off <= all) return {};
  return {
      {find_channel(frame, side, Channel::kRange)->file, frame.name,
       fmt::format("range and depth disagree at {} of {} pixels: range is along the ray, depth is planar Z",
                   off, all)}};
}

}  // namespace stereobench::harness
