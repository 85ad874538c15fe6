/// What a person says of pictures: here is a red one.
///
///     {"marks": [{"picture": "smarties.png", "colour": "red", "circle_px": [34.0, 229.0, 20.0]},
///                {"picture": "smarties.png", "colour": "green", "box_px": [250.0, 100.0, 30.0, 30.0]}]}
///
/// A circle has its centre (column, row) and radius, a box its left, top, width and height. They should lie
/// within what they mark. Pictures are looked for beside the file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "harness/dataset/palette_file.h"

namespace stereobench::harness {

/// The pixels of what was marked, BGR levels as they are stored, by colour; and the colours in the order of
/// the file.
struct MarkedPixels {
  worlds::Encoding encoding = worlds::Encoding::kLinear;  ///< of the pictures
  std::vector<std::string> colours;
  std::map<std::string, std::vector<Eigen::Vector3d>> pixels;
};

/// Reads a file of marks and the pictures that it names.
/// @param encoding auto, linear or srgb, as encoding_of (picture_reader.h) takes it
/// @throws std::runtime_error, one line, for what is not exactly as above, pictures that cannot be read, and
///   marks that hold no pixel of their picture
MarkedPixels read_marked_pixels(const std::filesystem::path& file, const std::string& encoding);

}  // namespace stereobench::harness
