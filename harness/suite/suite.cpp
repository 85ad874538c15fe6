#include "harness/suite/suite.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "harness/experiment/experiment_parts.h"
#include "harness/experiment/seeds.h"
#include "slam/filter_registry.h"
#include "worlds/yaml/fields.h"
#include "worlds/yaml/plain_name.h"
#include "worlds/yaml/yaml_document.h"

namespace stereobench::harness {
namespace {

using worlds::Field;
using worlds::Fields;
using worlds::group;
using worlds::number;
using worlds::text;
using worlds::whole;
using worlds::YamlMap;
using worlds::YamlValue;

constexpr std::size_t kMostEntries = 1000;
constexpr double kMostPercent = 1e6;
constexpr double kMostChange = 1e12;

/// A case as it is written: with what it is like.
struct WrittenCase {
  SuiteCase what;
  std::string like;
};

const Fields<Margin>& margin_keys() {
  static const Fields<Margin> keys({
      text("metric", "Names of metrics that it is for; `*` stands for any letters.")
          .needed()
          .fills(&Margin::pattern),
      number("percent", {0.0, kMostPercent}, "What does not matter, in percent of the mean in the baseline.")
          .needed_unless("change")
          .by<Margin>([](const YamlValue& value, Margin& margin) {
            margin.relative = true;
            margin.value = value.number({0.0, kMostPercent}) / 100.0;
          }),
      number("change", {0.0, kMostChange}, "What does not matter, in the metric's own unit.")
          .otherwise_says("percent")
          .by<Margin>([](const YamlValue& value, Margin& margin) {
            margin.relative = false;
            margin.value = value.number({0.0, kMostChange});
          }),
  });
  return keys;
}

const Fields<GoldenWish>& golden_keys() {
  static const Fields<GoldenWish> keys({
      whole("frames", 0, 1'000'000, "Steps of the drive whose pictures are kept, of the first seed.")
          .list(1, 20)
          .needed()
          .fills(&GoldenWish::frames),
      text("limits", "How far pictures may be off: the name of a preset.").fills(&GoldenWish::limits),
  });
  return keys;
}

/// A list that is added to what a preset has.
template <class Value>
void append_to(const YamlValue& value, const worlds::Key& key, std::vector<Value>& list) {
  std::vector<Value> more;
  read_value(value, key, more);
  list.insert(list.end(), more.begin(), more.end());
}

template <class Value>
Field<WrittenCase> appended(const worlds::Key& key, std::vector<Value> SuiteCase::*member) {
  return key.by<WrittenCase>([key, member](const YamlValue& value, WrittenCase& written) {
    append_to(value, key, written.what.*member);
  });
}

void read_case_seeds(const YamlValue& value, WrittenCase& written) {
  try {
    written.what.seeds = parse_seeds(value.text());
  } catch (const std::invalid_argument& error) {
    value.fail(error.what());
  }
}

void read_case_filters(const YamlValue& value, WrittenCase& written) {
  const std::vector<std::string> known = slam::filter_names();
  const std::vector<std::string_view> names(known.begin(), known.end());
  written.what.filters.clear();
  for (const YamlValue& entry : value.list(1, names.size()))
    written.what.filters.push_back(known[entry.choice(names)]);
}

std::vector<Field<WrittenCase>> what_is_run() {
  return {
      text("name", "Of the case: letters, digits, _ and -.", worlds::kPlainNamePattern)
          .needed()
          .fills(&WrittenCase::what, &SuiteCase::name),
      text("like", "The preset whose keys it has, too; one that stands above.").fills(&WrittenCase::like),
      text("scenario", "The scenario's file, relative to the suite's folder.")
          .by<WrittenCase>(
              [](const YamlValue& value, WrittenCase& written) { written.what.scenario = value.path(); }),
      appended(text("set", "Lines of the scenario that are changed: key.path=value.").list(0, kMostEntries),
               &SuiteCase::set),
      text("seeds", "Which seeds are run: 0..9 (both included), 3, or 0,4,7.", kSeedsPattern)
          .by<WrittenCase>(read_case_seeds),
      text("filters", "Filters that are run; dead reckoning always is.")
          .list(1, kMostEntries)
          .by<WrittenCase>(read_case_filters),
      whole("particles", 1, 100000, "Particles of each particle filter.")
          .fills(&WrittenCase::what, &SuiteCase::particles),
  };
}

std::vector<Field<WrittenCase>> who_looks() {
  return {
      text("detector", "What finds the balls: the name of a linked detector, or the command of a program.")
          .fills(&WrittenCase::what, &SuiteCase::detector),
      number("detector_timeout_s", {1e-3, 1e6}, "How long it may think about a frame, in seconds.")
          .fills(&WrittenCase::what, &SuiteCase::detector_timeout_s),
      number("detector_start_s", {0.0, 1e6},
             "How much longer it may take for its first answer, in seconds, since it has to start.")
          .fills(&WrittenCase::what, &SuiteCase::detector_start_s),
  };
}

std::vector<Field<WrittenCase>> how_it_is_judged() {
  return {
      appended(group("gates", gate_keys(), "Limits on metrics, beside those of the scenario.")
                   .list(0, kMostEntries),
               &SuiteCase::gates),
      appended(group("margins", margin_keys(), "How much metrics may change; the last one that fits counts.")
                   .list(0, kMostEntries),
               &SuiteCase::margins),
      appended(text("metrics", "Names of the metrics that are judged; `*` stands for any letters.")
                   .list(0, kMostEntries),
               &SuiteCase::metrics),
      group("golden", golden_keys(), "Pictures that are kept in the baseline, and compared.")
          .fills(&WrittenCase::what, &SuiteCase::golden),
  };
}

const Fields<WrittenCase>& case_keys() {
  static const Fields<WrittenCase> keys(
      worlds::joined<WrittenCase>({what_is_run(), who_looks(), how_it_is_judged()}));
  return keys;
}

using Presets = std::map<std::string, SuiteCase>;

SuiteCase read_case(const YamlValue& value, const Presets& presets) {
  WrittenCase written;
  if (const auto like = YamlMap(value, case_keys()).find("like")) {
    const auto preset = presets.find(like->text());
    if (preset == presets.end()) like->fail("expected the name of a preset that stands above");
    written.what = preset->second;
  }
  case_keys().read_into(value, written);
  written.what.name = worlds::plain_name(YamlMap(value, case_keys()).at("name"));
  return written.what;
}

void read_cases(const YamlValue& list, const Presets& presets, Suite& suite) {
  for (const YamlValue& entry : list.list(1, kMostEntries)) {
    suite.cases.push_back(read_case(entry, presets));
    const SuiteCase& read = suite.cases.back();
    if (read.scenario.empty()) entry.refuse("expected `scenario:` in it or in the preset that it is like");
    if (std::ranges::count(suite.cases, read.name, &SuiteCase::name) > 1)
      entry.at_key("name").refuse("expected a name of its own for each case");
  }
}

/// Presets and cases are read by hand, one after the other.
const Fields<Suite>& suite_keys() {
  static const Fields<Suite> keys({
      text("suite", "Its name.", worlds::kPlainNamePattern).needed().fills(&Suite::name),
      number("alpha", {1e-4, 0.5}, "Chance of any false alarm, all cases together.").fills(&Suite::alpha),
      group("presets", case_keys(), "Keys that several cases have in common.").list(0, kMostEntries),
      group("cases", case_keys(), "What is run.").list(1, kMostEntries).needed(),
  });
  return keys;
}

}  // namespace

Suite read_suite(const std::filesystem::path& file) {
  const worlds::YamlDocument document = worlds::load_yaml(file, {}, suite_keys());
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, suite_keys());
  Suite suite = suite_keys().read(top);
  suite.file = file;
  const YamlMap map(top, suite_keys());
  suite.name = worlds::plain_name(map.at("suite"));
  Presets presets;
  if (const auto list = map.find("presets"))
    for (const YamlValue& entry : list->list(0, kMostEntries)) {
      SuiteCase preset = read_case(entry, presets);
      const std::string name = preset.name;
      if (!presets.emplace(name, std::move(preset)).second)
        entry.at_key("name").refuse("expected a name of its own for each preset");
    }
  read_cases(map.at("cases"), presets, suite);
  return suite;
}

std::filesystem::path usual_baseline(const std::filesystem::path& suite) {
  return suite.parent_path() / (suite.stem().string() + ".baseline");
}

}  // namespace stereobench::harness
