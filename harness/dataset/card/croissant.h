/// Croissant, the metadata of MLCommons for data sets (http://mlcommons.org/croissant/1.0), as JSON-LD.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/dataset/card/dataset_facts.h"

namespace stereobench::harness {

/// What stands at the top of a Croissant file. What is empty is left out: the program makes up no creator,
/// place or date.
struct CroissantHead {
  std::string name;
  std::string description;
  std::string version;    ///< of the program
  std::string licence;    ///< empty: kLicenceText
  std::string creator;    ///< a person or an organisation
  std::string url;        ///< where the data is
  std::string published;  ///< YYYY-MM-DD
};

/// A file whose place and hash are known. @param hash SHA-256
nlohmann::ordered_json file_object(const std::string& name, const std::string& hash, std::uintmax_t bytes,
                                   const std::string& says);

/// Files by their names. @param id what records call it @param globs as of format_layout.h
nlohmann::ordered_json file_set(const std::string& id, const std::vector<std::string>& globs,
                                const std::string& says);

/// A record for each line of a CSV file. @param header its first line
nlohmann::ordered_json table_records(const std::string& file, const std::string& header);

/// A record for each picture of a file set.
nlohmann::ordered_json picture_records(const std::string& set);

/// The media type of a file or glob, by its ending.
std::string media_type(const std::string& name);

/// The whole file's text.
/// @param distribution of file objects and file sets @param records the record sets
std::string croissant_text(const CroissantHead& head, const nlohmann::ordered_json& distribution,
                           const nlohmann::ordered_json& records);

/// The Croissant file of one data set.
/// @param own what the data set adds to the files of its format: dataset.json and the card, with their texts
std::string croissant_of(const DatasetFacts& facts,
                         const std::vector<std::pair<std::string, std::string>>& own);

}  // namespace stereobench::harness
