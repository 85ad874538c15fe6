/// What dataset.json says of a drive: its cameras, exactly, and when they look.
#pragma once

#include <nlohmann/json.hpp>

#include "harness/dataset/dataset_drive.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {

/// The key of dataset.json.
inline constexpr const char* kDrive = "drive";

/// The drive's name, rigs, shutter and encoding. Numbers are read back exactly.
nlohmann::ordered_json drive_json(const DatasetDrive& drive);

/// A rig as drive_json has it.
/// @throws BadLine for what is not exactly so, and for a rig that cannot be computed with
vision::StereoRig read_rig(const JsonValue& json);

/// Fills in what drive_json says.
/// @throws BadLine for what is not exactly so
void read_drive(const JsonValue& json, DatasetDrive& drive);

}  // namespace stereobench::harness
