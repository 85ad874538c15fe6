#include "harness/result_pages/changed_frames.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/frame_replay/invocation.h"
#include "harness/frames/pair_files.h"
#include "harness/io/text_table.h"
#include "harness/result_pages/frame_panels.h"

namespace stereobench::harness {
namespace {

/// The place of a picture among those of the page; equal ones are there once.
std::size_t place_of(const std::string& jpeg, std::vector<std::string>& jpegs) {
  const auto found = std::ranges::find(jpegs, jpeg);
  if (found != jpegs.end()) return static_cast<std::size_t>(found - jpegs.begin());
  jpegs.push_back(jpeg);
  return jpegs.size() - 1;
}

/// A result's part of one frame.
struct SideOfFrame {
  const char* name = "";
  std::vector<DetectionRow> rows;
  std::optional<KeptPair> kept;
  std::string borrowed_from = {};  ///< " (picture of B)" where it has none of its own
};

SideOfFrame side_of(const char* name, const ResultFrames& result, const ChangedFrame& frame) {
  const auto step = static_cast<std::size_t>(frame.frame);
  return {name, rows_of(result.rows, frame.seed, step), read_pair(result.folder, frame.seed, step)};
}

/// Takes the other result's picture where there is one.
void borrow(const SideOfFrame& from, SideOfFrame& side) {
  if (!from.kept) return;
  side.kept = from.kept;
  side.borrowed_from = fmt::format(" (picture of {})", from.name);
}

FramePanel panel_of_side(const SideOfFrame& side, const vision::StereoRig& rig, vision::Side camera,
                         std::vector<std::string>& jpegs) {
  FramePanel panel = panel_of(side.rows, rig, camera);
  panel.title = fmt::format("{}, {}{}", side.name, panel.title, side.borrowed_from);
  if (side.kept)
    panel.picture =
        place_of(camera == vision::Side::kLeft ? side.kept->left_jpeg : side.kept->right_jpeg, jpegs);
  return panel;
}

std::string growth_text(const ChangedFrame& frame) {
  if (!(frame.worse_m2 > 0.0)) return "";
  return fmt::format("; squared range errors grew by {} mm^2", format_number(1e6 * frame.worse_m2));
}

std::string faults_text(const SideOfFrame& side) {
  const std::string faults = faults_of(side.rows);
  return fmt::format("{}: {}", side.name, faults.empty() ? "no fault" : faults);
}

}  // namespace

PageFrames changed_frames(const ResultFrames& first, const ResultFrames& second,
                          std::span<const ChangedFrame> frames) {
  auto rig = rig_of_pairs(second.folder);
  if (!rig) rig = rig_of_pairs(first.folder);
  if (!rig) return {};
  PageFrames shown{.width_px = rig->intrinsics.width_px, .height_px = rig->intrinsics.height_px};
  const std::string replayable = replayable_folder(second.folder);
  for (const ChangedFrame& frame : frames) {
    SideOfFrame before = side_of("A", first, frame);
    SideOfFrame after = side_of("B", second, frame);
    if (!before.kept)
      borrow(after, before);
    else if (!after.kept)
      borrow(before, after);
    PageFrame made{
        .title = fmt::format("seed {}, frame {}", frame.seed, frame.frame),
        .note = fmt::format("{}; {}{}", faults_text(before), faults_text(after), growth_text(frame)),
        .command = replayable.empty() ? "" : replay_command(frame, replayable)};
    for (const vision::Side camera : {vision::Side::kLeft, vision::Side::kRight})
      for (const SideOfFrame* side : {&before, &after})
        made.panels.push_back(panel_of_side(*side, *rig, camera, shown.jpegs));
    shown.frames.push_back(std::move(made));
  }
  return shown;
}

}  // namespace stereobench::harness
