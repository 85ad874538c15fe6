#include "harness/collection/collection.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/collection/picture_keys.h"
#include "harness/experiment/seeds.h"
#include "worlds/yaml/fields.h"
#include "worlds/yaml/plain_name.h"
#include "worlds/yaml/yaml_document.h"

namespace stereobench::harness {
namespace {

using worlds::choice;
using worlds::Field;
using worlds::Fields;
using worlds::group;
using worlds::text;
using worlds::YamlMap;
using worlds::YamlValue;

constexpr std::string_view kDatePattern = "^[0-9]{4}-[0-9]{2}-[0-9]{2}$";
constexpr std::size_t kMostDrives = 1000;

template <class Struct>
Field<Struct> name_key(std::string_view key, std::string_view says, std::string Struct::*member) {
  return text(key, says, worlds::kPlainNamePattern)
      .needed()
      .template by<Struct>(
          [member](const YamlValue& value, Struct& object) { object.*member = worlds::plain_name(value); });
}

void read_date(const YamlValue& value, CollectionAbout& about) {
  about.published = value.text();
  std::string form = about.published;
  for (char& c : form)
    if (c >= '0' && c <= '9') c = '0';
  if (form != "0000-00-00") value.fail("expected a date as 2026-01-31");
}

const Fields<CollectionAbout>& about_keys() {
  static const Fields<CollectionAbout> keys({
      text("description", "What it is for, in a sentence.").fills(&CollectionAbout::description),
      text("licence", "Its licence: a name of SPDX or an address.").fills(&CollectionAbout::licence),
      text("creator", "Who made it.").fills(&CollectionAbout::creator),
      text("url", "Where it is.").fills(&CollectionAbout::url),
      text("published", "The day it was published: YYYY-MM-DD.", kDatePattern).by<CollectionAbout>(read_date),
  });
  return keys;
}

using SeedsOfSplits = std::array<std::vector<std::uint64_t>, 3>;

Field<SeedsOfSplits> seeds_key(Split split, std::string_view says) {
  return text(name_of(split), says, kSeedsPattern)
      .by<SeedsOfSplits>([split](const YamlValue& value, SeedsOfSplits& seeds) {
        try {
          seeds.at(static_cast<std::size_t>(split)) = parse_seeds(value.text());
        } catch (const std::invalid_argument& error) {
          value.fail(error.what());
        }
      });
}

const Fields<SeedsOfSplits>& seeds_keys() {
  static const Fields<SeedsOfSplits> keys({
      seeds_key(Split::kTrain, "Seeds to train with: 0..9 (both included), 3, or 0,4,7."),
      seeds_key(Split::kVal, "Seeds to choose by."),
      seeds_key(Split::kTest, "Seeds to test with."),
  });
  return keys;
}

void read_set(const YamlValue& value, std::vector<std::string>& set) {
  for (const YamlValue& line : value.list(0, kMostDrives)) {
    set.push_back(line.text());
    if (set.back().find('=') == std::string::npos) line.fail("expected key.path=value");
  }
}

template <class Struct>
Field<Struct> set_key(std::vector<std::string> Struct::*member) {
  return text("set", "Lines of the scenario that are changed: key.path=value.")
      .list(0, kMostDrives)
      .template by<Struct>(
          [member](const YamlValue& value, Struct& object) { read_set(value, object.*member); });
}

const Fields<DriveVariation>& variation_keys() {
  static const Fields<DriveVariation> keys({
      name_key("name", "Of the variation: letters, digits, _ and -.", &DriveVariation::name),
      set_key(&DriveVariation::set),
  });
  return keys;
}

void read_frames(const YamlValue& value, DriveGroup& drives) {
  try {
    drives.frames = parse_frames(value.text());
  } catch (const std::runtime_error&) {
    value.fail("expected frames such as 7, 0..90 or 0..90:10, every tenth of them");
  }
}

void read_variations(const YamlValue& value, DriveGroup& drives) {
  std::set<std::string> names;
  for (const YamlValue& entry : value.list(1, kMostDrives)) {
    drives.variations.push_back(variation_keys().read(entry));
    if (!names.insert(drives.variations.back().name).second)
      entry.at_key("name").refuse("expected a name of its own for each variation");
  }
}

const Fields<DriveGroup>& drive_keys() {
  static const Fields<DriveGroup> keys({
      name_key("name", "Of these drives: letters, digits, _ and -.", &DriveGroup::name),
      text("scenario", "The scenario's file, relative to the folder of this one.")
          .needed()
          .by<DriveGroup>([](const YamlValue& value, DriveGroup& drives) { drives.scenario = value.path(); }),
      set_key(&DriveGroup::set),
      text("frames", "Which steps get pictures: 7, 0..90 or 0..90:10. Default: all.")
          .otherwise_says("all")
          .by<DriveGroup>(read_frames),
      group("seeds", seeds_keys(), "Seeds of each split.")
          .needed()
          .by<DriveGroup>([](const YamlValue& value, DriveGroup& drives) {
            seeds_keys().read_into(value, drives.seeds_of);
          }),
      group("variations", variation_keys(), "The same worlds with something changed.")
          .list(1, kMostDrives)
          .by<DriveGroup>(read_variations),
  });
  return keys;
}

void read_formats(const YamlValue& value, Collection& collection) {
  collection.formats.clear();
  for (const YamlValue& entry : value.list(1, dataset_formats().size())) {
    collection.formats.push_back(&dataset_format(entry.text(), entry.place()));
    if (std::ranges::count(collection.formats, collection.formats.back()) > 1)
      entry.refuse("expected each format once");
  }
}

std::vector<std::string_view> truth_names() {
  std::vector<std::string_view> names;
  for (const TruthKind kind : parse_truth("all")) names.push_back(name_of(kind));
  names.push_back("all");
  return names;
}

void read_truth(const YamlValue& value, Collection& collection) {
  const std::vector<std::string_view> names = truth_names();
  std::set<TruthKind> kinds;
  for (const YamlValue& entry : value.list(1, names.size()))
    for (const TruthKind kind : parse_truth(std::string(names[entry.choice(names)]))) kinds.insert(kind);
  collection.truth.kinds.assign(kinds.begin(), kinds.end());
}

/// The drives are read by hand: what two of them may not have in common is said where it stands.
const Fields<Collection>& collection_keys() {
  static const Fields<Collection> keys({
      name_key("dataset", "Its name.", &Collection::name),
      group("about", about_keys(), "What is said of it in its data card.").fills(&Collection::about),
      text("formats", "How the files are laid out; several have a folder each. Default: plain.")
          .list(1, kMostDrives)
          .otherwise_says("plain")
          .by<Collection>(read_formats),
      text("truth", "Further truth of the format plain: balls, surface, range, ...; or all.")
          .list(1, kMostDrives)
          .by<Collection>(read_truth),
      choice("truth_format", {"exact", "kitti", "tiff"},
             "How depth, range, normals, disparity, match and flow are written.")
          .fills(&Collection::truth, &TruthRequest::format),
      group("pictures", picture_keys(), "What is changed of pictures, as by the options of render.")
          .fills(&Collection::change),
      group("drives", drive_keys(), "What is rendered.").list(1, kMostDrives).needed(),
  });
  return keys;
}

using World = std::pair<std::filesystem::path, std::uint64_t>;

/// Makes sure that frames of one world are not in two splits.
void claim_worlds(const YamlValue& entry, const DriveGroup& drives, std::map<World, Split>& split_of) {
  for (const Split split : kSplits)
    for (const std::uint64_t seed : drives.seeds_of.at(static_cast<std::size_t>(split))) {
      const auto claimed = split_of.emplace(World(drives.scenario, seed), split).first;
      if (claimed->second != split)
        YamlMap(entry, drive_keys())
            .at("seeds")
            .refuse(fmt::format("expected each world in one split: seed {} of {} is in {} and in {}", seed,
                                drives.scenario.filename().string(), name_of(claimed->second),
                                name_of(split)));
    }
}

/// Folders are called NAME, or NAME-VARIATION.
void claim_folders(const YamlValue& entry, const DriveGroup& drives, std::set<std::string>& folders) {
  for (const DriveVariation& variation : drives.variations)
    if (!folders.insert(folder_name(drives, variation)).second)
      entry.at_key("name").refuse("expected a name of its own for each group of drives and its variations");
}

}  // namespace

std::string_view name_of(Split split) {
  constexpr std::array<std::string_view, 3> kNames = {"train", "val", "test"};
  return kNames.at(static_cast<std::size_t>(split));
}

std::string folder_name(const DriveGroup& drives, const DriveVariation& variation) {
  return variation.name.empty() ? drives.name : fmt::format("{}-{}", drives.name, variation.name);
}

Collection read_collection(const std::filesystem::path& file) {
  const worlds::YamlDocument document = worlds::load_yaml(file, {}, collection_keys());
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, collection_keys());
  Collection collection = collection_keys().read(top);
  collection.file = file;
  std::map<World, Split> split_of;
  std::set<std::string> folders;
  for (const YamlValue& entry : YamlMap(top, collection_keys()).at("drives").list(1, kMostDrives)) {
    DriveGroup drives = drive_keys().read(entry);
    if (drives.variations.empty()) drives.variations.emplace_back();
    if (std::ranges::all_of(drives.seeds_of, [](const auto& seeds) { return seeds.empty(); }))
      entry.at_key("seeds").refuse("expected seeds of train, val or test");
    claim_worlds(entry, drives, split_of);
    claim_folders(entry, drives, folders);
    collection.drives.push_back(std::move(drives));
  }
  const bool has_plain =
      std::ranges::any_of(collection.formats, [](const auto* one) { return is_plain(*one); });
  if (!has_plain && !collection.truth.kinds.empty())
    YamlMap(top, collection_keys())
        .at("truth")
        .refuse(fmt::format("expected the format {} among `formats`: the others have their own truth",
                            dataset_formats().front().name));
  return collection;
}

}  // namespace stereobench::harness
