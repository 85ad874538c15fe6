/// What is known of a ball in a picture, by the names of BOP.
#pragma once

#include <nlohmann/json.hpp>

#include "renderer/truth/ball_truth.h"

namespace stereobench::harness {

/// @return [left, top, width, height]; four times -1 for none
nlohmann::ordered_json bop_box(const cv::Rect& box);

/// px_count_all, px_count_visib, visib_fract, bbox_obj, bbox_visib.
nlohmann::ordered_json bop_numbers(const renderer::BallTruth& truth);

}  // namespace stereobench::harness
