#include "harness/frames/pair_files.h"

#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "harness/io/atomic_file.h"
#include "harness/io/calibration_file.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRigFile = "calibration.yaml";
constexpr const char* kLeft = "_left.jpg";
constexpr const char* kRight = "_right.jpg";

fs::path file_of(const fs::path& out, std::uint64_t seed, std::size_t frame, const char* side) {
  return out / kFrames / fmt::format("seed{}_frame{:04}{}", seed, frame, side);
}

}  // namespace

void remove_pairs(const fs::path& out) {
  std::error_code no_such_folder;
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(out / kFrames, no_such_folder)) {
    const std::string name = entry.path().filename().string();
    if (name == kRigFile || name.ends_with(kLeft) || name.ends_with(kRight)) old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file);
}

void add_pair(const fs::path& out, const KeptPair& pair) {
  prepare_output_folder(out / kFrames);
  write_file_atomically(file_of(out, pair.seed, pair.frame, kLeft), pair.left_jpeg);
  write_file_atomically(file_of(out, pair.seed, pair.frame, kRight), pair.right_jpeg);
}

void write_pairs(const fs::path& out, std::span<const KeptPair> pairs, const vision::StereoRig& rig) {
  remove_pairs(out);
  if (pairs.empty()) return;
  for (const KeptPair& pair : pairs) add_pair(out, pair);
  write_file_atomically(out / kFrames / kRigFile, calibration_yaml(rig));
}

std::optional<KeptPair> read_pair(const fs::path& out, std::uint64_t seed, std::size_t frame) {
  const fs::path left = file_of(out, seed, frame, kLeft);
  const fs::path right = file_of(out, seed, frame, kRight);
  if (!fs::exists(left) || !fs::exists(right)) return std::nullopt;
  return KeptPair{seed, frame, {}, read_text(left), read_text(right)};
}

std::optional<vision::StereoRig> rig_of_pairs(const fs::path& out) {
  const fs::path file = out / kFrames / kRigFile;
  if (!fs::exists(file)) return std::nullopt;
  return read_calibration(file);
}

}  // namespace stereobench::harness
