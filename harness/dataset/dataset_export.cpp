#include "harness/dataset/dataset_export.h"

#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/plain_dataset.h"
#include "harness/io/file_list.h"
#include "harness/io/text_file.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {
namespace {

/// What dataset.json says of the whole set.
struct Marker {
  nlohmann::ordered_json identity;  ///< of all formats
  CoarseBlur blur;
};

CoarseBlur blur_of(const JsonValue& json) {
  constexpr double kMost = 1e9;
  return {static_cast<long>(json.at("coarse_pairs").integer(0, std::int64_t{1} << 40)),
          json.at("most_step_px").number(0.0, kMost)};
}

/// @throws std::runtime_error where a file is not as it was rendered
Marker read_marker_of(const std::filesystem::path& folder) {
  const std::vector<std::string> changed = changed_files(folder, read_manifest(folder));
  if (!changed.empty())
    throw std::runtime_error(
        fmt::format("{}: {} files are missing or not as they were rendered (the first: {}); "
                    "render it again",
                    folder.string(), changed.size(), changed.front()));
  const std::filesystem::path file = folder / kDatasetJson;
  const std::string text = read_text(file);
  try {
    const nlohmann::json json = parse_line(text);
    const JsonValue whole(json, "");
    Marker marker = {.identity = nlohmann::ordered_json::parse(text), .blur = blur_of(whole.at(kBlur))};
    for (const char* of_one_format : {kFrames, kBlur, "truth", "truth_format"})
      marker.identity.erase(of_one_format);
    if (whole.at("stereobench").text() != STEREOBENCH_VERSION)
      marker.identity["exported_by"] = STEREOBENCH_VERSION;
    return marker;
  } catch (const BadLine& bad) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), bad.what()));
  }
}

}  // namespace

std::vector<WrittenDataset> export_dataset(const std::filesystem::path& dataset,
                                           const std::vector<const DatasetFormat*>& formats,
                                           const std::filesystem::path& out,
                                           const std::function<void(double)>& on_progress) {
  const PlainDataset plain = read_plain_dataset(dataset);
  const Marker marker = read_marker_of(dataset);
  for (const DatasetFormat* format : formats) {
    format->check(plain.drive);
    for (const TruthKind kind : needed_truth(*format)) require_exact_truth(plain, kind);
  }
  std::vector<WantedDataset> wanted;
  for (const DatasetFormat* format : formats) {
    wanted.push_back({format, folder_of(out, *format, formats), marker.identity});
    wanted.back().identity["format"] = format->name;
  }
  require_room(wanted, out);
  std::vector<DatasetOutput> outputs;
  for (const WantedDataset& one : wanted) outputs.emplace_back(one, plain.drive);
  for (std::size_t step = 0; step < plain.drive.steps.size(); ++step) {
    on_progress(static_cast<double>(step) / static_cast<double>(plain.drive.steps.size()));
    if (!plain.drive.steps[step].pictures) continue;
    PlainPair pair(plain, step);
    for (DatasetOutput& output : outputs) output.write(pair);
  }
  std::vector<WrittenDataset> written;
  for (DatasetOutput& output : outputs) {
    output.finish(plain.log, marker.blur);
    written.push_back(output.written());
  }
  return written;
}

}  // namespace stereobench::harness
