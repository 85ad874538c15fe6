/// Random numbers that depend on nothing but their key: seed, stream and index.
#pragma once

#include <array>
#include <cstdint>

namespace stereobench::slam {

/// Who draws. Each purpose has numbers of its own, so that a draw added to one moves no other.
enum class Stream : std::uint32_t {
  kWorld,
  kOdometry,
  kImageNoise,
  kOracle,
  kFilter,
  kClutter,
  kShotNoise,
  kReadNoise,
  kFrameLoss,
  kCalibrationScene,
  kRandomise,
  kBallRadius,
  kStart,
  kResample,
  kDetectorFault
};

/// The standard normal quantile, Wichura's algorithm AS 241 (relative error about 1e-16).
///
/// @param probability in (0, 1)
/// @return x with Phi(x) = probability
double normal_quantile(double probability);

/// A sequence of random numbers from the counter-based generator Philox4x32-10 (Salmon et al., SC 2011).
///
/// The key is the seed; the counter holds stream, index and position. Two streams never share a number, and
/// equal arguments give equal numbers on every machine.
class RandomStream {
 public:
  /// @param seed any value; 0 is a seed like all others
  /// @param stream what the numbers are for
  /// @param index tells apart sequences of one purpose, e.g. frames
  RandomStream(std::uint64_t seed, Stream stream, std::uint64_t index = 0);

  /// @return 32 uniform bits
  std::uint32_t bits();

  /// @return uniform in [0, 1), a multiple of 2^-53
  double uniform();

  /// @return standard normal, by inversion: one number of 52 bits gives one normal, nothing is kept back
  double normal();

 private:
  void refill();
  std::uint64_t wide_bits();

  std::uint64_t seed_;
  std::uint64_t index_;
  std::uint32_t stream_;
  std::uint64_t block_ = 0;
  std::array<std::uint32_t, 4> words_{};
  unsigned used_ = 4;
};

}  // namespace stereobench::slam
