#include "harness/regression_commands/suite_pictures.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "harness/golden/golden_files.h"
#include "harness/golden/golden_picture.h"
#include "harness/io/atomic_file.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// What is drawn beside a golden frame that has changed: before, after, difference.
constexpr const char* kDifferencePicture = "_difference.png";

bool has_end(const std::string& name, const std::vector<const char*>& ends) {
  return name.starts_with("seed") &&
         std::ranges::any_of(ends, [&](const char* end) { return name.ends_with(end); });
}

std::vector<fs::path> files_with_ends(const fs::path& folder, const std::vector<const char*>& ends) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (has_end(entry.path().filename().string(), ends)) files.push_back(entry.path());
  return files;
}

/// A frame of a case that is to be rendered.
struct WantedFrame {
  const PlannedCase* planned = nullptr;
  std::size_t report = 0;
  FrameName name;
};

std::vector<WantedFrame> frames_of(const SuitePlan& plan, const std::vector<CaseReport>& reports) {
  std::vector<WantedFrame> frames;
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    if (!reports[i].error.empty()) continue;
    for (const int step : plan.cases[i].what.golden.frames)
      frames.push_back(
          {&plan.cases[i], i, {plan.cases[i].asked_seeds.front(), static_cast<std::size_t>(step)}});
  }
  return frames;
}

/// Renders in processes of their own: this one shall have no GL context when it forks.
/// @return why a frame has no pictures, by its index
std::map<std::size_t, std::string> render(const std::vector<WantedFrame>& frames,
                                          const SuiteArguments& arguments, const fs::path& out,
                                          const std::string& what) {
  Progress progress(what, static_cast<double>(frames.size()));
  const Task render_one = [&](std::size_t index, const auto&) {
    const WantedFrame& frame = frames[index];
    const PlannedCase& planned = *frame.planned;
    write_golden(golden_folder(out / planned.what.name),
                 render_golden(planned.experiment, frame.name, arguments.backend, *planned.arguments.meshes));
    return std::string();
  };
  std::map<std::size_t, std::string> faults;
  run_all_in_processes(
      frames.size(), arguments.run.jobs, render_one, [](std::size_t, const std::string&) {},
      [&](std::size_t index, const std::string& message) { faults[index] = message; },
      [&](double done) { progress.show(done); });
  return faults;
}

/// One line. @param text of a line or two
std::string on_one_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n'))
    text.replace(at, 1, "; ");
  return text;
}

PictureRecord compare(const WantedFrame& frame, const fs::path& before, const fs::path& now) {
  PictureRecord record{.name = file_stem(frame.name)};
  if (!fs::exists(before / (record.name + ".json"))) {
    record.is_as_before = false;
    record.text = "the baseline has no " + record.name + ".json: bless one";
    return record;
  }
  try {
    const GoldenFrame rendered = read_golden(now, frame.name);
    const GoldenCheck check =
        check_golden(before, rendered, golden_limits(frame.planned->what.golden.limits));
    record.is_as_before = check.difference.passes;
    record.text = on_one_line(difference_text(check.difference));
    if (check.before)
      write_file_atomically(
          now / (record.name + kDifferencePicture),
          draw_golden_difference(frame.planned->what.name, *check.before, rendered, check.difference));
  } catch (const std::runtime_error& error) {
    record.is_as_before = false;
    record.text = error.what();
  }
  return record;
}

}  // namespace

fs::path golden_folder(const fs::path& result) {
  return result / "golden";
}

fs::path golden_baseline(const fs::path& baseline, const std::string& name) {
  return baseline / (name + ".golden");  // no case can have such a name
}

std::vector<fs::path> golden_files_in(const fs::path& folder) {
  return files_with_ends(folder, {".json", "_left.png", "_left_shown.png", "_right.png", "_right_shown.png"});
}

void check_pictures(const SuitePlan& plan, const SuiteArguments& arguments, const fs::path& out,
                    std::vector<CaseReport>& reports) {
  const std::vector<WantedFrame> frames = frames_of(plan, reports);
  for (const PlannedCase& planned : plan.cases) {  // of an earlier test
    const fs::path folder = golden_folder(out / planned.what.name);
    for (const fs::path& file : golden_files_in(folder)) fs::remove(file);
    for (const fs::path& file : files_with_ends(folder, {kDifferencePicture})) fs::remove(file);
  }
  if (frames.empty()) return;
  const auto faults = render(frames, arguments, out, "pictures of " + plan.suite.name);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const WantedFrame& frame = frames[i];
    CaseReport& report = reports[frame.report];
    if (const auto fault = faults.find(i); fault != faults.end()) {
      report.pictures.push_back({file_stem(frame.name), false, fault->second});
      continue;
    }
    if (!report.not_compared.empty()) continue;
    const std::string& name = frame.planned->what.name;
    report.pictures.push_back(
        compare(frame, golden_baseline(plan.baseline, name), golden_folder(out / name)));
  }
}

}  // namespace stereobench::harness
