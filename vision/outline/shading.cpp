#include "vision/outline/shading.h"

#include <cstdint>

#include <Eigen/Cholesky>

#include "vision/scratch.h"
#include "vision/tuning/shading.h"

namespace stereobench::vision {
namespace {

// A pixel that shows the ball.
struct Sample {
  Eigen::Vector4d light;  // 1, from all around, and the surface's normal
  Eigen::Vector3d bgr;
  bool is_lit = true;
};

Eigen::Vector4d as_light(const Eigen::Vector3d& normal) {
  return {1.0, normal.x(), normal.y(), normal.z()};
}

ScratchVector<Sample> sample_ball(const cv::Mat& image, const BallSurface& surface,
                                  const OutlineModel& outline, const Shades& shades) {
  ScratchVector<Sample> samples;
  const double radius = outline.radius_px();
  const double outermost = 1.0 - outline.pure_px() / outline.semi_minor_px();
  const double innermost =
      std::max(0.0, outermost - std::max(kShading.sampled_depth, kShading.sampled_depth_px / radius));
  const double most = kShading.samples_per_radius_px * radius;
  const double area = 3.14 * radius * radius * (outermost * outermost - innermost * innermost);
  const int row_step = std::max(1, static_cast<int>(std::sqrt(area / most)));
  const int step = std::max(1, static_cast<int>(std::ceil(area / (most * row_step))));
  samples.reserve(static_cast<std::size_t>(1.1 * area / (row_step * step)));
  visit_ring(outline, innermost, outermost, image.size(), row_step, [&](const ColumnSpan& columns, int y) {
    const auto* row = image.ptr<std::uint8_t>(y);
    for (int x = columns.first; x <= columns.last; x += step) {
      const std::uint8_t* bgr = row + 3 * x;
      const Eigen::Vector3d colour(bgr[0], bgr[1], bgr[2]);
      if (shades.contain(colour))
        samples.push_back({as_light(surface.normal(Eigen::Vector2d(x, y))), colour});
    }
  });
  return samples;
}

// Least squares of colours = c0 + [lit] n . l, whose samples may be turned on and off.
class LightSourceFit {
 public:
  /// Takes a sample in, lit or not as it is said to be.
  void add(const Sample& sample) {
    if (sample.is_lit) return add(sample.light, sample);
    squares_(0, 0) += 1.0;
    products_.row(0) += sample.bgr;
  }

  /// @param sign 1 to let the light source shine on a sample that was taken in, -1 to take it away again
  void turn(const Sample& sample, double sign) {
    Eigen::Vector4d light_source = sign * sample.light;
    light_source[0] = 0.0;
    add(light_source, sample);
  }

  BallLight light(const std::optional<SharedLightSource>& shared) const {
    Eigen::Matrix4d information = squares_.selfadjointView<Eigen::Lower>();
    information.diagonal().tail<3>().array() += kShading.ridge * squares_(0, 0);
    if (shared) return {shared->colours(information, products_), information};
    return {information.ldlt().solve(products_), information};
  }

 private:
  void add(const Eigen::Vector4d& part, const Sample& sample) {
    squares_.noalias() += part * sample.light.transpose();
    products_.noalias() += part * sample.bgr.transpose();
  }

  Eigen::Matrix4d squares_ = Eigen::Matrix4d::Zero();  // lower triangle
  LightColours products_ = LightColours::Zero();
};

Eigen::Vector3d light_source_of(const BallLight& light) {
  return light.colours.bottomRows<3>().rowwise().sum();
}

bool is_lit_by(const Eigen::Vector3d& light_source, const Sample& sample) {
  return light_source.dot(sample.light.tail<3>()) > 0.0;
}

void light_by(const Eigen::Vector3d& light_source, ScratchVector<Sample>& samples) {
  for (Sample& sample : samples) sample.is_lit = is_lit_by(light_source, sample);
}

// Fits every `stride`-th sample, whose sides towards the light source are found in turns with the light
// source.
BallLight fit_light_source(ScratchVector<Sample>& samples, std::size_t stride,
                           const std::optional<SharedLightSource>& shared) {
  LightSourceFit fit;
  for (std::size_t i = 0; i < samples.size(); i += stride) fit.add(samples[i]);
  BallLight light = fit.light(shared);
  for (int turn = 0; turn < kShading.most_turns; ++turn) {
    const Eigen::Vector3d light_source = light_source_of(light);
    bool any_turned = false;
    for (std::size_t i = 0; i < samples.size(); i += stride) {
      Sample& sample = samples[i];
      const bool is_lit = is_lit_by(light_source, sample);
      if (is_lit == sample.is_lit) continue;
      sample.is_lit = is_lit;
      fit.turn(sample, is_lit ? 1.0 : -1.0);
      any_turned = true;
    }
    if (!any_turned) break;
    light = fit.light(shared);
  }
  return light;
}

// Whether there is a light source. A ball that is seen from its unlit side suits none at all as well as any
// behind it, and must not say which.
bool shows_light_source(const BallLight& light, double noise_variance) {
  const auto light_source = light.colours.bottomRows<3>();
  const Eigen::Vector3d both = light.information.bottomLeftCorner<3, 1>();
  const Eigen::Matrix3d of_light_source =
      light.information.bottomRightCorner<3, 3>() - both * both.transpose() / light.information(0, 0);
  return (light_source.transpose() * of_light_source * light_source).trace() >
         kShading.by_chance * noise_variance;
}

}  // namespace

BallSurface::BallSurface(const Intrinsics& camera, const OutlineModel& outline)
    : principal_px_(camera.cx_px, camera.cy_px), per_focal_px_(1.0 / camera.focal_px) {
  const double b = outline.semi_minor_px() / camera.focal_px;  // sphere_outline (sphere.h) read backwards
  centre_ = (outline.centre_px() - principal_px_) / (camera.focal_px * (1.0 + b * b));
  const double radius2 = b * b / (1.0 + b * b);
  tangent2_ = centre_.squaredNorm() + 1.0 - radius2;
  per_radius_ = 1.0 / std::sqrt(radius2);
}

std::optional<Shading> fit_shading(const cv::Mat& image, const Intrinsics& camera,
                                   const OutlineModel& outline, const Shades& shades, double noise_variance,
                                   const std::optional<SharedLightSource>& shared) {
  const BallSurface surface(camera, outline);
  ScratchVector<Sample> samples = sample_ball(image, surface, outline, shades);
  if (samples.size() < kShading.fewest_samples) return std::nullopt;
  const std::size_t stride = samples.size() / kShading.first_samples;
  if (shared) {
    light_by(shared->direction(), samples);
  } else if (stride > 1) {
    light_by(light_source_of(fit_light_source(samples, stride, std::nullopt)), samples);
  }
  BallLight light = fit_light_source(samples, 1, shared);
  light.shows_light_source = shows_light_source(light, noise_variance);
  return Shading(surface, light);
}

}  // namespace stereobench::vision
