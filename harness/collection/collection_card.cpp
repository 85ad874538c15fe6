#include "harness/collection/collection_card.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/collection/collection_folder.h"
#include "harness/dataset/card/croissant.h"
#include "harness/dataset/card/data_card.h"
#include "harness/dataset/card/format_layout.h"
#include "harness/io/sha256.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// What is shown of a split's drives of one name.
struct Share {
  std::set<std::uint64_t> seeds;
  std::size_t pairs = 0;
};

std::string shares_text(const std::vector<IndexLine>& lines) {
  std::map<std::pair<std::string, std::string>, Share> shares;  // by folder: "train/ball_circle"
  std::vector<std::pair<std::string, std::string>> order;
  for (const IndexLine& line : lines) {
    const CollectionEntry& entry = *line.entry;
    const auto key = std::pair(fmt::format("{}/{}{}{}", entry.split, entry.name,
                                           entry.variation.empty() ? "" : "-", entry.variation),
                               entry.format);
    if (!shares.contains(key)) order.push_back(key);
    shares[key].seeds.insert(entry.seed);
    shares[key].pairs += line.pairs;
  }
  std::string table = "| drives | format | seeds | stereo pairs |\n|---|---|---:|---:|\n";
  for (const auto& key : order)
    table += fmt::format("| `{}` | {} | {} | {} |\n", key.first, key.second, shares[key].seeds.size(),
                         shares[key].pairs);
  return table;
}

/// A glob of a data set's files as one of the collection's: train/*/seed_*/left/*.png.
std::string collection_glob(const CollectionEntry& entry, std::string_view glob) {
  const std::filesystem::path folder(entry.folder);
  const std::filesystem::path format = folder.parent_path().filename();
  const bool has_format_folder = std::ranges::distance(folder) > 3;
  return fmt::format("{}/*/{}seed_*/{}", entry.split, has_format_folder ? format.string() + "/" : "", glob);
}

/// The files of all data sets by kind and split.
/// @return what each glob of the collection holds
std::map<std::string, std::string_view> kinds_of_files(const CollectionRecord& record,
                                                       const FileHashes& files) {
  std::map<std::string, std::string_view> kinds;
  for (const CollectionEntry& entry : record.datasets) {
    const std::string prefix = entry.folder + "/";
    for (auto file = files.lower_bound(prefix); file != files.end() && file->first.starts_with(prefix);
         ++file) {
      const auto* const known =
          layout_entry_of(entry.format, std::string_view(file->first).substr(prefix.size()));
      if (known != nullptr) kinds[collection_glob(entry, known->glob)] = known->says;
    }
  }
  return kinds;
}

/// The splits as the specification has them.
Json split_records(const CollectionRecord& record) {
  Json data = Json::array();
  std::set<std::string> names;
  for (const CollectionEntry& entry : record.datasets)
    if (names.insert(entry.split).second) data.push_back({{"splits/name", entry.split}});
  return {{"@type", "cr:RecordSet"},
          {"@id", "splits"},
          {"name", "splits"},
          {"dataType", "cr:Split"},
          {"key", {{"@id", "splits/name"}}},
          {"field",
           Json::array(
               {{{"@type", "cr:Field"}, {"@id", "splits/name"}, {"name", "name"}, {"dataType", "sc:Text"}}})},
          {"data", data}};
}

std::string id_of(const std::string& glob) {
  std::string id;
  for (const char c : glob) id += c == '*' ? std::string("all") : std::string(1, c);
  return id;
}

}  // namespace

std::string collection_card(const CollectionRecord& record, const std::vector<IndexLine>& lines) {
  std::string about = record.about.description.empty() ? "" : record.about.description + "\n\n";
  if (!record.about.creator.empty()) about += fmt::format("Made by {}.\n\n", record.about.creator);
  return fmt::format(
      "# {}\n\n{}"
      "Rendered stereo pairs with exact truth: {} data sets, each of one drive through one world.\n\n"
      "## How it was made\n\n"
      "stereobench {} made it, a program that renders worlds of coloured balls. No camera took these "
      "pictures.\n\n    stereobench dataset {}.yaml --out {}\n\n"
      "Each data set has a page of its own, with the command that renders it alone.\n\n"
      "## Splits\n\n{}\n"
      "A world is a scenario with a seed. All its frames and variations are in one split.\n\n"
      "## Files\n\n"
      "- `SPLIT/NAME/seed_N/`: a data set of the drives NAME; variations are called NAME-VARIATION. Of "
      "several "
      "formats, each has a folder in it.\n"
      "- `{}`: a line for each data set.\n"
      "- `{}`: what each data set was rendered from, as a hash.\n"
      "- `{}`: SHA-256 of each file; `sha256sum -c {}` checks them.\n\n{}\n"
      "## Licence\n\n{}\n",
      record.name, about, lines.size(), record.version, record.name, record.name, shares_text(lines),
      kIndexFile, kCollectionFile, kManifest, kManifest, conventions_text(),
      record.about.licence.empty() ? kLicenceText : record.about.licence);
}

std::string collection_croissant(const CollectionRecord& record, const FileHashes& files,
                                 const std::vector<std::pair<std::string, std::string>>& own) {
  Json distribution = Json::array();
  for (const auto& [name, text] : own)
    distribution.push_back(file_object(name, sha256_of(text), text.size(), ""));
  Json records = Json::array({split_records(record), table_records(kIndexFile, kIndexHeader)});
  for (const auto& [glob, says] : kinds_of_files(record, files)) {
    distribution.push_back(file_set(id_of(glob), {glob}, std::string(says)));
    if (glob.ends_with(".png")) records.push_back(picture_records(id_of(glob)));
  }
  const std::string described = record.about.description.empty() ? "" : record.about.description + " ";
  return croissant_text({.name = record.name,
                         .description = fmt::format(
                             "{}{} data sets of rendered stereo pairs with exact truth. {} describes them; "
                             "{} has the SHA-256 of each file.",
                             described, record.datasets.size(), kCardFile, kManifest),
                         .version = record.version,
                         .licence = record.about.licence,
                         .creator = record.about.creator,
                         .url = record.about.url,
                         .published = record.about.published},
                        distribution, records);
}

}  // namespace stereobench::harness
