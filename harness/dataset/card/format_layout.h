/// What the files of each data-set format are, in words: for the data card and for Croissant.
#pragma once

#include <span>
#include <string_view>

namespace stereobench::harness {

/// Files of a format that hold the same kind of thing.
struct LayoutEntry {
  std::string_view format;  ///< as of DatasetFormat
  std::string_view glob;    ///< their names, as fnmatch has it; `*` stands for no `/`
  std::string_view says;    ///< what they hold: unit, frame, and what stands for no value
};

/// All formats' entries. Of several that fit a file, the first one counts.
std::span<const LayoutEntry> layout_entries();

/// Whether a format has pictures, also in a container; one is of logs alone.
bool has_pictures(std::string_view format);

/// @return the entry of a file; none where nobody has said what it holds
const LayoutEntry* layout_entry_of(std::string_view format, std::string_view file);

}  // namespace stereobench::harness
