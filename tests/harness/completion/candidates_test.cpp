// How command lines may go on: against the program's own options, registries and readers.
#include "harness/completion/candidates.h"

#include <algorithm>
#include <functional>

#include <gmock/gmock.h>

#include "harness/commands/all_commands.h"
#include "harness/completion/option_values.h"
#include "harness/dataset/formats/format_registry.h"
#include "harness/experiment/experiment.h"
#include "harness/experiment/fault_presets.h"
#include "harness/regression/gates.h"
#include "harness/regression/metric_names.h"
#include "renderer/backend.h"
#include "slam/filter_registry.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

class Completion : public testing::Test {
 protected:
  Completion() { add_commands(program_, action_); }

  /// Words that may follow, with a blank behind those that are whole.
  std::vector<std::string> after(const std::vector<std::string>& words) const {
    std::vector<std::string> found;
    for (const Candidate& one : candidates(program_, words))
      found.push_back(one.text + (one.is_whole ? " " : ""));
    return found;
  }

  CLI::App program_;
  Action action_;
};

std::vector<std::string> whole(std::vector<std::string> names) {
  for (std::string& name : names) name += ' ';
  return names;
}

// Meant to catch: commands of every group; the first command alone; whatever the word begins with.
TEST_F(Completion, NamesEveryCommand) {
  std::vector<std::string> names;
  for (const CLI::App* command : program_.get_subcommands({})) names.push_back(command->get_name() + " ");
  EXPECT_EQ(after({""}), names);
  EXPECT_THAT(after({"cal"}), ElementsAre("calibrate ", "calibrate-rig "));
  EXPECT_THAT(after({"--h"}), ElementsAre("--help "));
  EXPECT_THAT(after({"frobnicate", ""}), IsEmpty());
  program_.add_subcommand("hidden", "not for people")->group("");
  EXPECT_EQ(after({""}), names);
}

// Meant to catch: options of no group; short names beside long ones; positional arguments.
TEST_F(Completion, NamesEveryOption) {
  EXPECT_THAT(after({"run", "--"}),
              AllOf(IsSupersetOf({"--seeds ", "--seed ", "--out ", "--help ", "--gate "}),
                    Not(Contains("-o ")), Not(Contains("scenario "))));
  EXPECT_THAT(after({"dataset", "--sh"}), ElementsAre("--shard "));
  program_.get_subcommand("dataset")->get_option("--shard")->group("");
  EXPECT_THAT(after({"dataset", "--sh"}), IsEmpty()) << "is hidden";
}

// Meant to catch: all options every time; none twice, also of those that may be repeated; values that are
// taken for options.
TEST_F(Completion, LeavesOutWhatIsGiven) {
  EXPECT_THAT(after({"run", "a.yaml", "--particles", "3", "--part"}), IsEmpty());
  EXPECT_THAT(after({"run", "a.yaml", "--particles=3", "--part"}), IsEmpty());
  EXPECT_THAT(after({"run", "-q", "--qui"}), IsEmpty());
  EXPECT_THAT(after({"run", "a.yaml", "--set", "particles=3", "--se"}), Contains("--set "));
  EXPECT_THAT(after({"run", "a.yaml", "--set", "--particles", "--part"}), ElementsAre("--particles "));
}

// Meant to catch: the list without what stands before its last comma; entries that stand there already; of
// --filters=ek, a word without the option.
TEST_F(Completion, NamesFilters) {
  EXPECT_EQ(after({"run", "a.yaml", "--filters", ""}), whole(slam::filter_names()));
  EXPECT_THAT(after({"run", "a.yaml", "--filters", "ekf,ie"}), ElementsAre("ekf,iekf "));
  EXPECT_THAT(after({"run", "a.yaml", "--filters", "ekf,iekf,e"}), IsEmpty());
  EXPECT_THAT(after({"run", "--filters=ek"}), ElementsAre("--filters=ekf "));
  EXPECT_THAT(after({"run", "--dry-run=ek"}), IsEmpty()) << "takes no value";
}

// Meant to catch: `verify --as` with the formats that are written; `import` with those that it does not read.
TEST_F(Completion, NamesFormatsAndBackends) {
  std::vector<std::string> formats;
  for (const DatasetFormat& format : dataset_formats()) formats.emplace_back(format.name);
  EXPECT_EQ(after({"render", "a.yaml", "--format", ""}), whole(formats));
  EXPECT_THAT(after({"export", "a", "--as", "tum,eur"}), ElementsAre("tum,euroc "));
  EXPECT_THAT(after({"verify", "a", "--as", "coc"}), ElementsAre("coco "));
  EXPECT_THAT(after({"verify", "a", "--as", "tum,eur"}), IsEmpty()) << "takes one";
  EXPECT_THAT(after({"import", "a", "--as", "co"}), ElementsAre("colmap "));
  EXPECT_THAT(after({"run", "--backend", ""}), ElementsAre("osmesa ", "egl ", "egl-gpu "));
  EXPECT_THAT(after({"render", "a", "--truth", "disparity,f"}), ElementsAre("disparity,flow "));
  EXPECT_THAT(after({"slam", "a", "--identity", "c"}), ElementsAre("colour_class "));
  EXPECT_THAT(after({"slam", "a", "--truth", ""}), IsEmpty()) << "is a file";
}

// Words that CLI11 checks. Meant to catch: with the braces; the first one alone.
TEST_F(Completion, NamesWordsThatAreChecked) {
  EXPECT_THAT(after({"detect", "a", "--encoding", ""}), ElementsAre("auto ", "linear ", "srgb "));
  EXPECT_THAT(after({"calibrate", "a", "--law", "st"}), ElementsAre("stereo "));
  EXPECT_THAT(after({"run", "a", "--particles", ""}), IsEmpty());
}

TEST_F(Completion, LeavesFilesToTheShell) {
  EXPECT_THAT(after({"run", ""}), IsEmpty());
  EXPECT_THAT(after({"run", "a.yaml", "--out", ""}), IsEmpty());
}

// Meant to catch: all keys at once; whole words; '=' behind groups; no '[' behind lists of groups; values of
// another key; numbers of long ranges.
TEST_F(Completion, NamesScenarioKeysAndTheirValues) {
  EXPECT_THAT(after({"run", "a.yaml", "--set", "camera"}), ElementsAre("camera."));
  EXPECT_THAT(after({"run", "a.yaml", "--set", "camera.noise_sd"}), ElementsAre("camera.noise_sd_levels="));
  EXPECT_THAT(after({"run", "a.yaml", "--set", "world.balls"}), ElementsAre("world.balls["));
  EXPECT_THAT(after({"run", "a.yaml", "--set", "world.balls[3].col"}), ElementsAre("world.balls[3].colour="));
  EXPECT_THAT(after({"run", "a.yaml", "--set", "identity="}),
              ElementsAre("identity=known ", "identity=colour_class ", "identity=none "));
  EXPECT_THAT(after({"run", "a.yaml", "--set", "filters=[ekf,ie"}), ElementsAre("filters=[ekf,iekf"));
  EXPECT_THAT(after({"run", "a.yaml", "--set", "rig.width_px="}), IsEmpty());
  EXPECT_THAT(after({"run", "a.yaml", "--set", "frobnicate."}), IsEmpty());
  EXPECT_THAT(after({"run", "a.yaml", "--set", "identity.x"}), IsEmpty());
}

// Meant to catch: a whole word, behind which no further value can be written; the line before the colon left
// out.
TEST_F(Completion, NamesKeysThatVary) {
  EXPECT_THAT(after({"sweep", "a.yaml", "--vary", "identity=known,n"}), ElementsAre("identity=known,none"));
  EXPECT_THAT(after({"sweep", "a.yaml", "--vary", "path.step_s:camera.noise_sd"}),
              ElementsAre("path.step_s:camera.noise_sd_levels="));
}

// Meant to catch: names without their severities; severities from 1.
TEST_F(Completion, NamesFaults) {
  EXPECT_THAT(after({"run", "a.yaml", "--faults", "camera.bl"}), ElementsAre("camera.blur="));
  EXPECT_THAT(
      after({"run", "a.yaml", "--faults", "camera.blur="}),
      AllOf(testing::SizeIs(kMostSeverity + 1), Contains("camera.blur=0 "), Contains("camera.blur=5 ")));
  std::vector<std::string> names;
  for (const FaultPreset& fault : fault_presets()) names.emplace_back(fault.name);
  EXPECT_EQ(after({"faults", ""}), whole(names));
}

/// Follows candidates that are not whole, to all leaves below a word. @return the leaves
std::vector<std::string> leaves_below(const std::vector<Candidate>& found,
                                      const std::function<std::vector<Candidate>(const std::string&)>& next) {
  std::vector<std::string> leaves;
  for (const Candidate& one : found) {
    if (one.is_whole || one.text.ends_with("=")) {
      leaves.push_back(one.text);
      continue;
    }
    const std::vector<std::string> below = leaves_below(next(one.text), next);
    leaves.insert(leaves.end(), below.begin(), below.end());
  }
  return leaves;
}

// All numbers of a run of all filters, each once. Meant to catch: parts of paths that are whole, as
// "filters."; a candidate for each number below a part.
TEST_F(Completion, LeadsToEveryMetric) {
  const auto next = [this](const std::string& word) {
    return candidates(program_, std::vector<std::string>{"budget", "a.yaml", "--metric", word});
  };
  Experiment all;
  all.filters = slam::filter_names();
  EXPECT_EQ(leaves_below(next(""), next), metric_names(result_without_values(all)));
  EXPECT_THAT(after({"run", "a.yaml", "--gate", "vision.recal"}), ElementsAre("vision.recall"));
  EXPECT_THAT(after({"run", "a.yaml", "--gate", "filters.ufastslam.ate_rms_m."}),
              Contains("filters.ufastslam.ate_rms_m.mean"));
}

/// The paths of a group's keys without lists of groups.
void append_paths(const worlds::KeyGroup& group, const std::string& path, std::vector<std::string>& paths) {
  for (const worlds::Key& key : group.keys) {
    const std::string own = path + std::string(key.name);
    if (key.kind != worlds::ValueKind::kGroup)
      paths.push_back(own + "=");
    else if (key.lengths.most == 0)
      append_paths(*key.group, own + ".", paths);
  }
}

// Meant to catch: the first key of a group alone.
TEST_F(Completion, LeadsToEveryScenarioKey) {
  const auto next = [this](const std::string& word) {
    if (word.ends_with("[")) return std::vector<Candidate>();
    return candidates(program_, std::vector<std::string>{"run", "a.yaml", "--set", word});
  };
  std::vector<std::string> paths;
  append_paths(experiment_keys(), "", paths);
  EXPECT_GT(paths.size(), 100U);
  EXPECT_EQ(leaves_below(next(""), next), paths);
}

// A row that no command has is out of date. Meant to catch: a row for --filter.
TEST_F(Completion, EveryRowIsOfAnOptionThatThereIs) {
  for (const ValueSource& source : value_sources()) {
    const auto commands = program_.get_subcommands([&](const CLI::App* command) {
      return (source.command.empty() || source.command == command->get_name()) &&
             std::ranges::any_of(command->get_options(), [&](const CLI::Option* option) {
               return option->check_name(std::string(source.option));
             });
    });
    EXPECT_FALSE(commands.empty()) << source.command << ' ' << source.option;
  }
}

}  // namespace
}  // namespace stereobench::harness
