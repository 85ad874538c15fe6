#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "slam/math/elementary.h"
#include "slam/models/motion.h"
#include "worlds/drive/smooth_path.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::worlds {
namespace {

constexpr std::string_view kOwnHeader = "t_s,x_m,y_m,theta_rad";
constexpr double kLargest = 1e12;  // times may be counted from 1970

/// Where in a file something is wrong.
struct Place {
  const std::filesystem::path& file;
  int line;

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, what));
  }
};

std::vector<double> numbers_in(std::string_view text, char separator, std::size_t count, const Place& place) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (true) {
    double number = 0.0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !(std::abs(number) <= kLargest))
      place.refuse(fmt::format("expected {} finite numbers (got '{}')", count, excerpt(text)));
    numbers.push_back(number);
    if (next == end) break;
    if (*next != separator)
      place.refuse(fmt::format("expected {} finite numbers (got '{}')", count, excerpt(text)));
    at = next + 1;
  }
  if (numbers.size() != count)
    place.refuse(fmt::format("expected {} numbers (got {})", count, numbers.size()));
  return numbers;
}

/// The heading of a rotation: the direction of its x axis on the floor.
double heading_of_quaternion(double qx, double qy, double qz, double qw, const Place& place) {
  const double norm = qx * qx + qy * qy + qz * qz + qw * qw;
  if (!(std::abs(norm - 1.0) < 0.01)) place.refuse("expected a unit quaternion");
  return slam::arc_tangent(2.0 * (qw * qz + qx * qy), norm - 2.0 * (qy * qy + qz * qz));
}

TimedPose own_pose(std::string_view text, const Place& place) {
  const std::vector<double> n = numbers_in(text, ',', 4, place);
  return {n[0], {n[1], n[2], slam::wrap_angle(n[3])}};
}

TimedPose tum_pose(std::string_view text, const Place& place) {
  const std::vector<double> n = numbers_in(text, ' ', 8, place);
  return {n[0], {n[1], n[2], heading_of_quaternion(n[4], n[5], n[6], n[7], place)}};
}

}  // namespace

std::vector<TimedPose> read_trajectory(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  std::vector<TimedPose> poses;
  bool is_own = false;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (text.empty() || text.front() == '#') continue;
    const Place place{file, line};
    if (poses.empty() && !is_own && text == kOwnHeader) {
      is_own = true;
      continue;
    }
    poses.push_back(is_own ? own_pose(text, place) : tum_pose(text, place));
    if (poses.size() > 1 && !(poses.back().time_s > poses[poses.size() - 2].time_s))
      place.refuse("expected a time after the one before");
  }
  if (poses.size() < 2)
    throw std::runtime_error(fmt::format("{}: expected a trajectory of two poses at least", file.string()));
  return poses;
}

}  // namespace stereobench::worlds
