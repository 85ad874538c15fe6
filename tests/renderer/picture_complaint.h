/// What is said of pictures that cannot be read.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "renderer/pictures/picture_reader.h"
#include "tests/complaint.h"

namespace stereobench::renderer::test {

/// @param longest_px as decode_picture takes it
inline std::string complaint(const std::vector<std::uint8_t>& file,
                             int longest_px = std::numeric_limits<int>::max()) {
  return complaint_of([&] { decode_picture(file, longest_px); });
}

}  // namespace stereobench::renderer::test
