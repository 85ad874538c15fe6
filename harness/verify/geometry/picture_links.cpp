#include "harness/verify/geometry/corner_match.h"
#include "harness/verify/geometry/frame_links.h"

namespace stereobench::harness {
namespace {

using Eigen::Vector2d;
using vision::Side;

/// What a corner is usually found off, px.
constexpr double kUsual_px = 0.25;

/// Corners of the left picture in the right one, against depth or disparity; without them, their rows.
/// @return where it was found
std::optional<Vector2d> add_stereo(const Neighbourhood& frames, const cv::Mat& left, const cv::Mat& right,
                                   Link link, std::vector<Link>& links) {
  constexpr int kAcross = 3, kDown = 16;
  const cv::Size reach(left.cols / kAcross, left.rows / kDown);
  const cv::Point corner(static_cast<int>(link.from_px.x()), static_cast<int>(link.from_px.y()));
  const auto found = found_in(left, corner, right, reach);
  if (!found) return std::nullopt;
  link.to = link.from;
  link.to_side = Side::kRight;
  link.to_px = *found;
  const bool is_known = link.depth_m[kNow] || link.mate_px[kNow];
  link.kind = is_known ? LinkKind::kStereoPictures : LinkKind::kEpipolar;
  Link at_found;
  set_source({nullptr, frames.now, nullptr}, Side::kLeft, *found, at_found);
  link.found_depth_m = at_found.depth_m[kNow];
  link.found_mate_px = at_found.mate_px[kNow];
  if (!is_known) link.mate_px[kNow] = *found, link.mate_is_measured = true;
  links.push_back(link);
  return found;
}

}  // namespace

void add_picture_links(const DatasetView& view, const Neighbourhood& frames, std::size_t most,
                       std::vector<Link>& links) {
  const LoadedFrame& now = *frames.now;
  if (now.picture[0].empty()) return;
  const cv::Mat left = grey_levels(now.picture[0]);
  const bool is_pair = !now.picture[1].empty();
  const bool goes_on =
      frames.after != nullptr && view.frames[now.index].drive_goes_on && !frames.after->picture[0].empty() &&
      frames.after->picture[0].size() == now.picture[0].size() && view.frames[now.index].world_from_body[0] &&
      view.frames[frames.after->index].world_from_body[0];
  const cv::Mat right = is_pair ? grey_levels(now.picture[1]) : cv::Mat();
  const cv::Mat next = goes_on ? grey_levels(frames.after->picture[0]) : cv::Mat();
  constexpr int kAcross = 4, kDown = 6;
  const cv::Size reach(left.cols / kAcross, left.rows / kDown);
  for (const cv::Point& corner : corners_in(left, most)) {
    Link link = {.from = now.index, .to = now.index, .from_px = {corner.x, corner.y}};
    link.tolerance_px = kUsual_px;
    set_source(frames, Side::kLeft, link.from_px, link);
    const bool has_depth = link.depth_m[kNow] || link.mate_px[kNow];
    const auto mate_px = is_pair ? add_stereo(frames, left, right, link, links) : std::nullopt;
    if (!goes_on || !(has_depth || mate_px)) continue;
    const auto found = found_in(left, corner, next, reach);
    if (!found) continue;
    link.kind = LinkKind::kNextPictures;
    link.to = frames.after->index;
    link.to_px = *found;
    if (!has_depth) link.mate_px[kNow] = mate_px, link.mate_is_measured = true;
    links.push_back(link);
  }
}

}  // namespace stereobench::harness
