#include "harness/dataset/truth/bop_numbers.h"

namespace stereobench::harness {

nlohmann::ordered_json bop_box(const cv::Rect& box) {
  if (box.empty()) return {-1, -1, -1, -1};
  return {box.x, box.y, box.width, box.height};
}

nlohmann::ordered_json bop_numbers(const renderer::BallTruth& truth) {
  return {{"px_count_all", truth.px_count_all},
          {"px_count_visib", truth.px_count_visib},
          {"visib_fract", truth.visib_fract},
          {"bbox_obj", bop_box(truth.bbox_obj)},
          {"bbox_visib", bop_box(truth.bbox_visib)}};
}

}  // namespace stereobench::harness
