#include "slam/smoother/path_graph.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace stereobench::slam {
namespace {

// A straight drive of 600 m beside landmarks, by an odometer whose scale alone is uncertain. In the end the
// first landmark turns out to be 6 m farther back, and all that lies between moves by its share. Mutations:
// all values told as they are; nothing brought in when it is asked for; all of the past followed at once.
TEST(PathGraph, TellsWhereThePastBelongs) {
  constexpr int kPoses = 600;
  PathGraph graph({});
  std::vector<int> landmarks;
  const auto see = [&graph](int landmark, const Eigen::Vector2d& from_pose) {
    Observation seen;
    seen.range_bearing = {from_pose.norm(), std::atan2(from_pose.y(), from_pose.x())};
    seen.noise = Eigen::Vector2d(1e-6, 1e-8).asDiagonal();
    graph.add_sighting(landmark, seen);
  };
  for (int k = 1; k <= kPoses; ++k) {
    PoseBelief motion{{1.0, 0.0, 0.0}, Eigen::Vector3d(1e-2, 1e-8, 1e-12).asDiagonal()};
    graph.add_pose(motion, {static_cast<double>(k), 0.0, 0.0});
    landmarks.push_back(graph.add_landmark({k, 3.0}));
    see(landmarks.back(), {0.0, 3.0});
    if (k == kPoses) see(landmarks.front(), {1.0 - kPoses - 6.0, 3.0});
    graph.solve();
  }
  const auto belongs_m = [](std::size_t i) {
    return 1.0 + static_cast<double>(i) * (1.0 + 6.0 / (kPoses - 1));
  };
  double left_behind_m = 0.0;
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    left_behind_m = std::max(left_behind_m, std::abs(graph.landmark(landmarks[i]).x() - belongs_m(i)));
  EXPECT_GT(left_behind_m, 0.5);
  const std::vector<Eigen::Vector3d> settled = graph.settled();
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    EXPECT_NEAR(settled[static_cast<std::size_t>(landmarks[i])].x(), belongs_m(i), 0.02) << i;
  for (const std::size_t i : {std::size_t{0}, landmarks.size() / 3, landmarks.size() / 2}) {
    graph.catch_up(std::vector<int>{landmarks[i]});
    EXPECT_NEAR(graph.landmark(landmarks[i]).x(), belongs_m(i), 0.02) << i;
  }
}

}  // namespace
}  // namespace stereobench::slam
