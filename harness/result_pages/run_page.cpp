#include "harness/result_pages/run_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/frames/pair_files.h"
#include "harness/io/atomic_file.h"
#include "harness/io/text_table.h"
#include "harness/page/command_words.h"
#include "harness/result_pages/detection_charts.h"
#include "harness/result_pages/filter_blocks.h"
#include "harness/result_pages/frame_panels.h"
#include "harness/result_pages/gates_block.h"
#include "harness/result_pages/map_block.h"
#include "harness/vision_scoring/detection_table.h"

namespace stereobench::harness {
namespace {

/// So that a page stays below 6 MB: base64 makes four bytes of three.
constexpr std::size_t kMostPictureBytes = 3'500'000;

std::string line_of(std::vector<std::string> words, const std::vector<std::string>& more) {
  if (words.empty()) return "";
  words.insert(words.end(), more.begin(), more.end());
  return shell_line(words);
}

std::string render_line(const RunStory& story, const KeptPair& pair) {
  return line_of(story.commands.render,
                 {"--seeds", fmt::format("{}", pair.seed), "--frames", fmt::format("{}", pair.frame)});
}

Block vision_block(const VisionScore& vision) {
  PageTable table{.header = {"what", "value", "unit"}};
  const auto add = [&](const char* what, const PageCell& value, const char* unit) {
    table.rows.push_back({{{.text = what}, value, {.text = unit}}});
  };
  add("recall: found of the balls that had to be", number_cell(vision.recall()), "");
  add("precision: right of the detections", number_cell(vision.precision()), "");
  add("balls that had to be found", count_cell(vision.visible), "");
  add("missed", count_cell(vision.visible - vision.found), "");
  add("taken for another colour", count_cell(vision.misidentified), "");
  add("detections of no ball", count_cell(vision.spurious), "");
  add("repeated detections", count_cell(vision.repeated), "");
  add("range error, rms", number_cell(1e3 * vision.range_rms_m()), "mm");
  add("range error, mean", number_cell(1e3 * vision.range_bias_m()), "mm");
  add("bearing error, rms", number_cell(1e3 * vision.bearing_rms_rad()), "mrad");
  add("bearing error, mean", number_cell(1e3 * vision.bearing_bias_rad()), "mrad");
  add("disparity error, rms", number_cell(vision.disparity_rms_px()), "px");
  add("disparity error, mean", number_cell(vision.disparity_bias_px()), "px");
  add("normalised error: 1 where the stated noise is consistent", number_cell(vision.mean_normalised_error()),
      "");
  Block block{.title = "Vision", .note = "", .content = std::move(table)};
  for (const std::string& warning : rig_warnings(vision.rig)) block.note += "Warning: " + warning + ". ";
  return block;
}

PageFrames worst_frames(const std::vector<KeptPair>& pairs, const RunStory& story,
                        const std::vector<DetectionRow>& detections) {
  PageFrames frames{.width_px = story.rig.intrinsics.width_px, .height_px = story.rig.intrinsics.height_px};
  for (const KeptPair& pair : pairs) {
    const std::vector<DetectionRow> rows = rows_of(detections, pair.seed, pair.frame);
    const std::string faults = faults_of(rows);
    PageFrame frame{
        .title = fmt::format("seed {}, frame {}", pair.seed, pair.frame),
        .note = fmt::format("{}; the largest normalised error is {}", faults.empty() ? "no fault" : faults,
                            format_number(pair.badness.worst_nis)),
        .command = render_line(story, pair)};
    for (const vision::Side side : {vision::Side::kLeft, vision::Side::kRight}) {
      frame.panels.push_back(panel_of(rows, story.rig, side));
      frame.panels.back().picture = frames.jpegs.size();
      frames.jpegs.push_back(side == vision::Side::kLeft ? pair.left_jpeg : pair.right_jpeg);
    }
    frames.frames.push_back(std::move(frame));
  }
  return frames;
}

Block frames_block(PageFrames frames) {
  return {.title = "The worst stereo pairs",
          .note =
              "The worst first: those with most faults, then those with the largest normalised error. "
              "Four of each seed are looked at, twelve of the first. Arrow keys leaf. Outlines are the "
              "truth: green found, red missed, orange taken for another colour, dashed did not have to be "
              "found. Crosses are detections, with their range error.",
          .content = std::move(frames)};
}

std::vector<std::string> facts_of(const RunResult& result, const RunCurves& curves) {
  std::vector<std::string> facts = {
      fmt::format("seed{} {}", result.seeds.size() == 1 ? "" : "s", seeds_word(result.seeds)),
      fmt::format("{} steps", curves.first.steps)};
  if (result.backend != kNoBackend) facts.push_back("rendered by " + result.backend);
  if (result.vision) facts.push_back("detector: " + result.detector);
  facts.push_back(fmt::format("stereobench {}", STEREOBENCH_VERSION));
  for (const std::string& line : result.assumed) facts.push_back("assumed: " + line);
  return facts;
}

void append(std::vector<Block>& blocks, std::vector<Block> more) {
  std::ranges::move(more, std::back_inserter(blocks));
}

}  // namespace

Page run_page(const RunResult& result, const RunCurves& curves, const RunStory& story,
              const std::vector<DetectionRow>& detections, const nlohmann::ordered_json& json) {
  Page page{.title = result.name, .facts = facts_of(result, curves)};
  page.blocks.push_back(gates_block(story.gates, json));
  append(page.blocks, filter_tables(result));
  if (result.vision) page.blocks.push_back(vision_block(*result.vision));
  append(page.blocks, seed_blocks(result));
  append(page.blocks, time_blocks(result, curves));
  const NamedDetections all[] = {{"", detections}};
  if (std::vector<Chart> charts = detection_charts(all); !charts.empty())
    page.blocks.push_back({.title = "Detections against range and noise",
                           .note = "Of right detections; bars are 95 % intervals of the rms.",
                           .content = PageCharts{std::move(charts)}});
  if (PageMap map = map_of_seed(curves.first, story.walls); !map.time_s.empty())
    page.blocks.push_back({.title = fmt::format("Map of seed {}", curves.first.seed),
                           .note = "Thick: the true path. Lines: estimates, with their 95 % ellipse at the "
                                   "time. Crosses: landmarks as they were estimated in the end.",
                           .content = std::move(map)});
  const std::string command = line_of(story.commands.result, {"--seeds", seeds_word(result.seeds)});
  const std::string first = line_of(story.commands.result, {"--seeds", fmt::format("{}", curves.first.seed)});
  if (!command.empty())
    for (Block& block : page.blocks)
      block.commands = {std::holds_alternative<PageMap>(block.content) ? first : command};
  const std::vector<KeptPair> pairs = within_bytes(curves.worst_pairs.pairs(), kMostPictureBytes);
  if (!pairs.empty()) page.blocks.push_back(frames_block(worst_frames(pairs, story, detections)));
  return page;
}

void write_run_report(const std::filesystem::path& out, const RunResult& result, const RunCurves& curves,
                      const RunStory& story) {
  const std::filesystem::path table = out / kDetections;
  const auto detections =
      std::filesystem::exists(table) ? read_detection_rows(table) : std::vector<DetectionRow>();
  write_pairs(out, within_bytes(curves.worst_pairs.pairs(), kMostPictureBytes), story.rig);
  write_file_atomically(out / kReport,
                        page_html(run_page(result, curves, story, detections, run_json(result))));
}

}  // namespace stereobench::harness
