/// Changes one tuning constant of vision at a time, and measures what comes of it.
/// usage: stereobench_ablation [NAME...]    constants whose names begin so; all of them without a name
/// Prints a line for each value and each kind of pictures (views.h), its fields separated by tabs. A constant
/// is set to zero and to a thousand times its value, of which one turns it off. Every eighth constant is
/// preceded by lines of vision as it is.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/studies/ablation/views.h"
#include "vision/tuning/arc_colours.h"
#include "vision/tuning/arc_fit.h"
#include "vision/tuning/colours.h"
#include "vision/tuning/detection.h"
#include "vision/tuning/match.h"
#include "vision/tuning/outline_fit.h"
#include "vision/tuning/rig_watch.h"
#include "vision/tuning/rim.h"
#include "vision/tuning/round_patch.h"
#include "vision/tuning/shading.h"

namespace stereobench::ablation {
namespace {

/// A constant, which is a variable here.
struct Constant {
  std::string name;
  std::variant<double*, int*, long*, std::size_t*> value;

  double get() const {
    return std::visit([](const auto* at) { return static_cast<double>(*at); }, value);
  }
  void set(double to) const {
    std::visit([to](auto* at) { *at = static_cast<std::remove_reference_t<decltype(*at)>>(to); }, value);
  }
};

/// All of them; the list is written by CMake from the headers of vision/tuning.
std::vector<Constant> all_constants() {
  return {
#include "tuning_constants.inc"
  };
}

struct Views {
  std::vector<DrivenFrames> drives;
  HiddenBalls hidden;
  std::vector<photograph::Photograph> photographs;
};

constexpr std::size_t kDrives = 4;
constexpr std::size_t kOutcomes = kDrives + 2;
constexpr std::array<const char*, kOutcomes> kTitles = {"circle", "corridor", "defocus",
                                                        "lens",   "hidden",   "photographs"};
using Outcomes = std::array<Outcome, kOutcomes>;

Views make_views() {
  Views views;
  views.drives.push_back(drive("ball_circle", {"path.laps=1"}, 1, 0));
  views.drives.push_back(drive("corridor", {}, 6, 0));
  views.drives.push_back(drive("ball_circle", {"path.laps=1", "camera.defocus_sd_px=0.8"}, 2, 1));
  views.drives.push_back(
      drive("ball_circle",
            {"path.laps=1", "rig.distortion=[-0.1,0.02,0,0,0]", "rig.right_turn_deg=[0.1,0.05,0]",
             "believed_rig={right_turn_deg: [0, 0, 0]}"},
            2, 3));
  views.hidden = hidden_balls(60);
  views.photographs = photographs(16);
  return views;
}

bool is_of_photographs(const std::string& name) {
  return name.starts_with("kRoundPatch.") || name.starts_with("kCover.") ||
         name.starts_with("kLearnedColours.");
}

Outcomes measure(const Views& views, bool with_photographs, bool photographs_alone) {
  Outcomes outcomes;
  if (!photographs_alone) {
    for (std::size_t i = 0; i < kDrives; ++i) outcomes[i] = outcome_of(views.drives[i]);
    outcomes[kDrives] = outcome_of(views.hidden);
  }
  if (with_photographs) outcomes[kDrives + 1] = outcome_of(views.photographs);
  return outcomes;
}

/// Prints in a child process, whose changes end with it, what `measure` gives. A child that takes too long or
/// dies says so by its exit code.
void in_child(const std::string& what, const std::function<Outcomes()>& measure) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit_s{120, 120};
    setrlimit(RLIMIT_CPU, &limit_s);
    try {
      const Outcomes outcomes = measure();
      for (std::size_t i = 0; i < kOutcomes; ++i) {
        const Outcome& o = outcomes[i];
        if (o.wanted > 0)
          fmt::print("{}\t{}\t{}\t{}\t{}\t{}\t{:.6g}\t{:.4f}\t{:.4f}\t{:.17g}\n", what, kTitles[i], o.wanted,
                     o.found, o.trusted, o.wrong, o.rms, o.nis, o.cpu_s, o.digest);
      }
    } catch (const std::exception& error) {
      fmt::print("{}\tfailed\t{}\n", what, error.what());
    }
    std::fflush(stdout);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) fmt::print("{}\tdied\t{}\n", what, status);
}

int study(const std::vector<std::string>& prefixes) {
  const Views views = make_views();
  const auto is_asked = [&](const std::string& name) {
    return prefixes.empty() ||
           std::ranges::any_of(prefixes, [&](const std::string& prefix) { return name.starts_with(prefix); });
  };
  fmt::print("constant\tvalue\tpictures\twanted\tfound\ttrusted\twrong\trms\thalf_nis\tcpu_s\tdigest\n");
  int count = 0;
  for (const Constant& constant : all_constants()) {
    if (!is_asked(constant.name)) continue;
    const bool alone = is_of_photographs(constant.name);
    if (count++ % 8 == 0) in_child("as it is\t0", [&] { return measure(views, true, false); });
    const double is = constant.get();
    for (const double to : {0.0, 1000.0 * is}) {
      in_child(fmt::format("{}\t{:.6g}", constant.name, to), [&] {
        constant.set(to);
        return measure(views, alone, alone);
      });
    }
  }
  return 0;
}

}  // namespace
}  // namespace stereobench::ablation

int main(int argc, char** argv) {
  try {
    return stereobench::ablation::study({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "stereobench_ablation: {}\n", error.what());
    return 2;
  }
}
