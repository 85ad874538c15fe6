/// How far a picture is out of focus, as the edges of balls tell.
#pragma once

#include <array>
#include <cstddef>

namespace stereobench::vision {

/// How much of the ball pixels show by their distance from an outline, whose inside is the outside's mirror
/// image: 1 - share there is the share here.
class EdgeProfile {
 public:
  /// @param distance_px from the outline, positive outside
  /// @param shown, whole how much of the ball the pixel shows, and would show if the ball covered it
  /// @param weight inverse variance of `shown`
  void add(double distance_px, double shown, double whole, double weight);
  void add(const EdgeProfile& other);

  /// Fits the blur to the profile (blurred_coverage in edge.h) by least squares, Gauss-Newton on its square.
  /// @return standard deviation of the Gaussian that the picture makes of a point, px, in [0, 3]; 0 where
  ///         nothing was added
  double blur_px() const;

 private:
  static constexpr std::size_t kBins = 32;
  static constexpr double kBin_px = 0.15;

  std::array<double, kBins> shown_{};  ///< times whole and weight
  std::array<double, kBins> whole_{};  ///< squared, times weight
};

}  // namespace stereobench::vision
