/// Truth of balls as JSON lines and CSV, and of surfaces as CSV.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/truth/ball_truth.h"

namespace stereobench::harness {

/// One line a ball: ball_id and colour as in balls.csv, centre_in_camera_m, centre_px (the centre projected),
/// outline (an ellipse: centre_px, semi_axes_px, angle_rad), and by BOP's names px_count_all, px_count_visib,
/// visib_fract, bbox_obj, bbox_visib ([left, top, width, height], four times -1 for none); truncated.
std::string ball_lines(const worlds::World& world, std::span<const renderer::BallTruth> truths);

/// Reads what ball_lines writes, exactly. Colours are not read: they are the world's.
/// @param balls how many the world has
/// @param name of the file, for errors
/// @throws std::runtime_error "file:line: key: what was expected"
std::vector<renderer::BallTruth> parse_ball_lines(const std::string& text, std::size_t balls,
                                                  const std::string& name);

/// The balls as CSV: ball_id, colour, its RGB, centre and radius.
std::string balls_csv(const worlds::World& world);

/// What each number of a surface picture is: surface_id, kind, index in the scenario's list of that kind.
std::string surfaces_csv(const worlds::World& world);

}  // namespace stereobench::harness
