#include "harness/verify/geometry/link.h"

#include <algorithm>
#include <utility>

namespace stereobench::harness {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d kWorst = {kMostResidual_px, 0.0};

Vector2d limited(const Vector2d& residual) {
  const double norm = residual.norm();
  if (!(norm <= kMostResidual_px)) return kWorst;
  return residual;
}

/// From a camera to the other one of the same frame: by their poses, where they may have looked one after the
/// other.
Eigen::Isometry3d other_from(const Claims::Frame& frame, vision::Side side) {
  const std::size_t here = index_of(side), there = 1 - here;
  const auto& poses = frame.world_from_body;
  const Eigen::Isometry3d there_from_here =
      poses[here] && poses[there] ? poses[there]->inverse() * *poses[here] : Eigen::Isometry3d::Identity();
  return frame.cameras[there].body_from_camera.inverse() * there_from_here *
         frame.cameras[here].body_from_camera;
}

/// The point of a ray that another camera sees in a certain direction across.
/// @return metres in the first camera's frame; empty where the rays do not meet ahead
std::optional<Vector3d> triangulated(const Eigen::Isometry3d& other_from_camera, const Vector3d& ray,
                                     const Vector3d& mate_ray) {
  const Vector3d turned = other_from_camera.linear() * ray;
  const Vector3d& origin = other_from_camera.translation();
  const double z_m = (mate_ray.x() * origin.z() - origin.x()) / (turned.x() - mate_ray.x() * turned.z());
  if (!(z_m > 0.0)) return std::nullopt;
  return z_m * ray;
}

/// The frame whose file a link's depth comes from. Two corners of one pair are of the same instant, whichever
/// it is.
std::size_t instant_of(const Claims& claims, const Link& link) {
  if (link.mate_is_measured) return kNow;
  if (claims.depth_instant != kNow || !is_measured(link.kind) || claims.picture_shift == 0)
    return claims.depth_instant;
  return claims.picture_shift < 0 ? kBefore : kAfter;
}

bool says_nothing(const Claims& claims, const Link& link) {
  const std::size_t instant = instant_of(claims, link);
  return !link.ball && !link.depth_m[instant] && !link.mate_px[instant];
}

/// A link as it is where the left picture is the right camera's: the other end is the one that has depth.
Link swapped(Link link) {
  std::swap(link.from_px, link.to_px);
  if (link.mate_is_measured) {
    link.mate_px.fill(link.to_px);
    return link;
  }
  link.depth_m.fill(link.found_depth_m);
  link.mate_px.fill(link.found_mate_px);
  return link;
}

/// Where a link's point is in the frame of the camera that it is from.
std::optional<Vector3d> point_of(const Claims& claims, const Link& link) {
  const auto& cameras = claims.frames[link.from].cameras;
  const ViewCamera& camera = cameras[index_of(link.from_side)];
  const std::optional<Vector3d> ray = ray_of(camera, link.from_px);
  if (!ray) return std::nullopt;
  const std::size_t instant = instant_of(claims, link);
  if (const auto depth_m = link.depth_m[instant])
    return *depth_m * claims.depth_scale / (claims.depth_is_along_ray ? ray->norm() : 1.0) * *ray;
  if (auto mate_px = link.mate_px[instant]) {
    const ViewCamera& other = cameras[1 - index_of(link.from_side)];
    if (!link.mate_is_measured) mate_px->x() += claims.disparity_shift_px;
    const std::optional<Vector3d> mate_ray = ray_of(other, *mate_px);
    return mate_ray ? triangulated(other_from(claims.frames[link.from], link.from_side), *ray, *mate_ray)
                    : std::nullopt;
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> world_from_camera(const Claims& claims, std::size_t frame,
                                                   vision::Side side) {
  const Claims::Frame& at = claims.frames[frame];
  const auto& pose = at.world_from_body[index_of(side)];
  if (!pose) return std::nullopt;
  return *pose * at.cameras[index_of(side)].body_from_camera;
}

/// The frame at which the picture of a frame was really taken. @return out of bounds where there is none
std::size_t frame_of_picture(const Claims& claims, const Link& link, std::size_t frame) {
  return is_measured(link.kind) ? frame + static_cast<std::size_t>(claims.picture_shift) : frame;
}

/// From the camera that a link is from to the one that it leads to.
std::optional<Eigen::Isometry3d> to_from(const Claims& claims, const Link& link) {
  if (link.from == link.to) {
    if (link.from_side == link.to_side) return Eigen::Isometry3d::Identity();
    const Claims::Frame& frame = claims.frames[link.from];
    const bool has_poses = frame.world_from_body[0] && frame.world_from_body[1];
    if (claims.poses_are_of_each_camera && !has_poses) return std::nullopt;
    return other_from(frame, link.from_side);
  }
  const std::size_t here = frame_of_picture(claims, link, link.from);
  const std::size_t there = frame_of_picture(claims, link, link.to);
  if (std::max(here, there) >= claims.frames.size()) return std::nullopt;
  const auto world_from_here = world_from_camera(claims, here, link.from_side);
  const auto world_from_there = world_from_camera(claims, there, link.to_side);
  if (!world_from_here || !world_from_there) return std::nullopt;
  return world_from_there->inverse() * *world_from_here;
}

/// By how many pixels a point lies off the ball that its pixel sees, square to the ball's surface.
std::optional<Vector2d> off_ball(const Claims& claims, const Link& link) {
  const auto world = world_from_camera(claims, link.from, link.from_side);
  if (!(world || link.from_m) || !link.depth_m[claims.depth_instant]) return std::nullopt;
  const std::optional<Vector3d> point = point_of(claims, link);
  if (!point) return kWorst;
  const ViewBall& ball = (*claims.balls)[static_cast<std::size_t>(*link.ball)];
  const double off_m =
      (link.from_m ? *point - *link.from_m : *world * *point - ball.centre_m).norm() - ball.radius_m;
  const ViewCamera& camera = claims.frames[link.from].cameras[index_of(link.from_side)];
  return limited({camera.pinhole.focal_px * off_m / point->z(), 0.0});
}

std::optional<Vector2d> off_centre(const Claims& claims, const Link& link) {
  const auto world = world_from_camera(claims, link.to, link.to_side);
  if (!world) return std::nullopt;
  const Vector3d centre_m = world->inverse() * (*claims.balls)[static_cast<std::size_t>(*link.ball)].centre_m;
  const auto pixel = pixel_of(claims.frames[link.to].cameras[index_of(link.to_side)], centre_m);
  return pixel ? limited(link.to_px - *pixel) : kWorst;
}

/// By how many pixels two cameras disagree on where a ball is.
std::optional<Vector2d> off_place(const Claims& claims, const Link& link) {
  const std::optional<Eigen::Isometry3d> transform = to_from(claims, link);
  if (!transform) return std::nullopt;
  const ViewCamera& camera = claims.frames[link.to].cameras[index_of(link.to_side)];
  const auto said = pixel_of(camera, *link.to_m), by_poses = pixel_of(camera, *transform * *link.from_m);
  return said && by_poses ? limited(*said - *by_poses) : kWorst;
}

/// The disparity that a point of the next frame has.
std::optional<double> disparity_at(const Claims& claims, std::size_t frame, const Vector3d& in_left_m) {
  const auto& cameras = claims.frames[frame].cameras;
  const auto left = pixel_of(cameras[0], in_left_m);
  const auto right =
      pixel_of(cameras[1], cameras[1].body_from_camera.inverse() * cameras[0].body_from_camera * in_left_m);
  if (!left || !right) return std::nullopt;
  return left->x() - right->x();
}

std::optional<Vector2d> off_pixel(const Claims& claims, const Link& link) {
  if (says_nothing(claims, link)) return std::nullopt;
  const std::optional<Eigen::Isometry3d> transform = to_from(claims, link);
  if (!transform) return std::nullopt;
  const std::optional<Vector3d> point = point_of(claims, link);
  if (!point) return kWorst;
  const Vector3d there_m = *transform * *point;
  if (link.kind == LinkKind::kNextDisparity) {
    const std::optional<double> disparity_px = disparity_at(claims, link.to, there_m);
    return disparity_px ? limited({link.to_px.x() - *disparity_px, 0.0}) : kWorst;
  }
  const auto pixel = pixel_of(claims.frames[link.to].cameras[index_of(link.to_side)], there_m);
  if (!pixel) return kWorst;
  const Vector2d off = link.to_px - *pixel;
  const double shift_px = claims.disparity_shift_px;
  if (link.kind == LinkKind::kDisparityDepth) return limited({off.x() + shift_px, 0.0});
  if (link.kind == LinkKind::kRightDepth) return limited({off.x() - shift_px, 0.0});
  if (link.kind == LinkKind::kEpipolar) return limited({off.y(), 0.0});
  return limited(off);
}

}  // namespace

std::string_view name_of(LinkKind kind) {
  constexpr std::array<std::string_view, kLinkKinds> kNames = {
      "disparity against depth and baseline",
      "the right camera's disparity against its depth and the baseline",
      "flow against depth and poses",
      "the next frame's disparity against poses",
      "points of the world in pictures, against poses",
      "places of objects in both cameras and in the next frame, against poses",
      "depth of balls against world and poses",
      "corners of the left picture in the right one",
      "rows of corners in both pictures",
      "corners of a picture in the next one, against poses"};
  return kNames.at(static_cast<std::size_t>(kind));
}

bool is_measured(LinkKind kind) {
  return kind == LinkKind::kStereoPictures || kind == LinkKind::kEpipolar || kind == LinkKind::kNextPictures;
}

Claims claims_of(const DatasetView& view) {
  Claims claims = {.frames = {}, .balls = &view.balls};
  claims.poses_are_of_each_camera = view.poses_of == PosesOf::kEachCamera;
  for (const ViewFrame& frame : view.frames) claims.frames.push_back({frame.cameras, frame.world_from_body});
  return claims;
}

std::optional<Vector2d> residual_px(const Claims& claims, const Link& link) {
  if (link.kind == LinkKind::kBallSurface) return off_ball(claims, link);
  if (link.kind == LinkKind::kBallCentre) return off_centre(claims, link);
  if (link.kind == LinkKind::kBallPlace) return off_place(claims, link);
  if (claims.pictures_are_swapped && is_measured(link.kind)) {
    if (link.kind == LinkKind::kNextPictures) return std::nullopt;
    if (!link.mate_is_measured && !link.found_depth_m && !link.found_mate_px) return std::nullopt;
    return off_pixel(claims, swapped(link));
  }
  return off_pixel(claims, link);
}

}  // namespace stereobench::harness
