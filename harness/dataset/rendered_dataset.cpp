#include "harness/dataset/rendered_dataset.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/dataset/card/croissant.h"
#include "harness/dataset/card/data_card.h"
#include "harness/io/atomic_file.h"
#include "harness/io/sha256.h"
#include "harness/io/text_file.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {
namespace {

/// The folder's marker while frames are still being written.
constexpr const char* kUnfinished = "dataset.unfinished.json";

/// What every data set has beside the files of its format.
constexpr std::array kOwnFiles = {kDatasetJson, kUnfinished, kCardFile, kCroissantFile, kManifest};

bool is_own(const std::string& name) {
  return std::ranges::find(kOwnFiles, name) != kOwnFiles.end();
}

/// The markers that there are.
std::vector<std::filesystem::path> markers_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> markers;
  for (const char* marker : {kDatasetJson, kUnfinished})
    if (std::filesystem::exists(folder / marker)) markers.push_back(folder / marker);
  return markers;
}

/// What a marker says.
nlohmann::json read_marker(const std::filesystem::path& path) {
  try {
    nlohmann::json told = parse_line(read_text(path));
    if (told.is_object()) return told;
  } catch (const BadLine&) {
  }
  throw std::runtime_error(
      fmt::format("{}: is not what `render` writes; choose another folder or remove it", path.string()));
}

/// Whether files lie in a folder, those of every data set and what was half written aside.
bool holds_files(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) return false;
  const auto is_other = [&](const std::filesystem::directory_entry& entry) {
    return entry.is_regular_file() && entry.path().extension() != ".tmp" &&
           !is_own(entry.path().lexically_relative(folder).string());
  };
  return std::ranges::any_of(std::filesystem::recursive_directory_iterator(folder), is_other);
}

/// The keys that one of two objects has not, or with another value.
std::vector<std::string> differing_keys(const nlohmann::json& one, const nlohmann::json& other) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : one.items())
    if (!other.contains(key) || other[key] != value) keys.push_back(key);
  for (const auto& [key, value] : other.items())
    if (!one.contains(key)) keys.push_back(key);
  return keys;
}

std::vector<std::string> names_of(const std::vector<DatasetFile>& files) {
  std::vector<std::string> names;
  for (const DatasetFile& file : files) names.push_back(file.name);
  return names;
}

bool is_part(const std::string& name) {
  return *std::filesystem::path(name).begin() == kPartsFolder;
}

}  // namespace

void remove_used_parts(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / kManifest)) std::filesystem::remove_all(folder / kPartsFolder);
}

bool holds_rendering(const std::filesystem::path& folder) {
  return !markers_in(folder).empty() && holds_files(folder);
}

void require_same_rendering(const std::filesystem::path& folder, const nlohmann::ordered_json& identity) {
  if (!std::filesystem::exists(folder / kManifest) && !holds_files(folder)) return;
  for (const std::filesystem::path& marker : markers_in(folder)) {
    nlohmann::json told = read_marker(marker);
    for (const char* outcome : {kFrames, kBlur, "files"}) told.erase(outcome);  // files: before the manifest
    const auto differing = differing_keys(told, parse_line(identity.dump()));
    if (!differing.empty())
      throw std::runtime_error(
          fmt::format("{}: holds a data set of another {}; choose another folder or remove it",
                      marker.string(), fmt::join(differing, ", ")));
  }
}

RenderedDataset::RenderedDataset(std::filesystem::path folder, nlohmann::ordered_json identity)
    : folder_(std::move(folder)), identity_(std::move(identity)) {
  if (std::filesystem::exists(folder_)) prepare_output_folder(folder_);
  require_same_rendering(folder_, identity_);
  is_finished_ = std::filesystem::exists(folder_ / kManifest);
  if (is_finished_) spoilt_ = changed_files(folder_, read_manifest(folder_));
  if (std::filesystem::exists(folder_)) remove_leftovers(folder_);
  if (is_complete()) remove_used_parts(folder_);
  if (is_complete() || !holds_files(folder_)) std::filesystem::remove(folder_ / kUnfinished);
  if (spoilt_.empty()) return;
  begin({});
  // The manifest goes after what it finds spoilt: whoever is killed in between finds it again.
  for (const std::string& name : spoilt_) std::filesystem::remove(folder_ / name);
  for (const char* name : {kManifest, kDatasetJson}) std::filesystem::remove(folder_ / name);
}

/// Makes the folders of files, and says that there is a data set which is not finished.
void RenderedDataset::begin(const std::vector<std::string>& names) {
  prepare_output_folder(folder_);
  for (const std::string& name : names) {
    if (is_own(name)) throw std::logic_error(fmt::format("{}: is no format's file", name));
    prepare_output_folder((folder_ / name).parent_path());
  }
  if (!std::filesystem::exists(folder_ / kUnfinished))
    write_file_atomically(folder_ / kUnfinished, identity_.dump(2) + "\n");
}

void RenderedDataset::write(std::size_t step, const std::vector<DatasetFile>& files) {
  begin(names_of(files));
  frames_.insert(step);
  AtomicFiles written;
  for (const DatasetFile& file : files) {
    const bool exists = std::filesystem::exists(folder_ / file.name);
    const std::string bytes = exists ? std::string() : file.bytes();
    if (!exists) written.write(folder_ / file.name, bytes);
    if (is_part(file.name)) continue;
    std::string& hash = files_[file.name];
    if (!exists) hash = sha256_of(bytes);  // here, since who reads a large set again reads it from the disk
  }
  written.move_into_place();
}

void RenderedDataset::finish(const std::vector<DatasetFile>& files, const CoarseBlur& blur,
                             const std::vector<DatasetContainer>& containers) {
  std::vector<std::string> names = names_of(files);
  for (const DatasetContainer& container : containers) names.push_back(container.name);
  begin(names);
  for (const DatasetContainer& container : containers) {
    AtomicFile file(folder_ / container.name);
    container.write(file, folder_);
    file.move_into_place();
    files_[container.name];
  }
  AtomicFiles written;
  for (const DatasetFile& file : files) {
    const std::string bytes = file.bytes();
    written.write(folder_ / file.name, bytes);
    files_[file.name] = sha256_of(bytes);
  }
  written.move_into_place();
  remove_leftovers(folder_);  // of one that was just dying when this one began
  nlohmann::ordered_json marker = identity_;
  marker[kFrames] = frames_;
  marker[kBlur] = blur_json(blur);
  hash_others(folder_, files_);
  seal({.folder = folder_, .marker = std::move(marker), .files = files_});
  remove_used_parts(folder_);
}

/// Adds what every data set has, and last of all the manifest.
void RenderedDataset::seal(const DatasetFacts& facts) {
  std::vector<std::pair<std::string, std::string>> own = {{kDatasetJson, facts.marker.dump(2) + "\n"},
                                                          {kCardFile, data_card(facts)}};
  own.emplace_back(kCroissantFile, croissant_of(facts, own));
  FileHashes listed = facts.files;
  AtomicFiles written;
  for (const auto& [name, text] : own) {
    written.write(folder_ / name, text);
    listed[name] = sha256_of(text);
  }
  written.move_into_place();
  sync_file_system(folder_);  // the manifest says that all of it is there
  write_file_atomically(folder_ / kManifest, manifest_text(listed));
  std::filesystem::remove(folder_ / kUnfinished);
}

}  // namespace stereobench::harness
