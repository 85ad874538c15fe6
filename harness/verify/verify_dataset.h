/// Proof of a data set: each file is opened again, and all that it says twice is held against itself.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/verify/readers/reader_registry.h"

namespace stereobench::harness {

/// What was found.
struct Verification {
  std::string format;
  std::vector<Fault> faults;         ///< each once, in the order in which they were found
  std::vector<std::string> checked;  ///< "12 files by SHA-256", "flow against depth and poses (512 points)"
  std::vector<std::string> cannot;   ///< what nothing in the folder can be held against, and why
  Margins margins;                   ///< for studies of the limits
};

/// Checks a folder.
/// @param on_progress is told the share that is done, 0 to 1
/// @throws std::runtime_error, one line, where the folder is none of the reader's format
Verification verify_dataset(const std::filesystem::path& folder, const DatasetReader& reader,
                            const std::function<void(double)>& on_progress);

/// Faults that several checks have found are named once.
void leave_out_repeated(std::vector<Fault>& faults);

/// "left_depth/000002.pfm: frame 000002: NaN at column 3, row 4".
std::string line_of(const Fault& fault);

}  // namespace stereobench::harness
