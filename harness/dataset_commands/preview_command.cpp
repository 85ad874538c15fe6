#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/io/atomic_file.h"
#include "harness/preview/contact_sheet.h"
#include "harness/preview/film.h"
#include "harness/process/progress.h"
#include "harness/verify/readers/reader_registry.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFilmFrames = 300;  ///< half a minute

struct PreviewArguments {
  fs::path folder;
  std::string format;
  fs::path out = "contact_sheet.png";
  fs::path film;  ///< empty: none
  std::size_t frames = 6;
};

void write_result(const fs::path& file, const std::string& bytes) {
  if (file.has_parent_path()) prepare_output_folder(file.parent_path());
  write_file_atomically(file, bytes);
}

int preview(const PreviewArguments& arguments) {
  fs::path ffmpeg;
  if (!arguments.film.empty()) ffmpeg = find_ffmpeg();
  const DatasetReader& reader =
      arguments.format.empty() ? reader_of(arguments.folder) : dataset_reader(arguments.format);
  const DatasetView view = reader.read(arguments.folder);
  if (view.frames.empty())
    throw std::runtime_error(fmt::format("{}: has no pairs to show", arguments.folder.string()));
  const std::string name = fs::absolute(arguments.folder / "").parent_path().filename().string();
  const std::vector<std::size_t> shown = evenly_spaced(view.frames.size(), arguments.frames);
  const std::string title =
      fmt::format("{}: {}, {} of {} pairs", name, view.format, shown.size(), view.frames.size());
  const std::string sheet = contact_sheet(view, shown, title);
  std::string film;
  if (!arguments.film.empty()) {
    Progress progress("film " + name, 1.0);
    film = film_of(view, evenly_spaced(view.frames.size(), kMostFilmFrames), ffmpeg,
                   [&](double done) { progress.show(done); });
  }
  write_result(arguments.out, sheet);
  fmt::print("{}: {} of {} pairs in {}\n", name, shown.size(), view.frames.size(), arguments.out.string());
  if (arguments.film.empty()) return kPassed;
  write_result(arguments.film, film);
  fmt::print("{}: a film of {} pairs in {}\n", name, std::min(view.frames.size(), kMostFilmFrames),
             arguments.film.string());
  return kPassed;
}

}  // namespace

void add_preview_command(CLI::App& program, Action& action) {
  constexpr std::size_t kMostRows = 50;
  CLI::App* command = program.add_subcommand("preview", "show a data set of any format on one picture");
  auto arguments = std::make_shared<PreviewArguments>();
  command->add_option("dataset", arguments->folder, "folder of a data set")->required();
  command->add_option("-o,--out", arguments->out,
                      "the picture, a PNG file below 1 MB (default: contact_sheet.png)");
  command->add_option("--frames", arguments->frames, "how many pairs, evenly spaced (default: 6)")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, kMostRows));
  command
      ->add_option("--video", arguments->film,
                   "a film (MP4) of at most 300 pairs too, ten a second, by the program ffmpeg")
      ->type_name("FILE");
  command->add_option("--as", arguments->format, "the data set's format, where the folder does not tell")
      ->type_name("NAME");
  command->footer(
      "A row is a pair: left and right picture, disparity (or depth) and balls, as far as the data set has\n"
      "them. Pictures of linear light are shown as sRGB.\n\n"
      "Example: stereobench preview out/dataset --out out/contact_sheet.png --video out/preview.mp4");
  command->callback([arguments, &action] { action = [arguments] { return preview(*arguments); }; });
}

}  // namespace stereobench::harness
