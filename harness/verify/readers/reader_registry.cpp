#include "harness/verify/readers/reader_registry.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/verify/readers/euroc_reader.h"
#include "harness/verify/readers/kitti_readers.h"
#include "harness/verify/readers/log/mrclam_reader.h"
#include "harness/verify/readers/plain_reader.h"
#include "harness/verify/readers/recording/recording_readers.h"
#include "harness/verify/readers/scene/scene_readers.h"
#include "harness/verify/readers/shards/webdataset_reader.h"
#include "harness/verify/readers/stereo_readers.h"
#include "harness/verify/readers/tum_reader.h"
#include "harness/verify/readers/vslamlab_reader.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

std::vector<std::string_view> known_formats() {
  std::vector<std::string_view> names;
  for (const DatasetReader& reader : dataset_readers()) names.push_back(reader.format);
  return names;
}

/// The row of a kind of recording.
template <const RecordingKind& kKind>
constexpr DatasetReader recording_reader() {
  return {kKind.format,
          [](const std::filesystem::path& folder) { return looks_like_recording(folder, kKind); },
          [](const std::filesystem::path& folder) { return read_recording_view(folder, kKind); }, "",
          [](const std::filesystem::path& folder) { return read_recording_log(folder, kKind); }};
}

}  // namespace

std::span<const DatasetReader> dataset_readers() {
  static constexpr std::array kReaders = {
      DatasetReader{"plain", looks_plain, read_plain_view, "is what `detect` and `slam` read as it is"},
      DatasetReader{"euroc", looks_like_euroc, read_euroc_view},
      DatasetReader{"kitti-odometry", looks_like_kitti_odometry, read_kitti_odometry_view},
      DatasetReader{"kitti-stereo-2012", looks_like_kitti_stereo_2012, read_kitti_stereo_2012_view},
      DatasetReader{"kitti-scene-flow", looks_like_kitti_scene_flow, read_kitti_scene_flow_view},
      DatasetReader{"kitti-stereo", looks_like_kitti_stereo, read_kitti_stereo_view},
      DatasetReader{"tum", looks_like_tum, read_tum_view},
      DatasetReader{"vslamlab", looks_like_vslamlab, read_vslamlab_view},
      DatasetReader{"sceneflow", looks_like_sceneflow, read_sceneflow_view},
      DatasetReader{"colmap", looks_like_colmap, read_colmap_view},
      DatasetReader{"coco", looks_like_coco, read_coco_view,
                    "says nothing of cameras; expected a layout with their lenses and places"},
      DatasetReader{"bop", looks_like_bop, read_bop_view},
      DatasetReader{"nerfstudio", looks_like_nerfstudio, read_nerfstudio_view},
      DatasetReader{"eth3d", looks_like_eth3d, read_eth3d_view},
      DatasetReader{"middlebury", looks_like_middlebury, read_middlebury_view},
      recording_reader<kRosbagKind>(),
      recording_reader<kMcapKind>(),
      DatasetReader{"webdataset", looks_like_webdataset, read_webdataset_view},
      DatasetReader{"mrclam", looks_like_mrclam, read_mrclam_view,
                    "has no pictures; `slam` reads it as it is"},
  };
  return kReaders;
}

const DatasetReader& dataset_reader(std::string_view name) {
  for (const DatasetReader& reader : dataset_readers())
    if (reader.format == name) return reader;
  throw std::runtime_error(fmt::format("--as: no format is called '{}', {}", name,
                                       worlds::advice(std::string(name), known_formats())));
}

const DatasetReader& reader_of(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: no such folder", folder.string()));
  for (const DatasetReader& reader : dataset_readers())
    if (reader.recognises(folder)) return reader;
  throw std::runtime_error(fmt::format("{}: expected a data set ({}); where it is one, say which by --as",
                                       folder.string(), fmt::join(known_formats(), ", ")));
}

}  // namespace stereobench::harness
