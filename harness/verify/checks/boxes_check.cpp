#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/verify/checks/checks.h"

namespace stereobench::harness {
namespace {

struct SeenBall {
  cv::Rect box;
  std::int64_t pixels = 0;
};

/// What a picture of identities shows of each ball.
std::map<int, SeenBall> seen_balls(const cv::Mat& ids) {
  std::map<int, SeenBall> seen;
  for (int v = 0; v < ids.rows; ++v)
    for (int u = 0; u < ids.cols; ++u)
      if (const int id = ids.at<std::uint8_t>(v, u); id != 0) {
        SeenBall& ball = seen[id - 1];
        ball.box = ball.pixels == 0 ? cv::Rect(u, v, 1, 1) : ball.box | cv::Rect(u, v, 1, 1);
        ++ball.pixels;
      }
  return seen;
}

/// What a mask shows of its ball.
SeenBall seen_in(const cv::Mat& mask) {
  return {cv::boundingRect(mask), cv::countNonZero(mask)};
}

/// Whether the sides of two boxes are at most so far apart.
bool is_same_box(const cv::Rect& one, const cv::Rect& other, int slack_px) {
  const cv::Point first = one.tl() - other.tl(), last = one.br() - other.br();
  return std::max({std::abs(first.x), std::abs(first.y), std::abs(last.x), std::abs(last.y)}) <= slack_px;
}

std::string text(const cv::Rect& box) {
  return fmt::format("[{}, {}, {}, {}]", box.x, box.y, box.width, box.height);
}

/// What is wrong with what a file says of one ball's visible pixels; empty where nothing is.
/// @param shown "no pixel of the identities", "the identities": where the pixels are from
std::string wrong_with(const ViewBallTruth& said, const SeenBall& seen, const char* shown, Margins& margins) {
  if (seen.pixels == 0 && (!said.bbox_visib.empty() || said.px_count_visib != 0))
    return fmt::format("ball {}: box {} and {} pixels of a hidden ball: no pixel of the {} shows it",
                       said.ball, text(said.bbox_visib), said.px_count_visib, shown);
  if (said.px_count_visib != seen.pixels)
    return fmt::format("ball {}: px_count_visib is {}, and the {} shows it in {} pixels", said.ball,
                       said.px_count_visib, shown, seen.pixels);
  if (seen.pixels > 0 && !is_same_box(said.bbox_visib, seen.box, said.box_slack_px))
    return fmt::format("ball {}: bbox_visib is {}, and that of the {} {}", said.ball, text(said.bbox_visib),
                       shown, text(seen.box));
  const double share = said.px_count_all > 0
                           ? static_cast<double>(said.px_count_visib) / static_cast<double>(said.px_count_all)
                           : 0.0;
  constexpr double kRounding = 1e-3;
  if (said.visib_fract && margins.is_beyond("visib_fract", std::abs(*said.visib_fract - share), kRounding))
    return fmt::format("ball {}: visib_fract is {:.6g}, and px_count_visib / px_count_all {:.6g}", said.ball,
                       *said.visib_fract, share);
  return {};
}

/// A mask's pixels; what cannot be read is a fault.
std::optional<cv::Mat> pixels_of(const ViewMask& mask, const cv::Size& size, const std::string& frame,
                                 std::vector<Fault>& faults) {
  try {
    cv::Mat pixels = mask.read();
    if (size.empty() || pixels.size() == size) return pixels;
    faults.push_back({mask.file, frame,
                      fmt::format("expected {} x {} pixels (got {} x {})", size.width, size.height,
                                  pixels.cols, pixels.rows)});
  } catch (const std::runtime_error& error) {
    faults.push_back({mask.file, frame, error.what()});
  }
  return std::nullopt;
}

/// What a mask of the whole ball says, against the numbers and the visible mask.
std::string wrong_with_whole(const ViewBallTruth& said, const cv::Mat& visible, const cv::Mat& whole) {
  const int outside = visible.empty() ? 0 : cv::countNonZero(visible & (whole == 0));
  if (outside > 0)
    return fmt::format("ball {}: {} pixels of its visible mask are outside of its whole mask", said.ball,
                       outside);
  const SeenBall seen = seen_in(whole);
  if (seen.pixels > said.px_count_all)
    return fmt::format("ball {}: px_count_all is {}, and the whole mask has {} pixels", said.ball,
                       said.px_count_all, seen.pixels);
  // The mask ends where the picture does, and the box does not.
  const bool is_cut = (said.bbox_obj & cv::Rect({}, whole.size())) != said.bbox_obj;
  const bool is_as_said = is_cut ? (said.bbox_obj & seen.box) == seen.box
                                 : is_same_box(said.bbox_obj, seen.box, said.box_slack_px);
  if (!said.bbox_obj.empty() && seen.pixels > 0 && !is_as_said)
    return fmt::format("ball {}: bbox_obj is {}, and that of the whole mask {}", said.ball,
                       text(said.bbox_obj), text(seen.box));
  return {};
}

/// One ball that has masks of its own.
void check_masks(const ViewBallTruth& said, const cv::Size& size, const BallsFile& file,
                 const std::string& frame, Margins& margins, std::vector<Fault>& faults) {
  std::optional<cv::Mat> visible, whole;
  if (said.visible_mask) visible = pixels_of(*said.visible_mask, size, frame, faults);
  if (said.whole_mask) whole = pixels_of(*said.whole_mask, visible ? visible->size() : size, frame, faults);
  std::string wrong;
  if (visible) wrong = wrong_with(said, seen_in(*visible), "mask", margins);
  if (whole && wrong.empty()) wrong = wrong_with_whole(said, visible.value_or(cv::Mat()), *whole);
  if (!wrong.empty()) faults.push_back({file.file, frame, wrong});
}

void check_identities(const ViewFrame& frame, const BallsFile& file, const cv::Mat& ids, Margins& margins,
                      std::vector<Fault>& faults) {
  std::map<int, SeenBall> seen = seen_balls(ids);
  for (const ViewBallTruth& said : file.balls) {
    const std::string wrong = wrong_with(said, seen[said.ball], "picture of identities", margins);
    if (!wrong.empty()) faults.push_back({file.file, frame.name, wrong});
    seen.erase(said.ball);
  }
  for (const auto& [ball, pixels] : seen)
    faults.push_back({file.file, frame.name,
                      fmt::format("ball {}: no line, and the picture of identities shows it in {} pixels",
                                  ball, pixels.pixels)});
}

}  // namespace

std::vector<Fault> check_boxes(const DatasetView& view, const LoadedFrame& loaded, Margins& margins) {
  std::vector<Fault> faults;
  const ViewFrame& frame = view.frames[loaded.index];
  for (std::size_t side = 0; side < 2; ++side) {
    if (!frame.balls[side]) continue;
    const BallsFile& file = *frame.balls[side];
    bool has_masks = false;
    for (const ViewBallTruth& said : file.balls) {
      if (!said.visible_mask && !said.whole_mask) continue;
      has_masks = true;
      check_masks(said, loaded.picture[side].size(), file, frame.name, margins, faults);
    }
    if (!has_masks && !loaded.ball_id[side].empty())
      check_identities(frame, file, loaded.ball_id[side], margins, faults);
  }
  return faults;
}

}  // namespace stereobench::harness
