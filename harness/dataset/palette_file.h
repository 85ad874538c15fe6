/// Learned colours as a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vision/colour/learned_palette.h"
#include "worlds/camera_sensor.h"

namespace stereobench::harness {

/// Colours, and how the levels that they were learned from, as these are stored, stand for light.
struct PaletteFile {
  std::vector<vision::LearnedColour> colours;  ///< 1 to 254, with names of their own
  worlds::Encoding encoding = worlds::Encoding::kLinear;
};

/// The palette as JSON. Numbers are read back exactly.
std::string palette_json(const PaletteFile& palette);

/// @throws std::runtime_error, one line, for a file that is missing or is not exactly what palette_json
/// writes
PaletteFile read_palette(const std::filesystem::path& file);

/// The same of a text. @param name what it is called in errors
PaletteFile parse_palette(const std::string& text, const std::filesystem::path& name);

}  // namespace stereobench::harness
