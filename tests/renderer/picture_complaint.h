/// What is said of pictures that cannot be read.
#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/pictures/picture_reader.h"

namespace stereobench::renderer::test {

/// @param longest_px as decode_picture takes it
inline std::string complaint(const std::vector<std::uint8_t>& file,
                             int longest_px = std::numeric_limits<int>::max()) {
  try {
    decode_picture(file, longest_px);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace stereobench::renderer::test
