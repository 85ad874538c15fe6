#include "harness/verify/readers/scene/scene_json.h"

#include <fmt/format.h>

namespace stereobench::harness {

std::vector<double> numbers_of(const JsonValue& list, std::size_t count, std::vector<std::string>* digits) {
  std::vector<double> numbers;
  for (const JsonValue& value : list.list(count, count)) {
    numbers.push_back(number_of(value));
    if (digits != nullptr) digits->push_back(fmt::format("{}", numbers.back()));
  }
  return numbers;
}

Eigen::Isometry3d pose_of(const std::vector<double>& turn, const std::vector<double>& place) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < 9; ++i)
    pose.matrix()(static_cast<int>(i / 3), static_cast<int>(i % 3)) = turn[i];
  pose.translation() << place[0], place[1], place[2];
  return pose;
}

}  // namespace stereobench::harness
