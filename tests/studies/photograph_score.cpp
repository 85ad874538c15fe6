#include "tests/studies/photograph_score.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "vision/observe.h"
#include "vision/tuning/outline_fit.h"

namespace stereobench {
namespace {

using photograph::Ball;
using photograph::Photograph;

constexpr std::size_t kMarkedPictures = 4;
constexpr double kMarked = 0.8;     // of a ball's radius
constexpr double kWhole = 0.95;     // of an outline, seen
constexpr double kPart = 0.85;      // of an outline; what shows less is hidden in part
constexpr double kLittle = 0.3;     // what shows less may be passed over
constexpr double kSamePlace = 0.2;  // of a radius
constexpr double kSameSize = 0.15;  // relative
constexpr double kNoise_levels = 2.0;
constexpr int kJpegBorder_px = 2;

bool is_inside(const Ball& ball, const cv::Mat& picture) {
  const double reach = ball.radius_px + kJpegBorder_px;
  return ball.centre_px.x() >= reach && ball.centre_px.y() >= reach &&
         ball.centre_px.x() <= picture.cols - 1 - reach && ball.centre_px.y() <= picture.rows - 1 - reach;
}

bool is_of(const vision::MeasuredOutline& outline, const Ball& ball) {
  return outline.colour == ball.colour &&
         (outline.centre_px - ball.centre_px).norm() < kSamePlace * ball.radius_px &&
         std::abs(outline.radius_px / ball.radius_px - 1.0) < kSameSize;
}

bool is_trusted(const vision::MeasuredOutline& outline) {
  return outline.outside_fraction <= vision::kOutlineFit.most_hidden &&
         outline.hidden_fraction <= vision::kOutlineFit.most_hidden;
}

void add_marked(const Photograph& photograph, std::vector<std::vector<Eigen::Vector3d>>& pixels) {
  const cv::Mat& levels = photograph.levels;
  for (const Ball& ball : photograph.balls) {
    if (ball.visible < kWhole || !is_inside(ball, levels)) continue;
    for (int row = 0; row < levels.rows; ++row)
      for (int column = 0; column < levels.cols; ++column) {
        if ((Eigen::Vector2d(column, row) - ball.centre_px).norm() > kMarked * ball.radius_px) continue;
        const cv::Vec3b& bgr = levels.at<cv::Vec3b>(row, column);
        pixels[static_cast<std::size_t>(ball.colour)].emplace_back(bgr[0], bgr[1], bgr[2]);
      }
  }
}

/// The four pictures from a seed on, if they may show all colours.
bool may_show_all(std::uint64_t first_seed) {
  std::set<int> colours;
  for (std::uint64_t seed = first_seed; seed < first_seed + kMarkedPictures; ++seed)
    for (const Ball& ball : photograph::scene_of(seed).balls) colours.insert(ball.colour);
  return colours.size() == photograph::kNames.size();
}

}  // namespace

void PhotographScore::add(const PhotographScore& other) {
  pictures += other.pictures;
  whole += other.whole;
  found += other.found;
  trusted += other.trusted;
  hidden += other.hidden;
  hidden_trusted += other.hidden_trusted;
  nothings += other.nothings;
  nothings_trusted += other.nothings_trusted;
  errors_px.insert(errors_px.end(), other.errors_px.begin(), other.errors_px.end());
}

std::vector<vision::LearnedColour> palette_of_four_photographs(std::uint64_t first_seed) {
  for (;; first_seed += kMarkedPictures) {
    if (!may_show_all(first_seed)) continue;
    std::vector<std::vector<Eigen::Vector3d>> pixels(photograph::kNames.size());
    for (std::uint64_t seed = first_seed; seed < first_seed + kMarkedPictures; ++seed)
      add_marked(photograph::take(seed), pixels);
    if (std::ranges::any_of(pixels, [](const auto& of_one) { return of_one.empty(); })) continue;
    std::vector<vision::LearnedColour> palette;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      palette.push_back(vision::learn_colour(photograph::kNames[i], pixels[i], vision::Levels::kSrgb));
    return palette;
  }
}

PhotographScore score_of(const Photograph& photograph, std::span<const vision::MeasuredOutline> found) {
  PhotographScore score{.pictures = 1};
  std::vector<bool> of_a_ball(found.size(), false);
  for (const Ball& ball : photograph.balls) {
    const bool inside = is_inside(ball, photograph.levels);
    const bool whole = inside && ball.visible >= kWhole;
    const bool hidden = ball.visible < kPart && ball.visible > kLittle;
    score.whole += whole ? 1 : 0;
    score.hidden += hidden ? 1 : 0;
    bool is_found = false;
    for (std::size_t i = 0; i < found.size(); ++i) {
      // What little is seen of a ball may be found or not, of whatever size.
      const bool on_it =
          (found[i].centre_px - ball.centre_px).norm() < ball.radius_px && !is_trusted(found[i]);
      if (on_it && ball.visible < kPart) of_a_ball[i] = true;
      if (!is_of(found[i], ball)) continue;
      of_a_ball[i] = true;
      if (std::exchange(is_found, true)) continue;
      score.found += whole ? 1 : 0;
      score.trusted += whole && is_trusted(found[i]) ? 1 : 0;
      score.hidden_trusted += hidden && is_trusted(found[i]) ? 1 : 0;
      if (whole && is_trusted(found[i]))
        score.errors_px.push_back((found[i].centre_px - ball.centre_px).norm());
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    score.nothings += of_a_ball[i] ? 0 : 1;
    score.nothings_trusted += !of_a_ball[i] && is_trusted(found[i]) ? 1 : 0;
  }
  return score;
}

std::vector<vision::MeasuredOutline> look_at(const cv::Mat& levels, const vision::ColourTable& learned) {
  const vision::Intrinsics camera{levels.cols, levels.rows, static_cast<double>(levels.cols),
                                  0.5 * (levels.cols - 1), 0.5 * (levels.rows - 1)};
  return vision::find_outlines(levels, camera, {.noise_sd_levels = kNoise_levels, .learned = &learned});
}

}  // namespace stereobench
