/// What truth somebody wants beside the pictures of a data set.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

enum class TruthKind {
  kBalls,      ///< each ball's outline, counts and boxes
  kSurface,    ///< which wall, mesh, ball or floor
  kRange,      ///< along the ray
  kNormal,     ///< of the geometry, in the camera frame
  kDisparity,  ///< columns, and what becomes of the pixel in the other camera
  kMatch,      ///< the whole shift to the other camera, for rigs that are not rectified
  kFlow        ///< the shift to the next step's picture of the same camera
};

/// How truth that is no whole number is written.
enum class TruthFormat {
  kExact,  ///< 32-bit floats (PFM)
  kKitti,  ///< disparity, matches and flow as KITTI's 16-bit PNGs: 1/256 and 1/64 px; the rest as PFM
  kTiff    ///< 32-bit floats, compressed (TIFF)
};

struct TruthRequest {
  std::vector<TruthKind> kinds;  ///< each once, in the order of TruthKind
  TruthFormat format = TruthFormat::kExact;
};

/// What the command line and folders call it: "balls", "surface", "range", "normal", "disparity", "match",
/// "flow".
const char* name_of(TruthKind kind);

/// Reads "disparity,flow" or "all".
/// @throws std::runtime_error that lists the names there are
std::vector<TruthKind> parse_truth(const std::string& text);

/// What the command line and folders call it: "exact", "kitti", "tiff".
const char* name_of(TruthFormat format);

/// Reads such a name. @throws std::runtime_error for another
TruthFormat parse_truth_format(const std::string& text);

/// How files of floats end: ".pfm" or ".tiff".
const char* float_extension(TruthFormat format);

}  // namespace stereobench::harness
