#include <stdexcept>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/dataset_talk.h"
#include "harness/dataset/dataset_export.h"
#include "harness/process/interruption.h"
#include "harness/process/progress.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  fs::path dataset;
  std::vector<const DatasetFormat*> formats;
  fs::path out;
  std::shared_ptr<PictureChange> change = std::make_shared<PictureChange>();
};

int export_as(const ExportArguments& arguments) {
  for (const DatasetFormat* format : arguments.formats)
    if (is_plain(*format) && !arguments.change->changes_anything())
      throw std::runtime_error(fmt::format(
          "--as: {} is the format that is exported from; it is written with --every, --crop, --scale "
          "or --picture alone",
          format->name));
  const std::string name = fs::absolute(arguments.dataset / "").parent_path().filename().string();
  say_that_work_is_kept();
  Progress progress("export " + name, 1.0);
  const std::vector<WrittenDataset> written =
      export_dataset(arguments.dataset, arguments.formats, arguments.out, *arguments.change,
                     [&](double done) { progress.show(done); });
  for (std::size_t i = 0; i < written.size(); ++i)
    say_what_was_written(name, *arguments.formats[i],
                         folder_of(arguments.out, *arguments.formats[i], arguments.formats), written[i]);
  return kPassed;
}

}  // namespace

void add_export_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("export", "write a data set of `render` in other formats");
  auto arguments = std::make_shared<ExportArguments>();
  command
      ->add_option("dataset", arguments->dataset,
                   "folder that `stereobench render` wrote, of the format plain")
      ->required();
  command
      ->add_option_function<std::string>(
          "--as",
          [arguments](const std::string& names) { arguments->formats = parse_formats(names, "--as"); },
          "formats, comma-separated; several have a folder each: " + names_and_contents())
      ->type_name("NAME[,NAME]")
      ->required();
  command->add_option("-o,--out", arguments->out, "folder for the result")->required();
  add_picture_options(*command, arguments->change);
  command->footer(
      "The files are those that `stereobench render --format NAME` would have written, with the same\n"
      "--every, --crop, --scale and --picture. Without these, pictures are copied as they are. Formats with "
      "disparity or flow need a data set that was rendered with\n"
      "--truth disparity or --truth flow. Interrupted, it goes on where it was.\n\n"
      "Example: stereobench export out/dataset --as euroc,tum --out out/exported\n"
      "         stereobench export out/dataset --as plain --scale 1/2 --every 5 --out out/small");
  command->callback([arguments, &action] { action = [arguments] { return export_as(*arguments); }; });
}

}  // namespace stereobench::harness
