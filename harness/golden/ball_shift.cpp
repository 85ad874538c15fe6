#include "harness/golden/ball_shift.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "renderer/surfaces/primitives.h"

namespace stereobench::harness {
namespace {

constexpr double kSmoothing_px = 1.0;  // enough for edges that are a pixel wide to be sampled well
constexpr int kKernelRadius_px = 4;
constexpr int kFewestPixels =
    30;  // of a radius of 3 px; smaller balls are known to a tenth of a pixel at best

/// Both pictures' mean, its gradient, and their difference, smoothed by a Gaussian. All CV_32FC3.
struct SmoothPair {
  cv::Mat mean, along_x, along_y, difference;
};

/// A Gaussian, or its derivative, as a row of taps.
cv::Mat taps(bool is_derivative) {
  cv::Mat gaussian = cv::getGaussianKernel(2 * kKernelRadius_px + 1, kSmoothing_px, CV_64F).t();
  if (is_derivative)  // what is correlated with it: x / sd^2 times the Gaussian
    for (int i = 0; i < gaussian.cols; ++i)
      gaussian.at<double>(0, i) *= (i - kKernelRadius_px) / (kSmoothing_px * kSmoothing_px);
  return gaussian;
}

SmoothPair smooth(const cv::Mat& before, const cv::Mat& after) {
  cv::Mat a, b;
  before.convertTo(a, CV_32F);
  after.convertTo(b, CV_32F);
  const cv::Mat mean = 0.5 * (a + b), difference = b - a;
  const cv::Mat flat = taps(false), slope = taps(true);
  SmoothPair pair;
  cv::sepFilter2D(mean, pair.mean, CV_32F, flat, flat, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(mean, pair.along_x, CV_32F, slope, flat, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(mean, pair.along_y, CV_32F, flat, slope, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(difference, pair.difference, CV_32F, flat, flat, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  return pair;
}

/// The shift that explains the differences of pixels best, with light that may have become brighter by a
/// factor: least squares of difference = factor mean - gradient . shift.
/// @return none where the pixels are of one colour
std::optional<Eigen::Vector2d> shift_of_colours(const SmoothPair& pair, const cv::Mat& mask) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d evidence = Eigen::Vector3d::Zero();
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask.at<std::uint8_t>(v, u) == 0) continue;
      for (int channel = 0; channel < 3; ++channel) {
        const auto at = [&](const cv::Mat& picture) {
          return static_cast<double>(picture.at<cv::Vec3f>(v, u)[channel]);
        };
        const Eigen::Vector3d by(-at(pair.along_x), -at(pair.along_y), at(pair.mean));
        information += by * by.transpose();
        evidence += by * at(pair.difference);
      }
    }
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(information);
  if (!solver.isInvertible()) return {};
  return Eigen::Vector2d(solver.solve(evidence).head<2>());
}

Eigen::Vector2d centre_of(const cv::Mat& mask) {
  const cv::Moments moments = cv::moments(mask, true);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

/// Where a ball is or was, and two pixels around it.
cv::Mat around(const cv::Mat& one, const cv::Mat& other) {
  cv::Mat mask;
  cv::dilate(one | other, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  return mask;
}

Eigen::Vector2d shift_of(const SmoothPair& pair, const cv::Mat& before, const cv::Mat& after) {
  const Eigen::Vector2d by_identities = centre_of(after) - centre_of(before);
  if (by_identities.norm() >= 1.0) return by_identities;
  return shift_of_colours(pair, around(before, after)).value_or(by_identities);
}

}  // namespace

std::vector<BallShift> ball_shifts(const GoldenPicture& before, const GoldenPicture& after) {
  double last = 0.0;
  cv::minMaxLoc(before.shown, nullptr, &last, nullptr, nullptr, before.shown < renderer::kFloorPrimitive);
  const SmoothPair pair = smooth(before.colour, after.colour);
  std::vector<BallShift> shifts;
  for (int ball = 0; ball < static_cast<int>(last); ++ball) {
    const cv::Mat was = before.shown == ball + 1, is = after.shown == ball + 1;
    if (std::min(cv::countNonZero(was), cv::countNonZero(is)) < kFewestPixels) continue;
    const Eigen::Vector2d shift_px = shift_of(pair, was, is);
    if (!shift_px.isZero(0.0)) shifts.push_back({ball, shift_px});
  }
  std::ranges::stable_sort(shifts, std::greater{}, [](const BallShift& s) { return s.shift_px.norm(); });
  return shifts;
}

}  // namespace stereobench::harness
