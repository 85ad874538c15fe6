#include "harness/page/page_json.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/page/base64.h"
#include "harness/page/text_alternative.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

Json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  constexpr double kLargestExact = 9e15;
  const double shown = std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
  if (std::abs(shown) < kLargestExact && std::trunc(shown) == shown) return static_cast<std::int64_t>(shown);
  return shown;
}

Json rounded_list(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(rounded(value));
  return list;
}

/// Two numbers a point, one after the other.
Json flat(const std::vector<Eigen::Vector2d>& points) {
  Json list = Json::array();
  for (const Eigen::Vector2d& point : points)
    for (const double value : point) list.push_back(rounded(value));
  return list;
}

/// The numbers of a symmetric matrix: xx, xy, yy.
Json flat(const Eigen::Matrix2d& covariance) {
  return {rounded(covariance(0, 0)), rounded(covariance(0, 1)), rounded(covariance(1, 1))};
}

const char* text_of(CellMark mark) {
  switch (mark) {
    case CellMark::kGood:
      return "good";
    case CellMark::kBad:
      return "bad";
    case CellMark::kUnsure:
      return "unsure";
    case CellMark::kNone:
      break;
  }
  return "";
}

const char* text_of(Fate fate) {
  switch (fate) {
    case Fate::kFound:
      return "found";
    case Fate::kMissed:
      return "missed";
    case Fate::kWrong:
      return "wrong";
    case Fate::kFalse:
      return "false";
    case Fate::kOther:
      break;
  }
  return "other";
}

const char* text_of(Look look) {
  switch (look) {
    case Look::kDashes:
      return "dashes";
    case Look::kPoints:
      return "points";
    case Look::kBand:
      return "band";
    case Look::kLine:
      break;
  }
  return "line";
}

/// A text alone where there is no more to say.
Json cell_json(const PageCell& cell) {
  Json json = {{"text", cell.text}};
  if (cell.number) json["number"] = rounded(*cell.number);
  if (cell.mark != CellMark::kNone) json["mark"] = text_of(cell.mark);
  if (!cell.link.empty()) json["link"] = cell.link;
  if (cell.interval)
    json["interval"] = {rounded(cell.interval->low), rounded(cell.interval->value),
                        rounded(cell.interval->high)};
  return json.size() == 1 ? Json(cell.text) : json;
}

Json content_json(const PageText& text) {
  return {{"kind", "text"}, {"lines", text.lines}};
}

Json content_json(const PageTable& table) {
  Json rows = Json::array();
  for (const PageRow& row : table.rows) {
    if (row.cells.size() != table.header.size())
      throw std::invalid_argument("a row of a page's table is not as long as the header");
    Json cells = Json::array();
    for (const PageCell& cell : row.cells) cells.push_back(cell_json(cell));
    rows.push_back({{"cells", std::move(cells)}, {"quiet", row.is_quiet}});
  }
  return {{"kind", "table"}, {"header", table.header}, {"quiet", table.quiet}, {"rows", std::move(rows)}};
}

Json series_json(const Series& series) {
  const std::size_t count = series.x.size();
  const bool is_band = series.look == Look::kBand;
  const bool has_interval = is_band || !series.low.empty();
  if (series.y.size() != (is_band ? 0 : count) || series.low.size() != (has_interval ? count : 0) ||
      series.high.size() != series.low.size())
    throw std::invalid_argument("a series of a page's chart has not as many numbers as x has");
  return {
      {"name", series.name},         {"look", text_of(series.look)},    {"x", rounded_list(series.x)},
      {"y", rounded_list(series.y)}, {"low", rounded_list(series.low)}, {"high", rounded_list(series.high)}};
}

Json content_json(const PageCharts& block) {
  Json charts = Json::array();
  for (const Chart& chart : block.charts) {
    Json series = Json::array();
    for (const Series& one : chart.series) series.push_back(series_json(one));
    charts.push_back({{"name", chart.name},
                      {"x", chart.x_label},
                      {"y", chart.y_label},
                      {"log_x", chart.x_is_logarithmic},
                      {"log_y", chart.y_is_logarithmic},
                      {"x_names", chart.x_names},
                      {"words", text_alternative(chart)},
                      {"series", std::move(series)}});
  }
  return {{"kind", "charts"}, {"charts", std::move(charts)}};
}

Json estimate_json(const PageEstimate& estimate) {
  Json covariances = Json::array();
  for (const Eigen::Matrix2d& covariance : estimate.covariances) covariances.push_back(flat(covariance));
  Json landmarks = Json::array();
  for (const PageEstimate::Landmark& landmark : estimate.landmarks)
    landmarks.push_back({{"at", flat(std::vector{landmark.position_m})},
                         {"covariance", flat(landmark.covariance)},
                         {"true_one", landmark.true_one ? Json(*landmark.true_one) : Json(nullptr)}});
  return {{"name", estimate.name},
          {"path", flat(estimate.path)},
          {"covariances", std::move(covariances)},
          {"landmarks", std::move(landmarks)}};
}

Json content_json(const PageMap& map) {
  Json json = {{"kind", "map"}, {"words", text_alternative(map)}, {"time_s", rounded_list(map.time_s)}};
  for (const char* key : {"walls", "truth", "sightings", "landmarks", "estimates"}) json[key] = Json::array();
  for (const auto& wall : map.walls) json["walls"].push_back(flat(wall));
  for (const auto& pose : map.truth)
    json["truth"].push_back(pose ? rounded_list({pose->x(), pose->y(), pose->z()}) : Json(nullptr));
  for (const auto& seen : map.sightings) json["sightings"].push_back(flat(seen));
  for (const PageMap::Landmark& landmark : map.landmarks)
    json["landmarks"].push_back(
        {{"at", flat(std::vector{landmark.position_m})}, {"colour", landmark.colour}});
  for (const PageEstimate& estimate : map.estimates) json["estimates"].push_back(estimate_json(estimate));
  return json;
}

/// Pixels to a tenth.
Json pixels_json(const std::vector<Eigen::Vector2d>& points_px) {
  constexpr double kTenths = 10.0;
  std::vector<Eigen::Vector2d> shown;
  for (const Eigen::Vector2d& point : points_px)
    shown.emplace_back((kTenths * point).array().round() / kTenths);
  return flat(shown);
}

Json panel_json(const FramePanel& panel) {
  Json json = {{"title", panel.title}, {"picture", panel.picture ? Json(*panel.picture) : Json(nullptr)}};
  json["truth"] = json["detections"] = Json::array();
  for (const TrueOutline& outline : panel.truth)
    json["truth"].push_back({{"corners", pixels_json(outline.corners_px)},
                             {"label", outline.label},
                             {"fate", text_of(outline.fate)}});
  for (const SeenCentre& seen : panel.detections)
    json["detections"].push_back(
        {{"at", pixels_json({seen.centre_px})}, {"label", seen.label}, {"fate", text_of(seen.fate)}});
  return json;
}

Json content_json(const PageFrames& block) {
  Json json = {{"kind", "frames"}, {"width_px", block.width_px}, {"height_px", block.height_px}};
  json["pictures"] = json["frames"] = Json::array();
  for (const std::string& jpeg : block.jpegs) json["pictures"].push_back(base64(jpeg));
  for (const PageFrame& frame : block.frames) {
    Json panels = Json::array();
    for (const FramePanel& panel : frame.panels) panels.push_back(panel_json(panel));
    json["frames"].push_back({{"title", frame.title},
                              {"note", frame.note},
                              {"command", frame.command},
                              {"panels", std::move(panels)}});
  }
  return json;
}

}  // namespace

nlohmann::ordered_json page_json(const Page& page) {
  Json blocks = Json::array();
  for (const Block& block : page.blocks)
    blocks.push_back(
        {{"title", block.title},
         {"note", block.note},
         {"commands", block.commands},
         {"identity", block.identity},
         {"chapter", block.is_chapter},
         {"content", std::visit([](const auto& content) { return content_json(content); }, block.content)}});
  return {{"title", page.title}, {"facts", page.facts}, {"blocks", std::move(blocks)}};
}

}  // namespace stereobench::harness
