#include "harness/verify/geometry/hypothesis.h"

#include <utility>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

/// The axes of OpenGL's cameras in those of the field's: y up, z backward.
const Eigen::Vector3d kAxesOfGl = {1.0, -1.0, -1.0};

template <class Change>
void change_cameras(Claims& claims, const Change& change) {
  for (Claims::Frame& frame : claims.frames)
    for (ViewCamera& camera : frame.cameras) change(camera);
}

template <class Change>
void change_poses(Claims& claims, const Change& change) {
  for (Claims::Frame& frame : claims.frames)
    for (auto& pose : frame.world_from_body)
      if (pose) change(*pose);
}

/// Moves the right camera away from the left one.
void scale_baseline(Claims& claims, double factor) {
  for (Claims::Frame& frame : claims.frames) {
    const Eigen::Isometry3d& left = frame.cameras[0].body_from_camera;
    Eigen::Isometry3d& right = frame.cameras[1].body_from_camera;
    right.translation() = left.translation() + factor * (right.translation() - left.translation());
    if (!claims.poses_are_of_each_camera || !frame.world_from_body[0] || !frame.world_from_body[1]) continue;
    const Eigen::Vector3d origin_m = frame.world_from_body[0]->translation();
    Eigen::Isometry3d& pose = *frame.world_from_body[1];
    pose.translation() = origin_m + factor * (pose.translation() - origin_m);
  }
}

/// The cameras alone, where their mounting on the body, or the poses, are in other axes.
void use_axes_of_gl(Claims& claims) {
  for (Claims::Frame& frame : claims.frames) {
    const Eigen::Isometry3d left_from_right =
        frame.cameras[0].body_from_camera.inverse() * frame.cameras[1].body_from_camera;
    frame.cameras[0].body_from_camera.linear() *= kAxesOfGl.asDiagonal();
    frame.cameras[1].body_from_camera = frame.cameras[0].body_from_camera * left_from_right;
  }
}

void use_axes_of_gl_for_both(Claims& claims) {
  change_cameras(claims,
                 [](ViewCamera& camera) { camera.body_from_camera.linear() *= kAxesOfGl.asDiagonal(); });
}

/// Takes each frame's pose from another one.
void shift_poses(Claims& claims, int by) {
  const std::vector<Claims::Frame> before = claims.frames;
  const auto count = static_cast<int>(before.size());
  for (int i = 0; i < count; ++i) {
    const int from = i + by;
    for (std::size_t side = 0; side < 2; ++side) {
      auto& pose = claims.frames[static_cast<std::size_t>(i)].world_from_body[side];
      if (from < 0 || from >= count)
        pose.reset();
      else
        pose = before[static_cast<std::size_t>(from)].world_from_body[side];
    }
  }
}

void swap_cameras(Claims& claims) {
  for (Claims::Frame& frame : claims.frames) {
    std::swap(frame.cameras[0], frame.cameras[1]);
    if (claims.poses_are_of_each_camera) std::swap(frame.world_from_body[0], frame.world_from_body[1]);
  }
}

using Undo = std::function<void(Claims&)>;

Hypothesis certain(Suspect suspect, std::string cause, Undo undo) {
  return {.suspect = suspect,
          .cause = std::move(cause),
          .undo = [undo = std::move(undo)](Claims& claims, double) { undo(claims); }};
}

void add_frames(std::vector<Hypothesis>& all) {
  all.push_back(certain(Suspect::kPoses,
                        "camera axes are mixed up: y and z point the other way (OpenGL has y up, z backward)",
                        use_axes_of_gl));
  all.back().poses_of = {PosesOf::kLeftCamera, PosesOf::kEachCamera};
  all.push_back(certain(
      Suspect::kCalibration,
      "camera axes on the body are mixed up: y and z point the other way (OpenGL has y up, z backward)",
      use_axes_of_gl_for_both));
  all.back().poses_of = {PosesOf::kBody, PosesOf::kLeftCamera};
  all.push_back(certain(
      Suspect::kPoses, "inverse poses (camera from world and world from camera are mixed up)",
      [](Claims& claims) { change_poses(claims, [](Eigen::Isometry3d& pose) { pose = pose.inverse(); }); }));
  all.push_back(
      certain(Suspect::kPoses,
              "inverse poses, in axes of OpenGL (camera from world and world from camera are mixed up)",
              [](Claims& claims) {
                change_poses(claims, [](Eigen::Isometry3d& pose) {
                  pose = pose.inverse();
                  pose.translation() = kAxesOfGl.cwiseProduct(pose.translation());
                  pose.linear() = kAxesOfGl.asDiagonal() * pose.linear() * kAxesOfGl.asDiagonal();
                });
              }));
  all.push_back(certain(Suspect::kCalibration, "swapped cameras: left is right", swap_cameras));
  all.push_back(
      certain(Suspect::kCalibration, "inverse places of the cameras on the body", [](Claims& claims) {
        change_cameras(
            claims, [](ViewCamera& camera) { camera.body_from_camera = camera.body_from_camera.inverse(); });
      }));
  all.push_back(certain(Suspect::kPoses, "poses are a frame late: each is that of the frame before",
                        [](Claims& claims) { shift_poses(claims, 1); }));
  all.push_back(certain(Suspect::kPoses, "poses are a frame early: each is that of the frame after",
                        [](Claims& claims) { shift_poses(claims, -1); }));
  all.push_back(certain(Suspect::kDepth, "a frame late: it is that of the frame before",
                        [](Claims& claims) { claims.depth_instant = kAfter; }));
  all.push_back(certain(Suspect::kDepth, "a frame early: it is that of the frame after",
                        [](Claims& claims) { claims.depth_instant = kBefore; }));
  all.push_back(certain(Suspect::kPicture, "pictures are a frame late: each is that of the frame before",
                        [](Claims& claims) { claims.picture_shift = -1; }));
  all.push_back(certain(Suspect::kPicture, "pictures are a frame early: each is that of the frame after",
                        [](Claims& claims) { claims.picture_shift = 1; }));
  all.push_back(certain(Suspect::kPicture, "swapped cameras: the left picture is the right camera's",
                        [](Claims& claims) { claims.pictures_are_swapped = true; }));
  all.push_back(certain(Suspect::kDepth, "depth along the ray instead of planar Z",
                        [](Claims& claims) { claims.depth_is_along_ray = true; }));
}

void add_units(std::vector<Hypothesis>& all) {
  for (const auto& [factor, unit] : {std::pair(0.01, "centimetres"), std::pair(0.001, "millimetres")}) {
    all.push_back(certain(Suspect::kPoses, fmt::format("places of poses in {} instead of metres", unit),
                          [factor = factor](Claims& claims) {
                            change_poses(claims,
                                         [&](Eigen::Isometry3d& pose) { pose.translation() *= factor; });
                          }));
    all.push_back(certain(Suspect::kDepth, fmt::format("depth in {} instead of metres", unit),
                          [factor = factor](Claims& claims) { claims.depth_scale *= factor; }));
    all.push_back(certain(Suspect::kCalibration, fmt::format("baseline in {} instead of metres", unit),
                          [factor = factor](Claims& claims) { scale_baseline(claims, factor); }));
  }
}

/// Formats in millimetres, whose readers have made metres of it.
void add_thousandths(std::vector<Hypothesis>& all) {
  static constexpr double kThousand = 1000.0;
  all.push_back(
      certain(Suspect::kPoses, "places of poses in metres instead of millimetres", [](Claims& claims) {
        change_poses(claims, [](Eigen::Isometry3d& pose) { pose.translation() *= kThousand; });
      }));
  all.push_back(certain(Suspect::kDepth, "depth in metres instead of millimetres",
                        [](Claims& claims) { claims.depth_scale *= kThousand; }));
}

/// A camera's number that may be off by an amount: factors as shares, shifts in px.
void add_amounts(std::vector<Hypothesis>& all) {
  constexpr double kShare = 0.002, kPixel = 0.1, kPercent = 100.0;
  const auto add = [&](Suspect suspect, const char* cause, double least, bool is_share, auto undo) {
    all.push_back({.suspect = suspect,
                   .cause = cause,
                   .undo = undo,
                   .has_amount = true,
                   .first_step = is_share ? 1e-4 : 1e-2,
                   .least = least,
                   .unit = is_share ? "%" : "px",
                   .shown_scale = is_share ? kPercent : 1.0});
  };
  add(Suspect::kCalibration, "baseline too long by {}", kShare, true,
      [](Claims& claims, double share) { scale_baseline(claims, 1.0 / (1.0 + share)); });
  add(Suspect::kCalibration, "focal length too long by {}", kShare, true, [](Claims& claims, double share) {
    change_cameras(claims, [&](ViewCamera& camera) { camera.pinhole.focal_px /= 1.0 + share; });
  });
  add(Suspect::kCalibration,
      "principal point too far right by {} (half a pixel: the corner of the picture for the "
      "centre of its first pixel)",
      kPixel, false, [](Claims& claims, double px) {
        change_cameras(claims, [&](ViewCamera& camera) { camera.pinhole.cx_px -= px; });
      });
  add(Suspect::kCalibration, "principal point too far down by {}", kPixel, false,
      [](Claims& claims, double px) {
        change_cameras(claims, [&](ViewCamera& camera) { camera.pinhole.cy_px -= px; });
      });
  add(Suspect::kCalibration,
      "principal point too far right and down by {} each (half a pixel: the corner of the picture for the "
      "centre of "
      "its first pixel)",
      kPixel, false, [](Claims& claims, double px) {
        change_cameras(claims, [&](ViewCamera& camera) {
          camera.pinhole.cx_px -= px;
          camera.pinhole.cy_px -= px;
        });
      });
  add(Suspect::kDepth, "disparity too large by {}", kPixel, false,
      [](Claims& claims, double px) { claims.disparity_shift_px += px; });
  add(Suspect::kDepth, "depth too large by {}", kShare, true,
      [](Claims& claims, double share) { claims.depth_scale /= 1.0 + share; });
  add(Suspect::kPoses, "ways between poses too long by {}", kShare, true, [](Claims& claims, double share) {
    change_poses(claims, [&](Eigen::Isometry3d& pose) { pose.translation() /= 1.0 + share; });
  });
}

}  // namespace

std::vector<Hypothesis> known_hypotheses() {
  std::vector<Hypothesis> all;
  add_frames(all);
  add_units(all);
  add_thousandths(all);
  add_amounts(all);
  return all;
}

}  // namespace stereobench::harness
