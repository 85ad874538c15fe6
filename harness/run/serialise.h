/// Results on their way from a worker process to its parent, exact to the last bit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "harness/run/seed_drive.h"

namespace stereobench::harness {

/// A drive as bytes (CBOR); numbers that are not finite survive.
std::string to_bytes(const SeedDrive& drive);

/// What to_bytes made bytes of.
SeedDrive seed_drive_from_bytes(std::string_view bytes);

/// Filter runs as bytes, and back.
std::string to_bytes(const std::vector<FilterRun>& runs);
std::vector<FilterRun> filter_runs_from_bytes(std::string_view bytes);

}  // namespace stereobench::harness
