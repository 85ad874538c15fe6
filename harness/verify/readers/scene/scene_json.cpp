#include "harness/verify/readers/scene/scene_json.h"

#include <array>

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

cv::Rect box_in(const JsonValue& value) {
  std::array<int, 4> box{};
  const auto numbers = value.list(4, 4);
  for (std::size_t i = 0; i < box.size(); ++i) box[i] = static_cast<int>(numbers[i].integer(-1, 1 << 20));
  return box[2] <= 0 || box[3] <= 0 ? cv::Rect() : cv::Rect(box[0], box[1], box[2], box[3]);
}

Eigen::Isometry3d pose_of(const std::vector<double>& turn, const std::vector<double>& place) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < 9; ++i)
    pose.matrix()(static_cast<int>(i / 3), static_cast<int>(i % 3)) = turn[i];
  pose.translation() << place[0], place[1], place[2];
  return pose;
}

}  // namespace stereobench::harness
