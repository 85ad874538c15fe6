/// Which files a finished data set has, and what is in them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace stereobench::harness {

/// Where the pictures of a folder of `import` are from, and their times.
inline constexpr const char* kPicturesFile = "pictures.csv";

/// What a data set was rendered from.
inline constexpr const char* kDatasetJson = "dataset.json";

/// Its key that says what size balls are made to.
inline constexpr const char* kBallSize = "balls";
/// Where dataset.json says by how many rows vision was told that the rig may be off.
inline constexpr const char* kRowsWithin = "rows_within_px";

/// The list of all files with their SHA-256, in the form of BagIt (RFC 8493), which `sha256sum -c` reads. It
/// is written last: where it is, the folder is complete.
inline constexpr const char* kManifest = "manifest-sha256.txt";

/// SHA-256 of files, as 64 hexadecimal digits, by their place in a folder: "left/000012.png".
using FileHashes = std::map<std::string, std::string>;

/// Hashes those files of a folder whose hash is empty. @throws std::runtime_error when one cannot be read
void hash_others(const std::filesystem::path& folder, FileHashes& files);

/// The manifest: a line for each file, sorted by name.
std::string manifest_text(const FileHashes& files);

/// A line of a manifest, whoever wrote it: blanks may be other ones, digits large, names as BagIt writes
/// them.
struct ListedFile {
  long line = 0;         ///< from 1
  std::string name;      ///< its place in the folder
  std::string hash;      ///< small letters
  std::string expected;  ///< what the line had to be; empty where it is that
};

/// The lines of a folder's manifest. @throws std::runtime_error when it cannot be read
std::vector<ListedFile> listed_files(const std::filesystem::path& folder);

/// Whether a file is there and holds what its hash says.
bool is_as_listed(const std::filesystem::path& file, const std::string& hash);

/// Reads a folder's manifest.
/// @throws std::runtime_error "file:line: what was expected" where it is none, or a name leads out of the
///   folder
FileHashes read_manifest(const std::filesystem::path& folder);

/// The files that are missing, or do not hold what they held.
std::vector<std::string> changed_files(const std::filesystem::path& folder, const FileHashes& files);

/// Checks that log, calibrations and balls of a data set are as they were rendered; its pictures say
/// themselves when they are cut short. A folder without a manifest is let be.
/// @throws std::runtime_error that names the file and says what to do
void require_as_rendered(const std::filesystem::path& folder);

}  // namespace stereobench::harness
