#include "harness/dataset/card/data_card.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/dataset/pictures/picture_change.h"

namespace stereobench::harness {
namespace {

/// A word of a command as a shell reads it.
std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=,:+").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The command that renders the same; the scenario is named by the drive.
std::string command_of(const DatasetFacts& facts) {
  const nlohmann::ordered_json& marker = facts.marker;
  std::string command = fmt::format("stereobench render {}.yaml", drive_name_of(facts));
  const auto add = [&](std::string_view option, const std::string& value) {
    command += fmt::format(" --{} {}", option, shell_word(value));
  };
  for (const auto& change : marker.value("set", nlohmann::ordered_json::array()))
    add("set", change.get<std::string>());
  if (marker.contains("seed")) add("seeds", marker["seed"].dump());
  if (marker.contains("asked_frames")) add("frames", marker["asked_frames"].get<std::string>());
  if (marker.contains(kPictures))
    for (const auto& [option, value] : change_options(marker[kPictures])) add(option, value);
  if (marker.contains("backend")) add("backend", marker["backend"].get<std::string>());
  if (marker.contains("format")) add("format", format_of(facts));
  if (marker.contains("truth"))
    add("truth", fmt::format("{}", fmt::join(marker["truth"].get<std::vector<std::string>>(), ",")));
  if (marker.contains("truth_format")) add("truth-format", marker["truth_format"].get<std::string>());
  return command;
}

/// How pictures differ from what the camera stored.
std::string changed_text(const nlohmann::ordered_json& change) {
  constexpr std::array kKinds = {
      std::pair("grey", "They are grey, of 8 bits: the BT.601 luma of the stored levels."),
      std::pair("bayer-rggb", "They are mosaics of 8 bits, row 0 red and green, row 1 green and blue."),
      std::pair("linear16", "They have 16 bits: linear light with the camera's noise, 257 times the level.")};
  std::string text =
      "\nPictures were changed when they were written: the command says how. Calibration and truth are those "
      "of the changed pictures; observations are of the whole ones.";
  for (const auto& [kind, says] : kKinds)
    if (change.value("kind", std::string()) == kind) text += fmt::format(" {}", says);
  return text + "\n";
}

std::string origin_text(const DatasetFacts& facts) {
  const nlohmann::ordered_json& marker = facts.marker;
  std::string text = fmt::format(
      "## How it was made\n\n"
      "stereobench {} made it, a program that renders worlds of coloured balls. No camera took these "
      "pictures.\n\n    {}\n\n"
      "`{}` holds the text of the scenario, the SHA-256 of the files that it names, and the cameras with all "
      "digits. The same command writes the same bytes where the renderer has the same fingerprint "
      "(`stereobench doctor`).\n",
      marker.value("stereobench", std::string("(version not known)")), command_of(facts), kDatasetJson);
  if (marker.value("detector", std::string("stereobench")) != "stereobench")
    text += "\nA detector of somebody else's found the balls: the command needs `--detector`.\n";
  if (marker.contains(kPictures)) text += changed_text(marker[kPictures]);
  return text;
}

std::string files_text(const DatasetFacts& facts) {
  std::string rows;
  for (const FileGroup& group : file_groups(facts))
    rows += fmt::format("| `{}` | {} | {} | {} |\n", group.glob,
                        group.says.empty() ? "see the documentation of the format" : group.says,
                        group.names.size(), group.bytes);
  return fmt::format(
      "## Files\n\nThe layout is `{}`.\n\n"
      "| files | hold | count | bytes |\n|---|---|---:|---:|\n{}"
      "| `{}` | what was rendered, and which frames | 1 | |\n"
      "| `{}` | this page for machines (Croissant 1.0) | 1 | |\n"
      "| `{}` | SHA-256 of each file; `sha256sum -c {}` checks them | 1 | |\n",
      format_of(facts), rows, kDatasetJson, kCroissantFile, kManifest, kManifest);
}

}  // namespace

std::string conventions_text() {
  return "## Units and frames\n\n"
         "These hold unless the table of files says otherwise.\n\n"
         "- SI units. Names end with the unit: `_m`, `_s`, `_rad`, `_px`, `_ns`.\n"
         "- World: x east, y north, z up. Robot: x forward, y left, z up, on the floor under the middle of "
         "the "
         "baseline. Camera: x right, y down, z forward.\n"
         "- Pixel (0, 0) is the centre of the top-left pixel; u is the column, v the row.\n"
         "- Depth is planar Z, along the optical axis. It is not the range along the ray.\n"
         "- Disparity is u in the left picture minus u in the right picture. It is positive for rectified "
         "cameras.\n"
         "- The rows of a PFM file begin at the bottom of the picture; a negative scale is little endian.\n"
         "- Levels of pictures are linear light, unless `dataset.json` names another encoding.\n\n"
         "## What is masked\n\n"
         "- Where a pixel sees nothing, as in the sky, there is no depth, range, disparity or flow. The "
         "table of "
         "files says which value stands for that.\n"
         "- Truth is that of the pixel's centre. It holds for occluded pixels, too; masks say which they "
         "are.\n"
         "- Frames that the shutter dropped or that nobody asked for have no pictures. No frame is made "
         "up.\n";
}

std::string data_card(const DatasetFacts& facts) {
  const std::size_t pairs = facts.marker.value("frames", nlohmann::ordered_json::array()).size();
  return fmt::format(
      "# {}\n\n"
      "{} stereo pairs of one drive{}, with exact truth.\n\n{}\n{}\n{}\n"
      "## Splits\n\n"
      "This is one drive through one world. Its frames resemble each other: do not split them between "
      "training "
      "and test. Split by world, that is by scenario and seed.\n\n"
      "## Licence\n\n{}\n",
      title_of(facts), pairs, lack_of_pictures(facts), origin_text(facts), files_text(facts),
      conventions_text(), kLicenceText);
}

}  // namespace stereobench::harness
