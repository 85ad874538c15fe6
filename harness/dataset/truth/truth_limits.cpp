#include "harness/dataset/truth/truth_limits.h"

#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

/// The line of the scenario with which there is no such truth; empty where there is.
std::string obstacle(TruthKind kind, const vision::Distortion& lens, const worlds::Shutter& shutter) {
  const bool has_lens = !(lens == vision::Distortion{});
  const std::string key =
      lens == vision::Distortion{.pixel_aspect = lens.pixel_aspect} ? "rig.pixel_aspect" : "rig.distortion";
  const bool rolls = shutter.readout_s != 0.0;
  switch (kind) {
    case TruthKind::kSurface:
    case TruthKind::kRange:
    case TruthKind::kNormal:
      return has_lens && rolls ? "shutter.readout_s behind " + key : "";
    case TruthKind::kBalls:
      return has_lens ? key : rolls ? "shutter.readout_s" : "";
    case TruthKind::kDisparity:
    case TruthKind::kMatch:
      return rolls ? "shutter.readout_s" : "";
    case TruthKind::kFlow:
      if (rolls) return "shutter.readout_s";
      if (shutter.drop_probability > 0.0) return "shutter.drop_probability";
      return shutter.late_probability > 0.0 ? "shutter.late_probability" : "";
  }
  throw std::invalid_argument("require_truth: no such kind of truth");
}

}  // namespace

void require_truth(const TruthRequest& request, const vision::StereoRig& rig,
                   const worlds::Shutter& shutter) {
  for (const TruthKind kind : request.kinds) {
    const std::string line = obstacle(kind, rig.distortion, shutter);
    if (!line.empty())
      throw std::runtime_error(fmt::format("--truth {}: there is none with {}", name_of(kind), line));
  }
}

}  // namespace stereobench::harness
