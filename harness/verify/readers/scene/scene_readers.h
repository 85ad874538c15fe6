/// Reads folders of COLMAP's, COCO's, BOP's and Nerfstudio's layouts.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// Where COLMAP and Nerfstudio have the centre of the first pixel.
inline constexpr double kFirstPixel_px = 0.5;

/// A model of text or of bytes; those of bytes are recognised, and refused by the reader.
bool looks_like_colmap(const std::filesystem::path& folder);
/// Each picture has a pose, and points that it shows. Pictures are pairs where their folders are called left
/// and right.
/// @throws std::runtime_error, one line, for a model of bytes, or without cameras.txt and images.txt
DatasetView read_colmap_view(const std::filesystem::path& folder);

/// A list of instances in annotations/, or beside the pictures.
bool looks_like_coco(const std::filesystem::path& folder);
/// @throws std::runtime_error, one line, for a list that is no JSON, or has no pictures or annotations
DatasetView read_coco_view(const std::filesystem::path& folder);

/// SPLIT/000000/scene_camera.json.
bool looks_like_bop(const std::filesystem::path& folder);
/// Each scene of each split; those of test_left and test_right with the same number are one of pairs.
DatasetView read_bop_view(const std::filesystem::path& folder);

/// transforms.json.
bool looks_like_nerfstudio(const std::filesystem::path& folder);
/// @throws std::runtime_error, one line, for a file that is no JSON, or has no frames
DatasetView read_nerfstudio_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
