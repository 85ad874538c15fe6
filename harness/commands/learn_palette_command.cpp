#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/dataset/colour_marks.h"
#include "harness/dataset/palette_file.h"
#include "harness/detector/detector.h"
#include "harness/io/atomic_file.h"
#include "harness/io/text_table.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kFewestApart = 3.0;  // standard deviations; below it one pixel in 700 is on the other side

struct LearnPaletteArguments {
  fs::path marks;
  std::string encoding = "auto";
  fs::path out = "palette.json";
};

/// The colour that is most easily taken for another, and how far apart they are.
std::pair<std::string, double> nearest(const std::vector<vision::LearnedColour>& colours, std::size_t i) {
  std::pair<std::string, double> result = {"-", std::numeric_limits<double>::infinity()};
  for (std::size_t other = 0; other < colours.size(); ++other) {
    const double apart = vision::separation(colours[i], colours[other]);
    if (other != i && apart < result.second) result = {colours[other].name, apart};
  }
  return result;
}

std::string report(const PaletteFile& palette, const MarkedPixels& marked) {
  AlignedTable table{{"colour", "pixels", "rgb", "chromaticity r, g", "darkest", "nearest", "sd apart"}, {}};
  std::string warnings;
  for (std::size_t i = 0; i < palette.colours.size(); ++i) {
    const vision::LearnedColour& colour = palette.colours[i];
    const auto [other, apart] = nearest(palette.colours, i);
    table.rows.push_back({colour.name, fmt::format("{}", marked.pixels.at(colour.name).size()),
                          fmt::format("{:.0f} {:.0f} {:.0f}", colour.bgr[2], colour.bgr[1], colour.bgr[0]),
                          fmt::format("{:.3f}, {:.3f}", colour.chromaticity.x(), colour.chromaticity.y()),
                          fmt::format("{:.0f}", colour.darkest_level), other, format_number(apart)});
    if (apart < kFewestApart)
      warnings += fmt::format("warning: {} may be taken for {}: they are {:.1f} standard deviations apart\n",
                              colour.name, other, apart);
  }
  return plain_text(table) + warnings;
}

int learn(const LearnPaletteArguments& arguments) {
  PaletteFile palette;
  const MarkedPixels marked = read_marked_pixels(arguments.marks, arguments.encoding);
  palette.encoding = marked.encoding;
  if (marked.colours.size() >= vision::kBackground)
    throw std::runtime_error(fmt::format("{}: expected at most 254 colours", arguments.marks.string()));
  try {
    for (const std::string& name : marked.colours)
      palette.colours.push_back(
          vision::learn_colour(name, marked.pixels.at(name), levels_of(palette.encoding)));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", arguments.marks.string(), error.what()));
  }
  write_file_atomically(arguments.out, palette_json(palette));
  say(report(palette, marked));
  fmt::print("levels are taken for {} ({})\n{}\n",
             palette.encoding == worlds::Encoding::kSrgb ? "sRGB" : "linear light",
             arguments.encoding == "auto" ? "by what the pictures' files say; --encoding says otherwise"
                                          : "--encoding",
             arguments.out.string());
  return kPassed;
}

}  // namespace

void add_learn_palette_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("learn-palette", "learn the colours of real things from marked pictures");
  auto arguments = std::make_shared<LearnPaletteArguments>();
  command->add_option("marks", arguments->marks, "JSON file: which picture shows which colour where")
      ->required();
  command
      ->add_option("--encoding", arguments->encoding,
                   "how the pictures' levels stand for light; auto: sRGB of JPEGs and of PNGs "
                   "that say so, else linear")
      ->check(CLI::IsMember({"auto", "linear", "srgb"}))
      ->capture_default_str();
  command->add_option("--out,-o", arguments->out, "file for the palette")->capture_default_str();
  add_quiet_option(*command);
  command->footer(
      "A file of marks, whose pictures lie beside it:\n"
      "  {\"marks\": [{\"picture\": \"a.png\", \"colour\": \"red\", \"circle_px\": [34, 229, 20]},\n"
      "             {\"picture\": \"a.png\", \"colour\": \"green\", \"box_px\": [250, 100, 30, 30]}]}\n\n"
      "Example: stereobench learn-palette marks.json -o palette.json\n"
      "         stereobench detect a.png --palette palette.json");
  command->callback([arguments, &action] { action = [arguments] { return learn(*arguments); }; });
}

}  // namespace stereobench::harness
