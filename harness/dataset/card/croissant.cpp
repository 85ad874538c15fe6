#include "harness/dataset/card/croissant.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "harness/dataset/card/data_card.h"
#include "harness/io/sha256.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// The context that the specification prescribes.
Json context() {
  Json context = {{"@language", "en"}, {"@vocab", "https://schema.org/"}};
  for (const char* term :
       {"citeAs",   "column",      "extract",   "field",         "fileProperty", "fileObject",
        "fileSet",  "format",      "includes",  "isLiveDataset", "jsonPath",     "key",
        "md5",      "parentField", "path",      "recordSet",     "references",   "regex",
        "repeated", "replace",     "separator", "source",        "subField",     "transform"})
    context[term] = fmt::format("cr:{}", term);
  context["conformsTo"] = "dct:conformsTo";
  context["cr"] = "http://mlcommons.org/croissant/";
  context["rai"] = "http://mlcommons.org/croissant/RAI/";
  context["data"] = {{"@id", "cr:data"}, {"@type", "@json"}};
  context["dataType"] = {{"@id", "cr:dataType"}, {"@type", "@vocab"}};
  context["examples"] = {{"@id", "cr:examples"}, {"@type", "@json"}};
  context["dct"] = "http://purl.org/dc/terms/";
  context["sc"] = "https://schema.org/";
  return context;
}

struct MediaType {
  const char* ending;
  const char* type;
};

constexpr auto kMediaTypes = std::to_array<MediaType>({
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".pfm", "image/x-portable-floatmap"},
    {".tiff", "image/tiff"},
    {".csv", "text/csv"},
    {".txt", "text/plain"},
    {".dat", "text/plain"},
    {".md", "text/markdown"},
    {".json", "application/json"},
    {".jsonl", "application/jsonlines"},
    {".yaml", "application/yaml"},
    {".tar", "application/x-tar"},
    {".gz", "application/gzip"},
});

/// What a column of a table holds.
const char* type_of_column(const std::string& column) {
  constexpr std::array kNames = {"kind",  "filename", "path_rgb_0", "path_rgb_1", "drive",
                                 "split", "scenario", "variation",  "format",     "folder"};
  constexpr std::array kCounts = {"step", "colour", "colour_class", "has_pictures", "index",
                                  "seed", "pairs",  "files",        "bytes"};
  if (std::ranges::find(kNames, column) != kNames.end()) return "sc:Text";
  const bool counts = std::ranges::find(kCounts, column) != kCounts.end() || column.ends_with("_id") ||
                      column.ends_with("[ns]") || column.ends_with("(ns)") || column == "#timestamp";
  return counts ? "sc:Integer" : "sc:Float";
}

std::string first_line_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// What records call a set of files: its glob with `all` for the stars.
std::string id_of(const std::string& glob) {
  std::string id;
  for (const char c : glob) id += c == '*' ? std::string("all") : std::string(1, c);
  return id;
}

}  // namespace

std::string media_type(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  const auto* const found =
      std::ranges::find_if(kMediaTypes, [&](const MediaType& media) { return media.ending == ending; });
  return found == kMediaTypes.end() ? "application/octet-stream" : found->type;
}

Json file_object(const std::string& name, const std::string& hash, std::uintmax_t bytes,
                 const std::string& says) {
  Json object = {{"@type", "cr:FileObject"}, {"@id", name}, {"name", name}};
  if (!says.empty()) object["description"] = says;
  object["contentUrl"] = name;
  object["contentSize"] = fmt::format("{} B", bytes);
  object["encodingFormat"] = media_type(name);
  object["sha256"] = hash;
  return object;
}

Json file_set(const std::string& id, const std::vector<std::string>& globs, const std::string& says) {
  Json set = {{"@type", "cr:FileSet"}, {"@id", id}, {"name", id}};
  if (!says.empty()) set["description"] = says;
  set["encodingFormat"] = media_type(globs.front());
  set["includes"] = globs.size() == 1 ? Json(globs.front()) : Json(globs);
  return set;
}

Json table_records(const std::string& file, const std::string& header) {
  Json fields = Json::array();
  std::istringstream columns(header);
  for (std::string column; std::getline(columns, column, ',');)
    fields.push_back({{"@type", "cr:Field"},
                      {"@id", fmt::format("{}/lines/{}", file, column)},
                      {"name", column},
                      {"dataType", type_of_column(column)},
                      {"source", {{"fileObject", {{"@id", file}}}, {"extract", {{"column", column}}}}}});
  return {{"@type", "cr:RecordSet"}, {"@id", file + "/lines"}, {"name", file + "/lines"}, {"field", fields}};
}

Json picture_records(const std::string& set) {
  const auto field = [&](const char* name, const char* type, const char* property) {
    return Json{{"@type", "cr:Field"},
                {"@id", fmt::format("{}/pictures/{}", set, name)},
                {"name", name},
                {"dataType", type},
                {"source", {{"fileSet", {{"@id", set}}}, {"extract", {{"fileProperty", property}}}}}};
  };
  return {{"@type", "cr:RecordSet"},
          {"@id", set + "/pictures"},
          {"name", set + "/pictures"},
          {"field", Json::array({field("file", "sc:Text", "fullpath"),
                                 field("picture", "sc:ImageObject", "content")})}};
}

std::string croissant_text(const CroissantHead& head, const Json& distribution, const Json& records) {
  Json top = {{"@context", context()},
              {"@type", "sc:Dataset"},
              {"conformsTo", "http://mlcommons.org/croissant/1.0"},
              {"name", head.name},
              {"description", head.description},
              {"license", head.licence.empty() ? kLicenceText : head.licence},
              {"version", head.version}};
  if (!head.creator.empty()) top["creator"] = {{"@type", "sc:Organization"}, {"name", head.creator}};
  if (!head.url.empty()) top["url"] = head.url;
  if (!head.published.empty()) top["datePublished"] = head.published;
  top["distribution"] = distribution;
  top["recordSet"] = records;
  return top.dump(1) + "\n";
}

std::string croissant_of(const DatasetFacts& facts,
                         const std::vector<std::pair<std::string, std::string>>& own) {
  Json distribution = Json::array(), records = Json::array();
  for (const auto& [name, text] : own)
    distribution.push_back(file_object(name, sha256_of(text), text.size(), ""));
  for (const FileGroup& group : file_groups(facts)) {
    if (!group.is_file()) {
      distribution.push_back(file_set(id_of(group.glob), {group.glob}, group.says));
      if (group.glob.ends_with(".png")) records.push_back(picture_records(id_of(group.glob)));
    }
    for (const std::string& name : group.names) {
      const bool is_table = name.ends_with(".csv");
      if (!group.is_file() && !is_table) continue;  // the manifest has their hashes
      distribution.push_back(file_object(name, facts.files.at(name),
                                         std::filesystem::file_size(facts.folder / name), group.says));
      if (is_table) records.push_back(table_records(name, first_line_of(facts.folder / name)));
    }
  }
  const std::size_t pairs = facts.marker.value("frames", Json::array()).size();
  return croissant_text({.name = title_of(facts),
                         .description = fmt::format(
                             "{} rendered stereo pairs of one drive{}, with exact truth, in the layout {}. "
                             "{} describes it; {} has the SHA-256 of each file.",
                             pairs, lack_of_pictures(facts), format_of(facts), kCardFile, kManifest),
                         .version = facts.marker.value("stereobench", std::string()),
                         .licence = {},
                         .creator = {},
                         .url = {},
                         .published = {}},
                        distribution, records);
}

}  // namespace stereobench::harness
