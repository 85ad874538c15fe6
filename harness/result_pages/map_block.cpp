#include "harness/result_pages/map_block.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/page/spaced_steps.h"
#include "harness/scoring/landmark_map.h"
#include "vision/palette.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostInstants = 600;  ///< that the slider stops at

std::string colour_of_landmark(const LandmarkTruth& landmark) {
  if (landmark.colour_class < 0 || landmark.colour_class >= static_cast<int>(vision::kPalette.size()))
    return "";
  const auto [r, g, b] = vision::kPalette[static_cast<std::size_t>(landmark.colour_class)];
  return fmt::format("#{:02x}{:02x}{:02x}", r, g, b);
}

PageEstimate page_estimate(const MapEstimate& estimate, const std::vector<LandmarkTruth>& truth,
                           const std::vector<std::size_t>& instants,
                           const std::vector<Eigen::Matrix2d>& covariances) {
  PageEstimate shown{.name = estimate.filter};
  for (const std::size_t k : instants) {
    if (k >= estimate.path.size()) break;
    shown.path.emplace_back(estimate.path[k].x_m, estimate.path[k].y_m);
    if (k < covariances.size()) shown.covariances.push_back(covariances[k]);
  }
  for (const slam::LandmarkEstimate& landmark : estimate.landmarks)
    shown.landmarks.push_back(
        {landmark.position_m, landmark.covariance, owner(landmark, landmark.position_m, truth)});
  return shown;
}

}  // namespace

PageMap map_of_seed(const SeedResult& seed, const std::vector<worlds::Wall>& walls) {
  PageMap shown;
  if (!seed.map || !seed.track) return shown;
  const std::vector<std::size_t> instants = spaced_steps(seed.time_s.size(), kMostInstants);
  for (const std::size_t k : instants) {
    shown.time_s.push_back(seed.time_s[k]);
    shown.sightings.push_back(seed.track->seen_m[k]);
    shown.truth.emplace_back();
    if (const auto& pose = seed.track->truth[k])
      shown.truth.back() = Eigen::Vector3d(pose->x_m, pose->y_m, pose->heading_rad);
  }
  for (const worlds::Wall& wall : walls) shown.walls.push_back({wall.from_m.head<2>(), wall.to_m.head<2>()});
  for (const LandmarkTruth& landmark : seed.map->landmarks)
    shown.landmarks.push_back({landmark.position_m, colour_of_landmark(landmark)});
  const auto& covariances = seed.track->covariances;
  for (std::size_t i = 0; i < seed.map->estimates.size(); ++i)
    shown.estimates.push_back(
        page_estimate(seed.map->estimates[i], seed.map->landmarks, instants,
                      i < covariances.size() ? covariances[i] : std::vector<Eigen::Matrix2d>()));
  return shown;
}

PageMap map_of_paths(const std::vector<double>& time_s, const PathView& paths, const std::string& name) {
  PageMap shown{.estimates = {{.name = name}}};
  for (const std::size_t k : spaced_steps(time_s.size(), kMostInstants)) {
    shown.time_s.push_back(time_s[k]);
    shown.sightings.emplace_back();
    const slam::Pose& truth = paths.truth[k];
    shown.truth.emplace_back(Eigen::Vector3d(truth.x_m, truth.y_m, truth.heading_rad));
    shown.estimates[0].path.emplace_back(paths.estimate[k].x_m, paths.estimate[k].y_m);
  }
  return shown;
}

}  // namespace stereobench::harness
