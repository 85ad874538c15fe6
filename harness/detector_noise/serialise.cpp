#include "harness/detector_noise/serialise.h"

#include "harness/json/cbor.h"
#include "harness/vision_scoring/vision_score_json.h"

namespace stereobench::harness {

STEREOBENCH_ALL_FIELDS(BallBounds, of_size, unknown_size)
STEREOBENCH_ALL_FIELDS(CalibrationSample, truth, error, stated, bounds, disparity_error_px, radius_error_px,
                       depth_m, whole)
STEREOBENCH_ALL_FIELDS(CalibrationTake, samples, score)

std::string to_bytes(const CalibrationTake& take) {
  return bytes_of(take);
}

CalibrationTake calibration_take_from_bytes(std::string_view bytes) {
  return json_of(bytes).get<CalibrationTake>();
}

}  // namespace stereobench::harness
