#include <map>

#include <fmt/format.h>

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

std::string text(const cv::Rect& box) {
  return fmt::format("[{}, {}, {}, {}]", box.x, box.y, box.width, box.height);
}

/// What is wrong with the line of one ball; empty where nothing is.
std::string wrong_with(const ViewBallTruth& said, const SeenBall& seen) {
  if (seen.pixels == 0 && (!said.bbox_visib.empty() || said.px_count_visib != 0))
    return fmt::format("ball {}: box {} and {} pixels of a hidden ball: no pixel of the identities shows it",
                       said.ball, text(said.bbox_visib), said.px_count_visib);
  if (said.px_count_visib != seen.pixels)
    return fmt::format("ball {}: px_count_visib is {}, and the identities show it in {} pixels", said.ball,
                       said.px_count_visib, seen.pixels);
  if (seen.pixels > 0 && said.bbox_visib != seen.box)
    return fmt::format("ball {}: bbox_visib is {}, and that of the identities {}", said.ball,
                       text(said.bbox_visib), text(seen.box));
  return {};
}

}  // namespace

std::vector<Fault> check_boxes(const DatasetView& view, const LoadedFrame& loaded) {
  std::vector<Fault> faults;
  const ViewFrame& frame = view.frames[loaded.index];
  for (std::size_t side = 0; side < 2; ++side) {
    const cv::Mat& ids = loaded.ball_id[side];
    if (!frame.balls[side] || ids.empty()) continue;
    std::map<int, SeenBall> seen = seen_balls(ids);
    for (const ViewBallTruth& said : frame.balls[side]->balls) {
      const std::string wrong = wrong_with(said, seen[said.ball]);
      if (!wrong.empty()) faults.push_back({frame.balls[side]->file, frame.name, wrong});
      seen.erase(said.ball);
    }
    for (const auto& [ball, pixels] : seen)
      faults.push_back(
          {frame.balls[side]->file, frame.name,
           fmt::format("ball {}: no line, and the identities show it in {} pixels", ball, pixels.pixels)});
  }
  return faults;
}

}  // namespace stereobench::harness
