#include <algorithm>
#include <cmath>

#include "harness/verify/geometry/frame_links.h"

namespace stereobench::harness {
namespace {

using Eigen::Vector2d;
using vision::Side;

/// What values that we call exact may be off: matches behind a lens are worked out to 0.001 px, and a place
/// in a picture of some thousand pixels as 32-bit float to 0.0002 px.
constexpr double kExact_px = 0.002;

/// Pixels of a grid that covers a picture, about as many as asked for.
std::vector<cv::Point> grid(const cv::Size& size, std::size_t most) {
  const double step = std::max(1.0, std::sqrt(size.area() / static_cast<double>(most)));
  std::vector<cv::Point> points;
  for (double v = step / 2; v < size.height; v += step)
    for (double u = step / 2; u < size.width; u += step)
      points.emplace_back(static_cast<int>(u), static_cast<int>(v));
  return points;
}

double step_of(const ViewFrame& frame, Side side, Channel channel) {
  const ChannelFile* file = find_channel(frame, side, channel);
  return file == nullptr ? 0.0 : file->step;
}

/// The relative error of a link's depth: what rounding and lenses make of it.
double depth_error(const Neighbourhood& frames, const ViewFrame& frame, const Link& link) {
  if (const auto depth_m = link.depth_m[kNow]) {
    const std::size_t side = index_of(link.from_side);
    const cv::Point pixel(static_cast<int>(link.from_px.x()), static_cast<int>(link.from_px.y()));
    return 0.5 * step_of(frame, link.from_side, Channel::kDepth) / *depth_m +
           depth_beside(frame.cameras[side], frames.now->depth_m[side], pixel);
  }
  if (const auto mate_px = link.mate_px[kNow]) {
    const double disparity_px = std::max(1e-3, std::abs(link.from_px.x() - mate_px->x()));
    return 0.5 * step_of(frame, link.from_side, Channel::kDisparity) / disparity_px;
  }
  return 0.0;
}

/// What poses of so many decimals may be off in the picture.
double pose_error_px(const DatasetView& view, const ViewFrame& frame, const Link& link) {
  constexpr double kTwoPoses = 2.0, kNearest_m = 0.5;
  const double depth_m = std::max(kNearest_m, link.depth_m[kNow].value_or(1.0));
  return kTwoPoses * frame.cameras[0].pinhole.focal_px *
         (view.place_precision_m / depth_m + 2.0 * view.turn_precision);
}

/// A link from a pixel whose point a file knows. @return whether it does
bool begin(const Neighbourhood& frames, Side side, const cv::Point& pixel, Link& link) {
  link.from = link.to = frames.now->index;
  link.from_side = link.to_side = side;
  link.from_px = {pixel.x, pixel.y};
  set_source(frames, side, link.from_px, link);
  return link.depth_m[kNow] || link.mate_px[kNow];
}

void add_disparities(const DatasetView& view, const Neighbourhood& frames, Side side, std::size_t most,
                     std::vector<Link>& links) {
  const cv::Mat& disparity = frames.now->disparity_px[index_of(side)];
  if (disparity.empty() || frames.now->depth_m[index_of(side)].empty()) return;
  const ViewFrame& frame = view.frames[frames.now->index];
  const bool is_left = side == Side::kLeft;
  for (const cv::Point& pixel : grid(disparity.size(), most)) {
    Link link = {.kind = is_left ? LinkKind::kDisparityDepth : LinkKind::kRightDepth};
    const double px = disparity.at<float>(pixel);
    if (!std::isfinite(px) || !begin(frames, side, pixel, link) || !link.depth_m[kNow]) continue;
    link.to_side = is_left ? Side::kRight : Side::kLeft;
    link.to_px = {is_left ? pixel.x - px : pixel.x + px, pixel.y};
    link.tolerance_px = kExact_px + 0.5 * step_of(frame, side, Channel::kDisparity) +
                        std::abs(px) * depth_error(frames, frame, link);
    links.push_back(link);
  }
}

/// Whether what leads to the next frame can be held against poses.
bool leads_to_next(const DatasetView& view, const ViewFrame& frame, std::size_t index) {
  return frame.next_follows && frame.drive_goes_on && index + 1 < view.frames.size() &&
         frame.world_from_body[0] && view.frames[index + 1].world_from_body[0];
}

void add_flow(const DatasetView& view, const Neighbourhood& frames, Side side, std::size_t most,
              std::vector<Link>& links) {
  const cv::Mat& flow = frames.now->flow_px[index_of(side)];
  const ViewFrame& frame = view.frames[frames.now->index];
  if (flow.empty() || !leads_to_next(view, frame, frames.now->index)) return;
  for (const cv::Point& pixel : grid(flow.size(), most)) {
    Link link = {.kind = LinkKind::kFlow};
    const cv::Vec2f shift = flow.at<cv::Vec2f>(pixel);
    if (!std::isfinite(shift[0]) || !begin(frames, side, pixel, link)) continue;
    link.to = frames.now->index + 1;
    link.to_px = link.from_px + Vector2d(shift[0], shift[1]);
    link.tolerance_px = kExact_px + step_of(frame, side, Channel::kFlow) +
                        cv::norm(shift) * depth_error(frames, frame, link) + pose_error_px(view, frame, link);
    links.push_back(link);
  }
}

void add_next_disparity(const DatasetView& view, const Neighbourhood& frames, std::size_t most,
                        std::vector<Link>& links) {
  const cv::Mat& next = frames.now->next_disparity_px;
  const ViewFrame& frame = view.frames[frames.now->index];
  if (next.empty() || !leads_to_next(view, frame, frames.now->index)) return;
  for (const cv::Point& pixel : grid(next.size(), most)) {
    Link link = {.kind = LinkKind::kNextDisparity};
    const double px = next.at<float>(pixel);
    if (!std::isfinite(px) || !begin(frames, Side::kLeft, pixel, link)) continue;
    link.to = frames.now->index + 1;
    link.to_px = {px, 0.0};
    link.tolerance_px = kExact_px + 0.5 * step_of(frame, Side::kLeft, Channel::kNextDisparity) +
                        px * depth_error(frames, frame, link) + pose_error_px(view, frame, link);
    links.push_back(link);
  }
}

const ViewBallTruth* find_ball(const ViewFrame& frame, Side side, int ball) {
  const auto& file = frame.balls[index_of(side)];
  if (!file) return nullptr;
  const auto found = std::ranges::find(file->balls, ball, &ViewBallTruth::ball);
  return found == file->balls.end() ? nullptr : &*found;
}

void add_ball_surfaces(const DatasetView& view, const Neighbourhood& frames, Side side, std::size_t most,
                       std::vector<Link>& links) {
  const cv::Mat& ids = frames.now->ball_id[index_of(side)];
  if (ids.empty() || frames.now->depth_m[index_of(side)].empty() || view.rows_look_apart) return;
  const ViewFrame& frame = view.frames[frames.now->index];
  std::vector<cv::Point> pixels;
  cv::findNonZero(ids, pixels);
  const std::size_t stride = std::max<std::size_t>(1, pixels.size() / most);
  for (std::size_t i = 0; i < pixels.size(); i += stride) {
    Link link = {.kind = LinkKind::kBallSurface};
    const int ball = ids.at<std::uint8_t>(pixels[i]) - 1;
    if (ball >= static_cast<int>(view.balls.size()) || !begin(frames, side, pixels[i], link)) continue;
    link.ball = ball;
    if (!view.balls_have_places) {
      const ViewBallTruth* truth = find_ball(frame, side, ball);
      if (truth == nullptr || !(view.balls[static_cast<std::size_t>(ball)].radius_m > 0.0)) continue;
      link.from_m = truth->centre_in_camera_m;
    }
    link.tolerance_px = kExact_px + frame.cameras[0].pinhole.focal_px * depth_error(frames, frame, link) +
                        pose_error_px(view, frame, link);
    links.push_back(link);
  }
}

void add_ball_centres(const DatasetView& view, const Neighbourhood& frames, Side side, std::size_t most,
                      std::vector<Link>& links) {
  constexpr double kMostOfMean = 4.0;  // of the errors of points that were found in pictures
  const ViewFrame& frame = view.frames[frames.now->index];
  const auto& file = frame.balls[index_of(side)];
  if (!file || !view.balls_have_places) return;
  const std::size_t stride = std::max<std::size_t>(1, file->balls.size() / most);
  for (std::size_t i = 0; i < file->balls.size(); i += stride) {
    const ViewBallTruth& truth = file->balls[i];
    if (truth.ball < 0 || truth.ball >= static_cast<int>(view.balls.size())) continue;
    Link link = {.kind = LinkKind::kBallCentre, .from = frames.now->index, .to = frames.now->index};
    link.from_side = link.to_side = side;
    link.ball = truth.ball;
    link.to_px = truth.centre_px;
    link.tolerance_px = kExact_px + pose_error_px(view, frame, link) +
                        kMostOfMean * view.balls[static_cast<std::size_t>(truth.ball)].reprojection_px;
    links.push_back(link);
  }
}

/// Balls that two pictures say the places of, in each camera's frame.
using CommonPlaces = std::vector<std::array<const ViewBallTruth*, 2>>;

CommonPlaces common_places(const ViewFrame& from, Side from_side, const ViewFrame& to, Side to_side) {
  CommonPlaces common;
  if (from.balls[index_of(from_side)])
    for (const ViewBallTruth& truth : from.balls[index_of(from_side)]->balls)
      if (const ViewBallTruth* other = truth.ball < 0 ? nullptr : find_ball(to, to_side, truth.ball))
        common.push_back({&truth, other});
  return common;
}

/// How well two pictures agree on the distances between balls, which no pose changes: how well they know
/// places.
/// @return m; empty where balls seem to move, or there are not two
std::optional<double> error_of_places_m(const CommonPlaces& common) {
  constexpr double kStandsStill = 0.01;
  constexpr double kExact_m = 1e-6, kMeasured_m = 0.002;  // by people, or by fitting models to pictures
  double error_m = 0.0, farthest_m = 0.0;
  for (std::size_t i = 0; i < common.size(); ++i)
    for (std::size_t j = i + 1; j < common.size(); ++j) {
      const auto apart_m = [&](std::size_t end) {
        return (common[i][end]->centre_in_camera_m - common[j][end]->centre_in_camera_m).norm();
      };
      error_m = std::max(error_m, std::abs(apart_m(0) - apart_m(1)));
      farthest_m = std::max(farthest_m, apart_m(0));
    }
  if (!(farthest_m > 0.0) || error_m > kStandsStill * farthest_m) return std::nullopt;
  return error_m > kExact_m ? std::max(error_m, kMeasured_m) : error_m;
}

void add_ball_places(const DatasetView& view, std::size_t from, Side from_side, std::size_t to, Side to_side,
                     std::vector<Link>& links) {
  constexpr double kMostOfError = 3.0;
  const ViewFrame &here = view.frames[from], &there = view.frames[to];
  if (view.balls_have_places || !here.world_from_body[index_of(from_side)] ||
      !there.world_from_body[index_of(to_side)])
    return;
  const CommonPlaces common = common_places(here, from_side, there, to_side);
  const std::optional<double> error_m = error_of_places_m(common);
  if (!error_m) return;
  for (const auto& [one, other] : common) {
    Link link = {.kind = LinkKind::kBallPlace, .from = from, .to = to};
    link.from_side = from_side, link.to_side = to_side;
    link.ball = one->ball;
    link.from_m = one->centre_in_camera_m, link.to_m = other->centre_in_camera_m;
    const double z_m = other->centre_in_camera_m.z();
    if (!(z_m > 0.0)) continue;
    link.tolerance_px = kExact_px + pose_error_px(view, here, link) +
                        kMostOfError * *error_m * here.cameras[index_of(from_side)].pinhole.focal_px / z_m;
    links.push_back(link);
  }
}

std::optional<double> value_at(const cv::Mat& picture, const Vector2d& pixel_px) {
  const cv::Point pixel(static_cast<int>(std::lround(pixel_px.x())),
                        static_cast<int>(std::lround(pixel_px.y())));
  if (picture.empty() || !cv::Rect({}, picture.size()).contains(pixel)) return std::nullopt;
  const double value = picture.at<float>(pixel);
  return std::isfinite(value) && value != 0.0 ? std::optional(value) : std::nullopt;
}

}  // namespace

void set_source(const Neighbourhood& frames, Side side, const Vector2d& pixel_px, Link& link) {
  const std::array all = {frames.now, frames.before, frames.after};
  for (const std::size_t instant : {kNow, kBefore, kAfter}) {
    if (all[instant] == nullptr) continue;
    link.depth_m[instant] = value_at(all[instant]->depth_m[index_of(side)], pixel_px);
    const auto disparity_px = value_at(all[instant]->disparity_px[index_of(side)], pixel_px);
    if (!link.depth_m[instant] && disparity_px)
      link.mate_px[instant] = pixel_px - Vector2d(side == Side::kLeft ? *disparity_px : -*disparity_px, 0.0);
  }
}

void add_file_links(const DatasetView& view, const Neighbourhood& frames, std::size_t most,
                    std::vector<Link>& links) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    add_disparities(view, frames, side, most, links);
    add_flow(view, frames, side, most, links);
    add_ball_surfaces(view, frames, side, most, links);
    add_ball_centres(view, frames, side, most, links);
    const std::size_t now = frames.now->index;
    if (side == Side::kLeft) add_ball_places(view, now, side, now, Side::kRight, links);
    if (frames.after != nullptr && view.frames[now].drive_goes_on)
      add_ball_places(view, now, side, now + 1, side, links);
  }
  add_next_disparity(view, frames, most, links);
}

}  // namespace stereobench::harness
