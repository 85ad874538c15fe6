/// Rendered stereo pairs with their truth, as a plain folder that any program can read.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/dataset/card/dataset_facts.h"
#include "harness/dataset/formats/dataset_writer.h"
#include "harness/drive/coarse_blur.h"

namespace stereobench::harness {

/// The finished data set's key that lists the frames it has pictures of.
inline constexpr const char* kFrames = "frames";

/// And the one that says how coarse their motion blur is.
inline constexpr const char* kBlur = "blur";

/// The folder of a data set of any format. Which files it has, the format's DatasetWriter says. Beside them
/// lie dataset.json (what was rendered, which frames there are, how coarse their blur is), a data card for
/// people and one for machines (harness/dataset/card/), and the manifest with the SHA-256 of each file, which
/// is written last: where it is, the folder is complete.
class RenderedDataset {
 public:
  /// Takes up a folder where one that was interrupted lies. Nothing is created before the first frame is
  /// written: whatever fails until then leaves nothing behind.
  /// Files of a finished data set that are missing, or do not hold what they held, are removed; they are
  /// written again with the frames that they belong to.
  /// @param identity of what is rendered, an object: scenario, overrides, seed, version
  /// @throws std::runtime_error when the folder cannot be written, or holds another rendering
  RenderedDataset(std::filesystem::path folder, nlohmann::ordered_json identity);

  /// Whether all of it is there, as it was written.
  bool is_complete() const { return is_finished_ && spoilt_.empty(); }

  /// The files that were removed because they were not as they had been written.
  const std::vector<std::string>& spoilt() const { return spoilt_; }

  /// Writes those files of a step's stereo pair that are not there yet, parts of containers too. Every step
  /// that has pictures is written before `finish`, also where an interrupted rendering goes on.
  void write(std::size_t step, const std::vector<DatasetFile>& files);

  /// Writes the files of the drive, the containers, dataset.json and the cards, and last of all the manifest.
  /// Then the containers' parts go: whoever is killed before has not lost them.
  /// @param blur of all its pictures
  void finish(const std::vector<DatasetFile>& files, const CoarseBlur& blur,
              const std::vector<DatasetContainer>& containers = {});

 private:
  void begin(const std::vector<std::string>& names);
  void seal(const DatasetFacts& facts);

  std::filesystem::path folder_;
  nlohmann::ordered_json identity_;
  bool is_finished_ = false;
  std::vector<std::string> spoilt_;
  std::set<std::size_t> frames_;  ///< that were written
  FileHashes files_;              ///< all of them; hashes of those written just now, others empty
};

/// Removes the parts of containers that a finished data set has no more use for: whoever wrote it was killed
/// right after the manifest. Those of an unfinished one stay.
void remove_used_parts(const std::filesystem::path& folder);

/// Makes sure that a folder holds no other rendering, finished or not, than the one that is asked for. What
/// was begun and has no file yet is none.
/// @param identity as of RenderedDataset
/// @throws std::runtime_error, one line that names the keys of the identity that differ
void require_same_rendering(const std::filesystem::path& folder, const nlohmann::ordered_json& identity);

/// Whether a folder holds a rendering, finished or not.
bool holds_rendering(const std::filesystem::path& folder);

}  // namespace stereobench::harness
