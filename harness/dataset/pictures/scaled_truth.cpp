#include "harness/dataset/pictures/scaled_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using renderer::CameraView;
using renderer::Occlusion;

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kSameFace_px = 1.0;  ///< of the whole picture's disparity

/// One of the camera's pixels around a place.
struct Candidate {
  cv::Point at;
  int id = 0;
  double depth_m = kNowhere;
};

/// The pixels around the centre of a scaled one: row by row; four times the same where N is odd.
using Around = std::array<Candidate, 4>;

Around around(const cv::Mat& ball_id, const cv::Mat& depth_m, const cv::Point& pixel, int divide) {
  const int before = (divide - 1) / 2, after = divide / 2;
  Around four;
  for (std::size_t i = 0; i < four.size(); ++i) {
    const cv::Point at(pixel.x * divide + (i % 2 == 0 ? before : after),
                       pixel.y * divide + (i < 2 ? before : after));
    four[i] = {at, ball_id.at<std::uint8_t>(at), depth_m.at<float>(at)};
  }
  return four;
}

Eigen::Vector3d centre_in_camera(const CameraView& view, const worlds::World& world, int id) {
  return view.camera_from_world * world.balls[static_cast<std::size_t>(id - 1)].centre_m;
}

/// Planar depth at which a ray enters a ball. @param ray with Z = 1 @return +inf where it passes by
double depth_on_ball(const Eigen::Vector3d& ray, const Eigen::Vector3d& centre, double radius_m) {
  const double a = ray.squaredNorm(), b = ray.dot(centre);
  const double spare = b * b - a * (centre.squaredNorm() - radius_m * radius_m);
  return spare < 0.0 ? kNowhere : (b - std::sqrt(spare)) / a;
}

/// Decides what a place sees.
class Place {
 public:
  Place(const ScaledLook& look, const worlds::World& world, const cv::Point& pixel, const Around& four)
      : look_(look), world_(world), pixel_(pixel), four_(four) {}

  Candidate seen() const {
    std::optional<Candidate> best = background();
    for (const Candidate& one : four_) {
      if (one.id == 0) continue;
      const double depth_m = depth_of(one);
      if (depth_m == kNowhere || is_behind_background(depth_m, best)) continue;
      if (!best || best->id == 0 || depth_m < best->depth_m) best = {one.at, one.id, depth_m};
    }
    return best ? *best : *std::ranges::min_element(four_, {}, &Candidate::depth_m);
  }

 private:
  double depth_of(const Candidate& one) const {
    const Eigen::Vector3d ray = line_of_sight(look_.view, {pixel_.x, pixel_.y});
    return depth_on_ball(ray, centre_in_camera(look_.view, world_, one.id),
                         world_.balls[static_cast<std::size_t>(one.id - 1)].radius_m);
  }

  /// How many of the whole picture's pixels of disparity lie between two pixels.
  double apart_px(const Candidate& one, const Candidate& other) const {
    const double focal_px = look_.view.intrinsics.focal_px * look_.divide;
    return focal_px * look_.baseline_m * std::abs(1.0 / one.depth_m - 1.0 / other.depth_m);
  }

  /// A ball that is met is before the background, unless that is nearer and fills most of the pixels: the
  /// floor beside the point where a ball stands may be a little nearer.
  bool is_behind_background(double depth_m, const std::optional<Candidate>& best) const {
    return best && best->id == 0 && best->depth_m < depth_m &&
           std::ranges::count(four_, 0, &Candidate::id) > 2;
  }

  /// Whether a pixel without a ball shows the face that the nearest one shows.
  bool is_of_face(const Candidate& one, const Candidate& nearest) const {
    return one.id == 0 && one.depth_m != kNowhere && apart_px(one, nearest) <= kSameFace_px;
  }

  /// Of the pixels without a ball: the mean of those on opposite sides, or else the nearest.
  std::optional<Candidate> background() const {
    std::optional<Candidate> nearest;
    for (const Candidate& one : four_)
      if (one.id == 0 && (!nearest || one.depth_m < nearest->depth_m)) nearest = one;
    if (!nearest || nearest->depth_m == kNowhere) return nearest;
    double sum = 0.0;
    int count = 0;
    for (const auto& [one, other] : {std::pair{four_[0], four_[3]}, {four_[1], four_[2]}}) {
      if (one.id != 0 || other.id != 0) continue;
      if (!is_of_face(one, *nearest) || !is_of_face(other, *nearest)) return nearest;
      sum += 1.0 / one.depth_m + 1.0 / other.depth_m;
      count += 2;
    }
    if (count > 0) nearest->depth_m = count / sum;
    return nearest;
  }

  const ScaledLook& look_;
  const worlds::World& world_;
  cv::Point pixel_;
  const Around& four_;
};

}  // namespace

ScaledTruth scaled_truth(const cv::Mat& ball_id, const cv::Mat& depth_m, const ScaledLook& look,
                         const worlds::World& world) {
  const cv::Size size = depth_m.size() / look.divide;
  ScaledTruth truth = {cv::Mat(size, CV_8UC1), cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32SC2)};
  for (int row = 0; row < size.height; ++row)
    for (int column = 0; column < size.width; ++column) {
      const Around four = around(ball_id, depth_m, {column, row}, look.divide);
      const Candidate seen = Place(look, world, {column, row}, four).seen();
      truth.ball_id.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(seen.id);
      truth.depth_m.at<float>(row, column) = static_cast<float>(seen.depth_m);
      truth.from.at<cv::Point>(row, column) = seen.at;
    }
  return truth;
}

renderer::PixelTruth scaled_pixels(const renderer::PixelTruth& whole, const ScaledTruth& truth,
                                   const ScaledLook& look, const worlds::World& world) {
  const cv::Size size = truth.depth_m.size();
  renderer::PixelTruth scaled = {cv::Mat(size, CV_32SC1), cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC3)};
  for (int row = 0; row < size.height; ++row)
    for (int column = 0; column < size.width; ++column) {
      const auto from = truth.from.at<cv::Point>(row, column);
      scaled.surface.at<int>(row, column) = whole.surface.at<int>(from);
      scaled.normal.at<cv::Vec3f>(row, column) = whole.normal.at<cv::Vec3f>(from);
      const double depth_m = truth.depth_m.at<float>(row, column);
      scaled.range_m.at<float>(row, column) = static_cast<float>(depth_m);
      if (!std::isfinite(depth_m)) continue;
      const Eigen::Vector3d ray = line_of_sight(look.view, {column, row});
      scaled.range_m.at<float>(row, column) = static_cast<float>(depth_m * ray.norm());
      const int id = truth.ball_id.at<std::uint8_t>(row, column);
      if (id == 0) continue;
      const Eigen::Vector3f out =
          (depth_m * ray - centre_in_camera(look.view, world, id)).normalized().cast<float>();
      scaled.normal.at<cv::Vec3f>(row, column) = {out.x(), out.y(), out.z()};
    }
  return scaled;
}

renderer::Correspondence scaled_correspondence(const renderer::Correspondence& whole,
                                               const ScaledTruth& truth, const CameraView& from,
                                               const CameraView& to) {
  const cv::Size size = truth.depth_m.size();
  const Eigen::Isometry3d to_from_from = to.camera_from_world * from.camera_from_world.inverse();
  renderer::Correspondence scaled = {cv::Mat(size, CV_32FC2, cv::Scalar::all(kNowhere)),
                                     cv::Mat(size, CV_8UC1)};
  for (int row = 0; row < size.height; ++row)
    for (int column = 0; column < size.width; ++column) {
      std::uint8_t& outcome = scaled.occlusion.at<std::uint8_t>(row, column);
      outcome = whole.occlusion.at<std::uint8_t>(truth.from.at<cv::Point>(row, column));
      const double depth_m = truth.depth_m.at<float>(row, column);
      const bool leads_on =
          std::isfinite(whole.shift_px.at<cv::Vec2f>(truth.from.at<cv::Point>(row, column))[0]);
      if (!std::isfinite(depth_m) || !leads_on) continue;
      const Eigen::Vector2d here(column, row);
      const Eigen::Vector3d there = to_from_from * (depth_m * line_of_sight(from, here));
      const Eigen::Vector2d place = shown_at(to, there);
      const Eigen::Vector2f shift = (place - here).cast<float>();
      scaled.shift_px.at<cv::Vec2f>(row, column) = {shift.x(), shift.y()};
      if (!vision::is_inside(to.intrinsics, place)) outcome = static_cast<std::uint8_t>(Occlusion::kOutside);
    }
  return scaled;
}

}  // namespace stereobench::harness
