#include "harness/dataset/palette_file.h"

#include <set>
#include <stdexcept>

#include <Eigen/LU>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/io/text_file.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kVersion = 2;
constexpr std::int64_t kOfLight = 1;  // the version whose colours were learned in 8 bits of linear light
constexpr double kLeastVariance = 1e-8;

const char* name_of(worlds::Encoding encoding) {
  return encoding == worlds::Encoding::kSrgb ? "srgb" : "linear";
}

std::vector<double> numbers(const JsonValue& value, std::size_t count, double least, double most) {
  std::vector<double> result;
  for (const JsonValue& entry : value.list(count, count)) result.push_back(entry.number(least, most));
  return result;
}

vision::LearnedColour read_colour(const JsonValue& value) {
  value.allow({"name", "chromaticity_rg", "covariance", "darkest_level", "rgb"});
  vision::LearnedColour colour;
  colour.name = value.at("name").text();
  if (colour.name.empty()) value.at("name").refuse("a name");
  const auto mean = numbers(value.at("chromaticity_rg"), 2, 0.0, 1.0);
  colour.chromaticity = {mean[0], mean[1]};
  const auto rows = value.at("covariance").list(2, 2);
  for (int row = 0; row < 2; ++row) {
    const auto entries = numbers(rows[static_cast<std::size_t>(row)], 2, -1.0, 1.0);
    colour.covariance.row(row) = Eigen::RowVector2d(entries[0], entries[1]);
  }
  const bool is_covariance = colour.covariance.isApprox(colour.covariance.transpose()) &&
                             colour.covariance.diagonal().minCoeff() >= kLeastVariance &&
                             colour.covariance.determinant() >= kLeastVariance * kLeastVariance;
  if (!is_covariance) value.at("covariance").refuse("a symmetric, positive matrix");
  colour.darkest_level = value.at("darkest_level").number(0.0, 255.0);
  const auto rgb = numbers(value.at("rgb"), 3, 0.0, 255.0);
  colour.bgr = {rgb[2], rgb[1], rgb[0]};
  return colour;
}

PaletteFile read(const JsonValue& value) {
  value.allow({"format", "version", "encoding", "colours"});
  if (value.at("format").text() != "stereobench-palette")
    value.at("format").refuse("\"stereobench-palette\"");
  const std::int64_t version = value.at("version").integer(kOfLight, kVersion);
  PaletteFile palette;
  const std::string encoding = value.at("encoding").text();
  if (encoding != "linear" && encoding != "srgb") value.at("encoding").refuse("\"linear\" or \"srgb\"");
  palette.encoding = encoding == "srgb" ? worlds::Encoding::kSrgb : worlds::Encoding::kLinear;
  if (version == kOfLight && palette.encoding == worlds::Encoding::kSrgb)
    value.at("version").refuse(
        "2, of sRGB: colours are learned in levels as they are stored since; learn them again");
  std::set<std::string> names;
  for (const JsonValue& entry : value.at("colours").list(1, vision::kBackground - 1U)) {
    palette.colours.push_back(read_colour(entry));
    if (!names.insert(palette.colours.back().name).second) entry.at("name").refuse("a name of its own");
  }
  return palette;
}

}  // namespace

std::string palette_json(const PaletteFile& palette) {
  Json json = {
      {"format", "stereobench-palette"}, {"version", kVersion}, {"encoding", name_of(palette.encoding)}};
  json["colours"] = Json::array();
  for (const vision::LearnedColour& colour : palette.colours) {
    const Eigen::Matrix2d& c = colour.covariance;
    json["colours"].push_back({{"name", colour.name},
                               {"chromaticity_rg", {colour.chromaticity.x(), colour.chromaticity.y()}},
                               {"covariance", {{c(0, 0), c(0, 1)}, {c(1, 0), c(1, 1)}}},
                               {"darkest_level", colour.darkest_level},
                               {"rgb", {colour.bgr[2], colour.bgr[1], colour.bgr[0]}}});
  }
  return json.dump(2) + "\n";
}

PaletteFile parse_palette(const std::string& text, const fs::path& name) {
  try {
    const nlohmann::json json = parse_line(text);
    return read(JsonValue(json, ""));
  } catch (const BadLine& error) {
    throw std::runtime_error(fmt::format("{}: {}", name.string(), error.what()));
  }
}

PaletteFile read_palette(const fs::path& file) {
  return parse_palette(read_text(file), file);
}

}  // namespace stereobench::harness
