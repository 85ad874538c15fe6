#include "harness/detector/detection_lines.h"

#include <fmt/format.h>

#include "harness/json/json_line.h"
#include "slam/math/angles.h"
#include "vision/palette.h"
#include "vision/tuning/outline_fit.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using vision::BallObservation;

constexpr std::size_t kMostBalls = 1000;
constexpr double kMost_px = 1e6;
constexpr double kMost_m = 1e6;

Eigen::Vector2d read_pixel(const JsonValue& value) {
  const std::vector<JsonValue> parts = value.list(2, 2);
  return {parts[0].number(-kMost_px, kMost_px), parts[1].number(-kMost_px, kMost_px)};
}

Eigen::Matrix2d read_covariance(const JsonValue& value) {
  Eigen::Matrix2d covariance;
  const std::vector<JsonValue> rows = value.list(2, 2);
  for (int i = 0; i < 2; ++i) {
    const std::vector<JsonValue> row = rows[static_cast<std::size_t>(i)].list(2, 2);
    for (int j = 0; j < 2; ++j) {
      const double least = i == j ? 0.0 : -kMost_m;
      covariance(i, j) = row[static_cast<std::size_t>(j)].number(least, kMost_m * kMost_m);
    }
  }
  const double product = covariance(0, 0) * covariance(1, 1);
  if (covariance(0, 1) != covariance(1, 0) || covariance(0, 1) * covariance(0, 1) > product * (1.0 + 1e-9))
    value.refuse("a symmetric matrix without negative eigenvalues");
  return covariance;
}

/// Fills in what the pixels of both centres say.
void place_by_pixels(const JsonValue& value, const BallGeometry& geometry, BallObservation& ball) {
  ball.left_px = read_pixel(value.at("left_px"));
  ball.right_px = read_pixel(value.at("right_px"));
  const RectifiedCentres centres = rectified_centres(geometry, ball);
  if (!centres.left || !centres.right) value.at("left_px").refuse("pixels that the rig's lenses can reach");
  const auto place = place_of(geometry, centres);
  if (!place || place->z() > kMost_m)
    value.at("left_px").refuse("a column to the right of right_px's: a ball that is ahead");
  ball.ball_in_camera = *place;
  const auto expected = expected_outlines(geometry, ball);
  const auto left = value.find("left_radius_px");
  const auto right = value.find("right_radius_px");
  const auto radius_px = [](const auto& stated, const auto& outline) {
    return stated ? stated->number(kLeastPositive, kMost_px) : outline ? outline->radius_px() : 0.0;
  };
  ball.left_radius_px = radius_px(left, expected.left);
  ball.right_radius_px = radius_px(right, expected.right);
  ball.has_radii = left && right;
}

void place_by_range(const JsonValue& value, const BallGeometry& geometry, BallObservation& ball) {
  slam::RangeBearing& seen = ball.range_bearing;
  seen.range_m = value.at("range_m").number(kLeastPositive, kMost_m);
  seen.bearing_rad = value.at("bearing_rad").number(-slam::kPi, slam::kPi);
  if (ball.has_pixels) return;
  ball.ball_in_camera = at_camera_height(geometry.rig, seen);
  if (!imagine_pixels(geometry, ball) && !value.find("covariance"))
    value.refuse("a covariance beside a ball that is not ahead of both cameras");
}

BallObservation read_ball(const JsonValue& value, const BallGeometry& geometry) {
  value.allow({"colour", "name", "left_px", "right_px", "left_radius_px", "right_radius_px", "range_m",
               "bearing_rad", "covariance", "centre_sd_px", "truncated", "occluded"});
  BallObservation ball;
  const JsonValue colour = value.at("colour");
  if (!colour.is_null())
    ball.colour = static_cast<int>(colour.integer(0, static_cast<int>(vision::kPalette.size()) - 1));
  ball.has_pixels = value.find("left_px") || value.find("right_px");
  const bool has_range = value.find("range_m") || value.find("bearing_rad");
  if (!ball.has_pixels && !has_range)
    value.refuse("\"range_m\" and \"bearing_rad\", or \"left_px\" and \"right_px\"");
  ball.has_radii = false;
  if (ball.has_pixels) place_by_pixels(value, geometry, ball);
  if (has_range) place_by_range(value, geometry, ball);
  const auto covariance = value.find("covariance");
  const auto sd = value.find("centre_sd_px");
  if (covariance && sd) sd->refuse("no covariance beside it");
  const double sd_px = sd ? sd->number(kLeastPositive, kMost_px) : kUnstatedSd_px;
  const slam::RangeBearing stated = ball.range_bearing;
  if (!covariance || !has_range) ball.range_bearing = seen_through(geometry, ball, sd_px);
  if (has_range) ball.range_bearing.range_m = stated.range_m;
  if (has_range) ball.range_bearing.bearing_rad = stated.bearing_rad;
  if (covariance) ball.range_bearing.covariance = read_covariance(*covariance);
  ball.range_bearing.colour_class = ball.colour;
  if (const auto flag = value.find("truncated")) ball.truncated = flag->flag();
  if (const auto flag = value.find("occluded")) ball.occluded = flag->flag();
  return ball;
}

Json pixel_json(const Eigen::Vector2d& pixel) {
  return {pixel.x(), pixel.y()};
}

Json colour_json(int colour) {
  return colour == slam::kUnknown ? Json(nullptr) : Json(colour);
}

void add_name(Json& ball, int colour, std::span<const std::string> names) {
  const auto index = static_cast<std::size_t>(colour);
  if (colour != slam::kUnknown && index < names.size()) ball["name"] = names[index];
}

Json ball_json(const BallObservation& ball) {
  const slam::RangeBearing& seen = ball.range_bearing;
  Json json = {
      {"colour", colour_json(ball.colour)},
      {"range_m", seen.range_m},
      {"bearing_rad", seen.bearing_rad},
      {"covariance",
       {{seen.covariance(0, 0), seen.covariance(0, 1)}, {seen.covariance(1, 0), seen.covariance(1, 1)}}}};
  if (ball.has_pixels) {
    json["left_px"] = pixel_json(ball.left_px);
    json["right_px"] = pixel_json(ball.right_px);
  }
  if (ball.has_radii) {
    json["left_radius_px"] = ball.left_radius_px;
    json["right_radius_px"] = ball.right_radius_px;
  }
  if (ball.truncated) json["truncated"] = true;
  if (ball.occluded) json["occluded"] = true;
  return json;
}

Json frame_json(std::size_t frame, std::span<const std::string> pictures) {
  Json json = {{"frame", frame}};
  if (!pictures.empty()) json["left"] = pictures[0];
  if (pictures.size() > 1) json["right"] = pictures[1];
  return json;
}

}  // namespace

std::vector<BallObservation> read_detections(const std::string& line, std::size_t frame,
                                             const BallGeometry& geometry) {
  const nlohmann::json json = parse_line(line);
  const JsonValue value(json, "");
  value.allow({"frame", "left", "right", "balls"});
  value.at("frame").integer(static_cast<std::int64_t>(frame), static_cast<std::int64_t>(frame));
  std::vector<BallObservation> balls;
  for (const JsonValue& ball : value.at("balls").list(0, kMostBalls))
    balls.push_back(read_ball(ball, geometry));
  return balls;
}

std::string detections_line(std::size_t frame, std::span<const BallObservation> balls,
                            std::span<const std::string> pictures, std::span<const std::string> names) {
  Json json = frame_json(frame, pictures);
  json["balls"] = Json::array();
  for (const BallObservation& ball : balls) {
    json["balls"].push_back(ball_json(ball));
    add_name(json["balls"].back(), ball.colour, names);
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string outlines_line(std::size_t frame, std::span<const vision::MeasuredOutline> outlines,
                          const std::string& picture, std::span<const std::string> names) {
  Json json = frame_json(frame, std::span(&picture, 1));
  json["balls"] = Json::array();
  for (const vision::MeasuredOutline& outline : outlines) {
    Json ball = {{"colour", colour_json(outline.colour)},
                 {"left_px", pixel_json(outline.centre_px)},
                 {"left_radius_px", outline.radius_px}};
    add_name(ball, outline.colour, names);
    if (outline.outside_fraction > vision::kOutlineFit.most_hidden) ball["truncated"] = true;
    if (outline.hidden_fraction > vision::kOutlineFit.most_hidden) ball["occluded"] = true;
    json["balls"].push_back(std::move(ball));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stereobench::harness
