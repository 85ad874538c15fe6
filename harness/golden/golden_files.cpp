#include "harness/golden/golden_files.h"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/io/atomic_file.h"
#include "harness/io/json_file.h"
#include "harness/io/picture_file.h"
#include "harness/io/picture_reader.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kLargest = 65535;

/// What decides before pictures are read.
struct PictureHashes {
  std::string seen, colour, shown;
  bool operator==(const PictureHashes&) const = default;
};

struct GoldenFacts {
  int width_px = 0, height_px = 0, smaller = 1, first_mesh = 0;
  bool is_linear = true;
  PictureHashes left, right;
  bool operator==(const GoldenFacts&) const = default;
};

PictureHashes hashes_of(const GoldenPicture& picture) {
  return {picture.seen_sha256, pixels_sha256(picture.colour), pixels_sha256(picture.shown)};
}

GoldenFacts facts_of(const GoldenFrame& frame) {
  return {.width_px = frame.left.colour.cols,
          .height_px = frame.left.colour.rows,
          .smaller = frame.smaller,
          .first_mesh = frame.first_mesh,
          .is_linear = frame.is_linear,
          .left = hashes_of(frame.left),
          .right = hashes_of(frame.right)};
}

nlohmann::ordered_json hashes_json(const PictureHashes& hashes) {
  return {{"seen_sha256", hashes.seen}, {"colour_sha256", hashes.colour}, {"shown_sha256", hashes.shown}};
}

std::string facts_text(const GoldenFacts& facts) {
  return json_text({{"size_px", {facts.width_px, facts.height_px}},
                    {"smaller", facts.smaller},
                    {"first_mesh", facts.first_mesh},
                    {"linear", facts.is_linear},
                    {"left", hashes_json(facts.left)},
                    {"right", hashes_json(facts.right)}});
}

std::string hash_in(const JsonValue& value) {
  const std::string hash = value.text();
  if (hash.size() != 64 || hash.find_first_not_of("0123456789abcdef") != std::string::npos)
    value.refuse("64 hexadecimal digits");
  return hash;
}

PictureHashes hashes_in(const JsonValue& value) {
  value.allow({"seen_sha256", "colour_sha256", "shown_sha256"});
  return {hash_in(value.at("seen_sha256")), hash_in(value.at("colour_sha256")),
          hash_in(value.at("shown_sha256"))};
}

GoldenFacts read_facts(const fs::path& file) {
  const auto whole = [](const JsonValue& value, int least) {
    return static_cast<int>(value.integer(least, kLargest));
  };
  return read_json_file(file, [&](const JsonValue& value) {
    value.allow({"size_px", "smaller", "first_mesh", "linear", "left", "right"});
    const std::vector<JsonValue> size = value.at("size_px").list(2, 2);
    return GoldenFacts{.width_px = whole(size[0], 1),
                       .height_px = whole(size[1], 1),
                       .smaller = whole(value.at("smaller"), 1),
                       .first_mesh = whole(value.at("first_mesh"), 0),
                       .is_linear = value.at("linear").flag(),
                       .left = hashes_in(value.at("left")),
                       .right = hashes_in(value.at("right"))};
  });
}

/// Numbers of surfaces as colours, which every reader of PNGs keeps.
cv::Mat as_colours(const cv::Mat& shown) {
  cv::Mat colours(shown.size(), CV_8UC3);
  for (int v = 0; v < shown.rows; ++v) {
    for (int u = 0; u < shown.cols; ++u) {
      const int surface = shown.at<std::uint16_t>(v, u);
      colours.at<cv::Vec3b>(v, u) = {0, static_cast<std::uint8_t>(surface / 256),
                                     static_cast<std::uint8_t>(surface % 256)};
    }
  }
  return colours;
}

cv::Mat as_surfaces(const cv::Mat& colours) {
  cv::Mat shown(colours.size(), CV_16UC1);
  for (int v = 0; v < colours.rows; ++v)
    for (int u = 0; u < colours.cols; ++u)
      shown.at<std::uint16_t>(v, u) =
          static_cast<std::uint16_t>(256 * colours.at<cv::Vec3b>(v, u)[1] + colours.at<cv::Vec3b>(v, u)[2]);
  return shown;
}

cv::Mat read_of_size(const fs::path& file, const GoldenFacts& facts) {
  cv::Mat picture = read_picture(file);
  if (picture.cols != facts.width_px || picture.rows != facts.height_px)
    throw std::runtime_error(fmt::format("{}: expected {} x {} pixels (got {} x {})", file.string(),
                                         facts.width_px, facts.height_px, picture.cols, picture.rows));
  return picture;
}

GoldenPicture read_golden_picture(const fs::path& stem, const GoldenFacts& facts,
                                  const PictureHashes& hashes) {
  const auto check = [](const fs::path& file, const cv::Mat& picture, const std::string& hash) {
    if (pixels_sha256(picture) != hash)
      throw std::runtime_error(fmt::format(
          "{}: is not the golden picture that was written: its hash is another one", file.string()));
  };
  const fs::path colour_file = stem.string() + ".png", shown_file = stem.string() + "_shown.png";
  GoldenPicture picture{.seen_sha256 = hashes.seen,
                        .colour = read_of_size(colour_file, facts),
                        .shown = as_surfaces(read_of_size(shown_file, facts))};
  check(colour_file, picture.colour, hashes.colour);
  check(shown_file, picture.shown, hashes.shown);
  return picture;
}

GoldenFrame read_golden(const fs::path& folder, const FrameName& name, const GoldenFacts& facts) {
  const fs::path stem = folder / file_stem(name);
  return {.name = name,
          .smaller = facts.smaller,
          .first_mesh = facts.first_mesh,
          .is_linear = facts.is_linear,
          .left = read_golden_picture(stem.string() + "_left", facts, facts.left),
          .right = read_golden_picture(stem.string() + "_right", facts, facts.right)};
}

}  // namespace

std::vector<std::string> golden_file_names(const FrameName& frame) {
  std::vector<std::string> names;
  for (const char* ending : {"_left.png", "_left_shown.png", "_right.png", "_right_shown.png", ".json"})
    names.push_back(file_stem(frame) + ending);
  return names;
}

void write_golden(const fs::path& folder, const GoldenFrame& frame) {
  prepare_output_folder(folder);
  const std::vector<std::string> names = golden_file_names(frame.name);
  write_file_atomically(folder / names[0], encoded(".png", frame.left.colour));
  write_file_atomically(folder / names[1], encoded(".png", as_colours(frame.left.shown)));
  write_file_atomically(folder / names[2], encoded(".png", frame.right.colour));
  write_file_atomically(folder / names[3], encoded(".png", as_colours(frame.right.shown)));
  write_file_atomically(folder / names[4], facts_text(facts_of(frame)));
}

GoldenFrame read_golden(const fs::path& folder, const FrameName& frame) {
  return read_golden(folder, frame, read_facts(folder / golden_file_names(frame).back()));
}

GoldenCheck check_golden(const fs::path& folder, const GoldenFrame& now, const GoldenLimits& limits) {
  const GoldenFacts facts = read_facts(folder / golden_file_names(now.name).back());
  if (facts == facts_of(now)) return {.difference = compare_golden(now, now, limits), .before = {}};
  GoldenCheck check{.difference = {}, .before = read_golden(folder, now.name, facts)};
  check.difference = compare_golden(*check.before, now, limits);
  return check;
}

}  // namespace stereobench::harness
