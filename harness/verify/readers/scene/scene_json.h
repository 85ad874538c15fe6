/// Numbers of other people's JSON.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "harness/json/json_line.h"

namespace stereobench::harness {

/// No length or place is larger.
inline constexpr double kMostNumber = 1e12;

inline double number_of(const JsonValue& value) {
  return value.number(-kMostNumber, kMostNumber);
}

/// A key's number, or another one where there is no such key.
inline double number_or(const JsonValue& json, std::string_view key, double otherwise) {
  const auto value = json.find(key);
  return value ? number_of(*value) : otherwise;
}

/// A list of so many numbers. @param digits is given them as text where it is not null
std::vector<double> numbers_of(const JsonValue& list, std::size_t count,
                               std::vector<std::string>* digits = nullptr);

/// [left, top, width, height] in whole pixels, as we write it; empty where a side is not positive.
cv::Rect box_in(const JsonValue& value);

/// Nine numbers, row by row, and three, as a pose.
Eigen::Isometry3d pose_of(const std::vector<double>& turn, const std::vector<double>& place);

}  // namespace stereobench::harness
