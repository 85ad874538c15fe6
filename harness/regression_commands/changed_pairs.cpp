#include "harness/regression_commands/changed_pairs.h"

#include <string>

#include "harness/frame_replay/frame_replay.h"
#include "harness/frames/pair_files.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "harness/report/detection_picture.h"

namespace stereobench::harness {
namespace {

struct WantedPair {
  const PlannedCase* planned = nullptr;
  FrameName name;
};

std::vector<WantedPair> missing_pairs(const SuitePlan& plan, const std::filesystem::path& out,
                                      const std::vector<CaseReport>& reports) {
  std::vector<WantedPair> wanted;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const CaseReport& report = reports[i];
    if (state_of(report) != CaseState::kRegressed || !report.judgement->changes) continue;
    for (const ChangedFrame& frame : report.judgement->changes->frames) {
      const FrameName name = {frame.seed, static_cast<std::size_t>(frame.frame)};
      if (!read_pair(out / report.name, name.seed, name.step)) wanted.push_back({&plan.cases[i], name});
    }
  }
  return wanted;
}

/// A pair as its cameras take it. Whoever looks for balls in it does not matter.
KeptPair render_pair(const WantedPair& wanted, renderer::Backend backend) {
  Experiment experiment = wanted.planned->experiment;
  experiment.detector = {};
  const auto frames =
      replay_frames(experiment, std::vector{wanted.name}, backend, *wanted.planned->arguments.meshes);
  KeptPair kept{.seed = wanted.name.seed, .frame = wanted.name.step};
  keep_pictures(kept, for_display(frames.front().pair, frames.front().camera));
  return kept;
}

}  // namespace

void keep_changed_pairs(const SuitePlan& plan, const SuiteArguments& arguments,
                        const std::filesystem::path& out, const std::vector<CaseReport>& reports) {
  const std::vector<WantedPair> wanted = missing_pairs(plan, out, reports);
  if (wanted.empty()) return;
  Progress progress("frames that changed", static_cast<double>(wanted.size()));
  // In processes of their own: this one shall have no GL context when it forks.
  const Task render_one = [&](std::size_t index, const auto&) {
    const WantedPair& pair = wanted[index];
    add_pair(out / pair.planned->what.name, render_pair(pair, arguments.backend));
    return std::string();
  };
  run_in_processes(wanted.size(), arguments.run.jobs, render_one, [&](double done) { progress.show(done); });
}

}  // namespace stereobench::harness
