/// TIFF files in memory, as libtiff reads and writes them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <tiffio.h>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {

struct TiffInput {
  PictureBytes bytes;
  std::size_t at = 0;
  std::string complaint = "its parts cannot be made out";  ///< what libtiff says, where it fails
};

struct TiffOutput {
  std::string bytes;
  std::size_t at = 0;
};

using OpenTiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

/// @param input outlives what is opened. @return null where it is no TIFF
OpenTiff open_tiff(TiffInput& input);

/// A file that is written. @param output outlives what is opened, and is whole when that is closed
OpenTiff open_tiff(TiffOutput& output);

/// A tag's number, 0 where there is none.
template <typename Number>
Number tiff_tag(TIFF* tiff, std::uint32_t name) {
  Number value = 0;
  TIFFGetFieldDefaulted(tiff, name, &value);
  return value;
}

}  // namespace stereobench::renderer
