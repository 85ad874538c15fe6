#include "vision/colour/circle_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "vision/tuning/round_patch.h"

namespace stereobench::vision {
namespace {

constexpr int kSpokes = 96;  // rays once around
constexpr int kRings = 9;    // radii on either side of the circle's own at which steps are compared

/// Steps in the picture from inside to outside along one spoke, at radii around a circle's.
using Steps = std::array<Eigen::Vector3d, 2 * kRings + 1>;

Eigen::Vector2d direction_of(int spoke) {
  const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * spoke / kSpokes);
  return {c, s};
}

/// @return empty where the spoke leaves the picture
std::optional<Steps> steps_along(const cv::Mat& image, const Circle& circle, int spoke) {
  const Eigen::Vector2d direction = direction_of(spoke);
  const double apart_px = std::max(1.0, 0.05 * circle.radius_px);
  const double half_px = std::max(1.5, 0.05 * circle.radius_px);
  const auto at = [&](double radius_px) {
    return colour_at(image, circle.centre_px + std::max(radius_px, 0.0) * direction);
  };
  Steps steps;
  for (int ring = -kRings; ring <= kRings; ++ring) {
    const double radius_px = circle.radius_px + ring * apart_px;
    const auto inside = at(radius_px - half_px), outside = at(radius_px + half_px);
    if (!inside || !outside) return std::nullopt;
    steps[static_cast<std::size_t>(ring + kRings)] = *outside - *inside;
  }
  return steps;
}

/// Whether the picture, along a spoke and those beside it, has a step at the circle that stands out.
bool ends_at_circle(const std::vector<std::optional<Steps>>& steps, int spoke) {
  Steps sums;
  sums.fill(Eigen::Vector3d::Zero());
  int count = 0;
  for (int beside = -kCover.beside; beside <= kCover.beside; ++beside) {
    const auto& along = steps[static_cast<std::size_t>((spoke + beside + kSpokes) % kSpokes)];
    if (!along) continue;
    ++count;
    for (std::size_t ring = 0; ring < sums.size(); ++ring) sums[ring] += (*along)[ring];
  }
  double own = 0.0, others = 0.0;
  int other_count = 0;
  for (int ring = -kRings; ring <= kRings; ++ring) {
    const double size = sums[static_cast<std::size_t>(ring + kRings)].norm();
    if (std::abs(ring) <= kCover.own) own = std::max(own, size);
    if (std::abs(ring) <= kCover.first_ring) continue;
    others += size * size;
    ++other_count;
  }
  return own >= kCover.least_step_levels * count &&
         own >= kCover.stands_out * std::sqrt(others / other_count);
}

/// How far out along a spoke the thing's own colour is seen, of the radius; empty outside of the picture.
std::optional<double> reach_of(const cv::Mat& image, const Circle& circle, int colour,
                               const ColourTable& table, int spoke) {
  const Eigen::Vector2d direction = direction_of(spoke);
  if (!colour_at(image, circle.centre_px + circle.radius_px * direction)) return std::nullopt;
  double reach_px = circle.radius_px;
  for (; reach_px > 0.0; reach_px -= kCover.step_px) {
    const auto sample = colour_at(image, circle.centre_px + reach_px * direction);
    if (sample && class_of(table, *sample) == colour) break;
  }
  return std::max(0.0, reach_px) / circle.radius_px;
}

/// What a ray from the centre shows.
struct Spoke {
  std::optional<double>
      reach;  ///< of the radius: where the thing's own colour ends; empty outside of the picture
  bool in_question = false;     ///< whether that is deep inside
  bool ends_at_circle = false;  ///< whether the picture has a step at the circle
};

std::vector<Spoke> spokes_of(const cv::Mat& image, const Circle& circle, int colour,
                             const ColourTable& table) {
  std::vector<Spoke> spokes(kSpokes);
  for (int i = 0; i < kSpokes; ++i) {
    Spoke& spoke = spokes[static_cast<std::size_t>(i)];
    spoke.reach = reach_of(image, circle, colour, table, i);
    spoke.in_question = spoke.reach && *spoke.reach < kCover.reach;
  }
  return spokes;
}

/// Looks for steps at the circle along the rays in question.
void answer(std::vector<Spoke>& spokes, const cv::Mat& image, const Circle& circle) {
  std::vector<std::optional<Steps>> steps;
  for (int i = 0; i < kSpokes; ++i) steps.push_back(steps_along(image, circle, i));
  for (int i = 0; i < kSpokes; ++i) {
    Spoke& spoke = spokes[static_cast<std::size_t>(i)];
    spoke.ends_at_circle = spoke.in_question && ends_at_circle(steps, i);
  }
}

}  // namespace

std::optional<Eigen::Vector3d> colour_at(const cv::Mat& image, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(std::floor(at.x()));
  const int y = static_cast<int>(std::floor(at.y()));
  if (x < 0 || y < 0 || x + 1 >= image.cols || y + 1 >= image.rows) return std::nullopt;
  const double right = at.x() - x;
  const double down = at.y() - y;
  const auto pixel = [&](int row, int column) {
    const cv::Vec3b& bgr = image.at<cv::Vec3b>(row, column);
    return Eigen::Vector3d(bgr[0], bgr[1], bgr[2]);
  };
  return (1.0 - down) * ((1.0 - right) * pixel(y, x) + right * pixel(y, x + 1)) +
         down * ((1.0 - right) * pixel(y + 1, x) + right * pixel(y + 1, x + 1));
}

std::uint8_t class_of(const ColourTable& table, const Eigen::Vector3d& bgr) {
  return table.classify(cv::saturate_cast<std::uint8_t>(bgr[0]), cv::saturate_cast<std::uint8_t>(bgr[1]),
                        cv::saturate_cast<std::uint8_t>(bgr[2]));
}

double hidden_share(const cv::Mat& image, const Circle& circle, int colour, const ColourTable& table) {
  std::vector<Spoke> spokes = spokes_of(image, circle, colour, table);
  const auto in_picture =
      std::ranges::count_if(spokes, [](const Spoke& spoke) { return spoke.reach.has_value(); });
  if (in_picture == 0) return 1.0;
  if (std::ranges::any_of(spokes, &Spoke::in_question)) answer(spokes, image, circle);
  double hidden = 0.0;
  for (const Spoke& spoke : spokes)
    if (spoke.in_question && !spoke.ends_at_circle) hidden += 1.0 - *spoke.reach * *spoke.reach;
  return hidden / static_cast<double>(in_picture);
}

double outside_share(const cv::Mat& image, const Circle& circle) {
  constexpr int kCircles = 24;
  constexpr int kAngles = 48;
  int outside = 0;
  for (int ring = 0; ring < kCircles; ++ring) {
    const double radius = circle.radius_px * std::sqrt((ring + 0.5) / kCircles);  // rings of equal area
    for (int spoke = 0; spoke < kAngles; ++spoke) {
      const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * spoke / kAngles);
      const Eigen::Vector2d at = circle.centre_px + radius * Eigen::Vector2d(c, s);
      const bool is_inside =
          at.x() >= -0.5 && at.y() >= -0.5 && at.x() <= image.cols - 0.5 && at.y() <= image.rows - 0.5;
      outside += is_inside ? 0 : 1;
    }
  }
  return static_cast<double>(outside) / (kCircles * kAngles);
}

}  // namespace stereobench::vision
