#include "harness/collection/collection_record.h"

#include <array>

#include "harness/dataset/rendered_dataset.h"
#include "harness/io/json_file.h"
#include "harness/io/sha256.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostEntries = 10'000'000;

template <class Struct>
struct Text {
  const char* key;
  std::string Struct::*member;
};

constexpr std::array kAboutTexts = {Text<CollectionAbout>{"description", &CollectionAbout::description},
                                    Text<CollectionAbout>{"licence", &CollectionAbout::licence},
                                    Text<CollectionAbout>{"creator", &CollectionAbout::creator},
                                    Text<CollectionAbout>{"url", &CollectionAbout::url},
                                    Text<CollectionAbout>{"published", &CollectionAbout::published}};
constexpr std::array kEntryTexts = {
    Text<CollectionEntry>{"folder", &CollectionEntry::folder},
    Text<CollectionEntry>{"split", &CollectionEntry::split},
    Text<CollectionEntry>{"name", &CollectionEntry::name},
    Text<CollectionEntry>{"variation", &CollectionEntry::variation},
    Text<CollectionEntry>{"format", &CollectionEntry::format},
    Text<CollectionEntry>{"scenario", &CollectionEntry::scenario},
    Text<CollectionEntry>{"identity_sha256", &CollectionEntry::identity_sha256}};

template <class Struct, std::size_t Count>
Json texts_json(const Struct& value, const std::array<Text<Struct>, Count>& texts) {
  Json json = Json::object();
  for (const auto& [key, member] : texts) json[key] = value.*member;
  return json;
}

template <class Struct, std::size_t Count>
void read_texts(const JsonValue& json, const std::array<Text<Struct>, Count>& texts, Struct& value) {
  for (const auto& [key, member] : texts) value.*member = json.at(key).text();
}

/// Names become paths: none leads out of the collection.
void check_folder(const JsonValue& json, const std::string& folder) {
  const std::filesystem::path path(folder);
  if (path.is_absolute() || path != path.lexically_normal() || !path.has_filename() || *path.begin() == "..")
    json.refuse("a folder within the collection");
}

CollectionEntry entry_from(const JsonValue& json) {
  CollectionEntry entry;
  read_texts(json, kEntryTexts, entry);
  check_folder(json.at("folder"), entry.folder);
  entry.seed = json.at("seed").natural_number();
  return entry;
}

}  // namespace

std::string identity_hash(const nlohmann::json& marker) {
  nlohmann::json identity = marker;
  for (const char* outcome : {kFrames, kBlur}) identity.erase(outcome);
  return sha256_of(identity.dump());
}

std::string collection_json(const CollectionRecord& record) {
  Json json = {{"schema", 1}, {"dataset", record.name}, {"stereobench", record.version}};
  json["about"] = texts_json(record.about, kAboutTexts);
  json["datasets"] = Json::array();
  for (const CollectionEntry& entry : record.datasets) {
    json["datasets"].push_back(texts_json(entry, kEntryTexts));
    json["datasets"].back()["seed"] = entry.seed;
  }
  return json_text(json);
}

CollectionRecord read_collection_record(const std::filesystem::path& folder) {
  return read_json_file(folder / kCollectionFile, [](const JsonValue& json) {
    if (json.at("schema").integer(0, 1000) != 1) json.at("schema").refuse("1");
    CollectionRecord record = {.name = json.at("dataset").text(),
                               .version = json.at("stereobench").text(),
                               .about = {},
                               .datasets = {}};
    read_texts(json.at("about"), kAboutTexts, record.about);
    for (const JsonValue& entry : json.at("datasets").list(1, kMostEntries))
      record.datasets.push_back(entry_from(entry));
    return record;
  });
}

}  // namespace stereobench::harness
