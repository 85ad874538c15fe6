#include "vision/shading.h"

#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>

namespace stereobench::vision {
namespace {

constexpr double kShadeTolerance = 0.10;   // colour off the ball's line, relative to its brightness
constexpr double kMinShade_levels = 35.0;  // a ball in the deepest shade and its own noise has more
constexpr double kMostSamples = 1500.0;    // spread over the ball
constexpr std::size_t kFewestSamples = 24;
constexpr int kMostTurns = 12;
constexpr double kRidge = 1e-6;  // per sample: a lamp that nothing shows is none

// A pixel that shows the ball.
struct Sample {
  Eigen::Vector4d light;  // 1, from all around, and the surface's normal
  Eigen::Vector3d bgr;
  bool is_lit = true;
};

Eigen::Vector4d as_light(const Eigen::Vector3d& normal) {
  return {1.0, normal.x(), normal.y(), normal.z()};
}

std::vector<Sample> sample_ball(const cv::Mat& image, const BallSurface& surface, const OutlineModel& outline,
                                const Shades& shades, double gap_px) {
  std::vector<Sample> samples;
  const double inside = 1.0 - gap_px / outline.semi_minor_px();
  const double extent = outline.semi_major_px();
  const double area = 3.14 * outline.radius_px() * outline.radius_px();
  const int row_step = std::max(1, static_cast<int>(std::sqrt(area / kMostSamples)));
  const int step = std::max(1, static_cast<int>(std::ceil(area / (kMostSamples * row_step))));
  const int first_y = std::max(0, static_cast<int>(std::ceil(outline.centre_px().y() - extent)));
  const int last_y = std::min(image.rows - 1, static_cast<int>(std::floor(outline.centre_px().y() + extent)));
  for (int y = first_y; y <= last_y; y += row_step) {
    const ColumnSpan columns = outline.columns_within(inside, y);
    const auto* row = image.ptr<std::uint8_t>(y);
    for (int x = std::max(0, columns.first); x <= std::min(image.cols - 1, columns.last); x += step) {
      const std::uint8_t* bgr = row + 3 * x;
      const Eigen::Vector3d colour(bgr[0], bgr[1], bgr[2]);
      if (shades.contain(colour))
        samples.push_back({as_light(surface.normal(Eigen::Vector2d(x, y))), colour});
    }
  }
  return samples;
}

// Least squares of colours = c0 + [lit] n . l, whose samples may be turned on and off.
class LampFit {
 public:
  explicit LampFit(const std::vector<Sample>& samples) {
    const double ridge = kRidge * static_cast<double>(samples.size());
    squares_.diagonal() << 0.0, ridge, ridge, ridge;
    for (const Sample& sample : samples) add(sample.light, sample);
  }

  /// @param sign 1 to let the lamp shine on a sample, -1 to take it away again
  void turn(const Sample& sample, double sign) {
    Eigen::Vector4d lamp = sign * sample.light;
    lamp[0] = 0.0;
    add(lamp, sample);
  }

  Eigen::Matrix<double, 4, 3> colours() const { return squares_.ldlt().solve(products_); }

 private:
  void add(const Eigen::Vector4d& part, const Sample& sample) {
    squares_.noalias() += part * sample.light.transpose();
    products_.noalias() += part * sample.bgr.transpose();
  }

  Eigen::Matrix4d squares_ = Eigen::Matrix4d::Zero();  // lower triangle
  Eigen::Matrix<double, 4, 3> products_ = Eigen::Matrix<double, 4, 3>::Zero();
};

}  // namespace

bool Shades::contain(const Eigen::Vector3d& bgr) const {
  const double brightness = line_.dot(bgr);
  const double tolerance = kShadeTolerance * brightness + noise_tolerance_;
  return brightness >= kMinShade_levels &&
         bgr.squaredNorm() - brightness * brightness <= tolerance * tolerance;
}

BallSurface::BallSurface(const Intrinsics& camera, const OutlineModel& outline)
    : principal_px_(camera.cx_px, camera.cy_px), per_focal_px_(1.0 / camera.focal_px) {
  const double b = outline.semi_minor_px() / camera.focal_px;  // sphere_outline (sphere.h) read backwards
  centre_ = (outline.centre_px() - principal_px_) / (camera.focal_px * (1.0 + b * b));
  tangent2_ = centre_.squaredNorm() + 1.0 - b * b / (1.0 + b * b);
}

std::optional<Shading> fit_shading(const cv::Mat& image, const Intrinsics& camera,
                                   const OutlineModel& outline, const Shades& shades, double gap_px) {
  const BallSurface surface(camera, outline);
  std::vector<Sample> samples = sample_ball(image, surface, outline, shades, gap_px);
  if (samples.size() < kFewestSamples) return std::nullopt;
  LampFit fit(samples);
  Eigen::Matrix<double, 4, 3> colours = fit.colours();
  for (int i = 0; i < kMostTurns; ++i) {
    const Eigen::Vector3d lamp = colours.bottomRows<3>().rowwise().sum();
    bool any_turned = false;
    for (Sample& sample : samples) {
      const bool is_lit = lamp.dot(sample.light.tail<3>()) > 0.0;
      if (is_lit == sample.is_lit) continue;
      sample.is_lit = is_lit;
      fit.turn(sample, is_lit ? 1.0 : -1.0);
      any_turned = true;
    }
    if (!any_turned) break;
    colours = fit.colours();
  }
  return Shading(surface, colours);
}

}  // namespace stereobench::vision
