/// Stereo pairs that are kept to be looked at: those in which a detector did worst.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "harness/vision_scoring/vision_score.h"
#include "vision/types.h"

namespace stereobench::harness {

/// How wrong the detections of a stereo pair are.
struct PairBadness {
  long faults = 0;         ///< balls missed or taken for another colour, detections of no ball or repeated
  double worst_nis = 0.0;  ///< the largest e' R^-1 e / 2 of a right detection; 0 where there is none
};

/// @param score of one pair
PairBadness badness_of(const VisionScore& score);

/// A stereo pair that is kept.
struct KeptPair {
  std::uint64_t seed = 0;
  std::size_t frame = 0;  ///< the step of the path
  PairBadness badness;
  std::string left_jpeg;  ///< the bytes of a file; as wide as the camera's picture, or kWidestKept
  std::string right_jpeg;
};

/// Wider pictures are made smaller before they are kept.
inline constexpr int kWidestKept_px = 1024;

/// Whether a pair is to be shown before another: it has more faults, or as many and a larger error, or all is
/// alike and it comes first by seed and frame.
bool is_worse(const KeptPair& pair, const KeptPair& other);

/// Puts JPEGs of both pictures into a kept pair.
/// @param pair CV_8UC3 pictures as screens show them
void keep_pictures(KeptPair& kept, const vision::StereoPair& pair);

/// Chooses the worst of pairs that come one after the other.
class WorstPairs {
 public:
  /// @param most how many are kept
  explicit WorstPairs(std::size_t most) : most_(most) {}

  /// Offers a pair.
  /// @param take_pictures called if it is kept, for a pair whose pictures were not taken yet
  void offer(KeptPair pair, const std::function<void(KeptPair&)>& take_pictures = {});

  /// The worst first.
  const std::vector<KeptPair>& pairs() const { return pairs_; }

 private:
  std::size_t most_;
  std::vector<KeptPair> pairs_;
};

/// The first of some pairs whose pictures have so many bytes at most, all together.
std::vector<KeptPair> within_bytes(const std::vector<KeptPair>& pairs, std::size_t most_bytes);

}  // namespace stereobench::harness
