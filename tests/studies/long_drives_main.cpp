/// How the cost of a step grows with the length of a drive: rows up and down a field whose map keeps growing.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <sys/resource.h>

#include "slam/filter_registry.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
namespace {

constexpr double kSpacing_m = 5.0;  ///< of landmarks
constexpr double kJitter_m = 1.5;
constexpr double kRow_m = 10.0;  ///< from one row to the next
constexpr double kSpeed_mps = 1.0;
constexpr double kStep_s = 0.5;
constexpr double kReach_m = 9.0;
constexpr double kRangeSd_m = 0.1;
constexpr double kBearingSd_rad = 0.02;
const OdometryNoise kOdometry{0.1, 0.0, 0.0, 0.035, 0.0, 0.0};

/// Landmarks between and beside rows.
std::vector<Eigen::Vector2d> field(double length_m, int rows) {
  RandomStream jitter(1, Stream::kOracle);
  std::vector<Eigen::Vector2d> places;
  for (double y = -0.5 * kSpacing_m; y < kRow_m * rows; y += kSpacing_m) {
    for (double x = 0.0; x <= length_m; x += kSpacing_m)
      places.emplace_back(x + kJitter_m * (2.0 * jitter.uniform() - 1.0), y);
  }
  return places;
}

/// A row there, a half circle, the next row back, and so on.
Control control_of(int step, double length_m) {
  const int along = static_cast<int>(std::lround(length_m / (kSpeed_mps * kStep_s)));
  const double turn_m = M_PI * 0.5 * kRow_m;
  const int around = static_cast<int>(std::ceil(turn_m / (kSpeed_mps * kStep_s)));
  const int row = step / (along + around);
  if (step % (along + around) < along) return {kSpeed_mps, 0.0, kStep_s};
  const double way = row % 2 == 0 ? 1.0 : -1.0;
  return {turn_m / (around * kStep_s), way * M_PI / (around * kStep_s), kStep_s};
}

std::vector<RangeBearing> look(const Pose& truth, const std::vector<Eigen::Vector2d>& places,
                               RandomStream& noise) {
  std::vector<RangeBearing> seen;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d exact = predict_sighting(truth, places[i]);
    if (exact.x() < 0.5 || exact.x() > kReach_m || std::abs(exact.y()) > M_PI / 2.0) continue;
    RangeBearing one;
    one.range_m = exact.x() + kRangeSd_m * noise.normal();
    one.bearing_rad = wrap_angle(exact.y() + kBearingSd_rad * noise.normal());
    one.covariance = Eigen::Vector2d(kRangeSd_m * kRangeSd_m, kBearingSd_rad * kBearingSd_rad).asDiagonal();
    one.landmark_id = static_cast<int>(i);
    seen.push_back(one);
  }
  return seen;
}

long peak_memory_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// What the steps of a part of the drive took, and how wrong they were.
struct Part {
  std::vector<double> step_ms;
  double nees = 0.0;  ///< a third of it, summed: 1 a step is consistent

  void add(const Filter& filter, const Pose& truth, double took_ms) {
    const Estimate now = estimate_without_map(filter);
    const Eigen::Vector3d off = boxminus(now.pose, truth);
    nees += off.dot(now.covariance.ldlt().solve(off)) / 3.0;
    step_ms.push_back(took_ms);
  }

  void print(const Filter& filter, const Pose& truth, int steps) {
    std::ranges::sort(step_ms);
    const auto count = static_cast<double>(step_ms.size());
    const Estimate now = estimate(filter);
    fmt::print("{:>7} {:>10} {:>9.2f} {:>9.2f} {:>9.1f} {:>7.2f} {:>9.3f} {:>9}\n", steps,
               now.landmarks.size(), step_ms[step_ms.size() / 2],
               std::accumulate(step_ms.begin(), step_ms.end(), 0.0) / count, step_ms.back(), nees / count,
               boxminus(now.pose, truth).head<2>().norm(), peak_memory_kb() / 1024);
    std::fflush(stdout);
  }
};

/// Prints a line for each tenth of a drive.
void drive(const std::string& name, double length_m, int steps) {
  using Clock = std::chrono::steady_clock;
  const int rows = 2 + static_cast<int>(steps * kStep_s * kSpeed_mps / length_m);
  const std::vector<Eigen::Vector2d> places = field(length_m, rows);
  RandomStream odometry(1, Stream::kOdometry);
  RandomStream sensor(2, Stream::kOracle);
  Filter filter = make_filter(name, {.odometry_noise = kOdometry}, {}, 1);
  Pose truth;
  Part part;
  fmt::print("{}, rows of {:.0f} m\n{:>7} {:>10} {:>9} {:>9} {:>9} {:>7} {:>9} {:>9}\n", name, length_m,
             "steps", "landmarks", "median ms", "mean ms", "worst ms", "NEES/3", "error m", "memory MB");
  for (int k = 1; k <= steps; ++k) {
    const Control control = control_of(k - 1, length_m);
    truth = advance(truth, control);
    const std::vector<RangeBearing> frame = look(truth, places, sensor);
    const Control told = perturb(control, kOdometry, odometry);
    const auto start = Clock::now();
    predict(filter, told);
    update(filter, frame);
    part.add(filter, truth, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    if (k % std::max(1, steps / 10) != 0) continue;
    part.print(filter, truth, k);
    part = {};
  }
}

}  // namespace
}  // namespace stereobench::slam

int main(int argc, char** argv) {
  try {
    if (argc != 4 || !(std::stod(argv[2]) >= 10.0) || std::stoi(argv[3]) < 1)
      throw std::invalid_argument(
          "usage: stereobench_long_drives FILTER ROW_LENGTH_M STEPS, rows of 10 m or more");
    stereobench::slam::drive(argv[1], std::stod(argv[2]), std::stoi(argv[3]));
  } catch (const std::exception& error) {
    fmt::print(stderr, "stereobench_long_drives: {}\n", error.what());
    return 2;
  }
  return 0;
}
