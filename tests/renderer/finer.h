/// Pictures of five times the size, whose means are what a pixel should show.
#pragma once

#include <array>
#include <set>
#include <utility>

#include "renderer/renderer.h"

namespace stereobench::renderer::test {

inline constexpr int kFiner = 5;

/// The same rig with five times as many pixels each way.
inline vision::StereoRig finer(vision::StereoRig rig) {
  vision::Intrinsics& camera = rig.intrinsics;
  camera.width_px *= kFiner;
  camera.height_px *= kFiner;
  camera.focal_px *= kFiner;
  camera.cx_px = kFiner * (camera.cx_px + 0.5) - 0.5;
  camera.cy_px = kFiner * (camera.cy_px + 0.5) - 0.5;
  return rig;
}

/// What a camera sees in finer pixels.
struct FinerImage {
  cv::Mat colour, primitive;

  /// The mean of the finer pixels that make up a pixel, in levels.
  cv::Vec3d mean_colour(int u, int v) const {
    const cv::Scalar mean = cv::mean(colour(cv::Rect(kFiner * u, kFiner * v, kFiner, kFiner)));
    return {mean[0], mean[1], mean[2]};
  }

  /// What a pixel's centre sees.
  cv::Vec3b centre_colour(int u, int v) const {
    return colour.at<cv::Vec3b>(kFiner * v + kFiner / 2, kFiner * u + kFiner / 2);
  }

  /// Whether a pixel sees something that neither its own centre nor that of a neighbour sees.
  /// @param u, v not at the picture's border
  bool has_sliver(int u, int v) const {
    std::set<int> unseen;
    for (int y = 0; y < kFiner; ++y)
      for (int x = 0; x < kFiner; ++x) unseen.insert(primitive.at<int>(kFiner * v + y, kFiner * u + x));
    for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      unseen.erase(primitive.at<int>(kFiner * (v + dy) + kFiner / 2, kFiner * (u + dx) + kFiner / 2));
    return !unseen.empty();
  }

  /// Whether all centres of a pixel's finer pixels, and of so many beyond its borders, see one primitive.
  /// @param u, v not at the picture's border
  bool is_one_primitive(int u, int v, int beyond) const {
    const int size = kFiner + 2 * beyond;
    const cv::Mat seen = primitive(cv::Rect(kFiner * u - beyond, kFiner * v - beyond, size, size));
    return cv::countNonZero(seen != seen.at<int>(0, 0)) == 0;
  }
};

inline std::array<FinerImage, 2> finer_pair(const worlds::World& world, const vision::StereoRig& rig,
                                            const slam::Pose& pose) {
  Renderer renderer(world, finer(rig));
  const StereoFrame frame = renderer.render(pose);
  const StereoIdBuffers ids = renderer.id_buffers(pose, pose);
  return {FinerImage{frame.left.colour, ids.left.primitive},
          FinerImage{frame.right.colour, ids.right.primitive}};
}

}  // namespace stereobench::renderer::test
