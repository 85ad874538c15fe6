#include "harness/commands/dataset_talk.h"

#include <fmt/format.h>

#include "harness/process/standard_streams.h"

namespace stereobench::harness {

std::string names_and_contents() {
  std::string formats;
  for (const DatasetFormat& format : dataset_formats())
    formats += fmt::format("{}{} ({})", formats.empty() ? "" : ", ", format.name, format.holds);
  return formats;
}

void say_what_was_written(const std::string& name, const DatasetFormat& format,
                          const std::filesystem::path& folder, const WrittenDataset& written) {
  const std::string place = (folder / "").string();
  if (!written.spoilt.empty())
    note(
        fmt::format("{}: {} files were missing or not as they had been written (the first: {}); they are "
                    "written again",
                    place, written.spoilt.size(), written.spoilt.front()));
  if (written.was_complete)
    fmt::print("{} is complete and is left as it is\n", place);
  else
    fmt::print("{}: {} stereo pairs with {} in {}\n", name, written.pairs, format.holds, place);
}

}  // namespace stereobench::harness
