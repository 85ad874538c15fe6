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

void add_picture_options(CLI::App& command, const std::shared_ptr<PictureChange>& change) {
  const auto add = [&](const char* name, const char* form, const char* says, const auto& read) {
    command.add_option_function<std::string>(name, read, says)->type_name(form);
  };
  add("--every", "K",
      "each K-th pair of those that there are, from the first one on; their files are the same",
      [change](const std::string& text) { change->every = parse_every(text); });
  add("--crop", "X,Y,W,H", "the part of the pictures that is kept, px; the principal point moves with it",
      [change](const std::string& text) { change->crop = parse_crop(text); });
  add("--scale", "1/N", "a pixel is the mean of N x N pixels; after --crop",
      [change](const std::string& text) { change->divide = parse_scale(text); });
  add("--picture", "KIND",
      "what pictures hold: colour (as stored), grey (8 bits), bayer-rggb (8 bits) or linear16 (16 bits, "
      "before "
      "encoding and rounding; of render alone)",
      [change](const std::string& text) { change->kind = parse_picture_kind(text); });
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
