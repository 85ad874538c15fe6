/// What is changed of a drive's pictures when they are written: fewer pairs, a part of the picture, fewer
/// pixels, another kind. Everything that goes with a picture (calibration, truth) is changed with it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "harness/dataset/dataset_drive.h"
#include "harness/dataset/pictures/picture_kind.h"

namespace stereobench::harness {

/// The defaults change nothing. Pairs are left out first, then pictures are cut, then scaled, and what is
/// left is written in its kind.
struct PictureChange {
  std::size_t every = 1;         ///< each so manieth pair of those that there are, from the first one on
  std::optional<cv::Rect> crop;  ///< px of the whole picture
  int divide = 1;                ///< a pixel is the mean of divide x divide pixels
  PictureKind kind = PictureKind::kColour;

  /// Whether a picture's pixels, or where they look, are others than the camera's.
  bool changes_pictures() const { return crop || divide > 1 || kind != PictureKind::kColour; }
  bool changes_anything() const { return every > 1 || changes_pictures(); }
};

/// Reads "10". @throws std::runtime_error, one line that begins with "--every: "
std::size_t parse_every(std::string_view text);

/// Reads "X,Y,W,H". @throws std::runtime_error, one line that begins with "--crop: "
cv::Rect parse_crop(std::string_view text);

/// Reads "1/N". @return N @throws std::runtime_error, one line that begins with "--scale: "
int parse_scale(std::string_view text);

/// The key of dataset.json that says what was changed; it is not there where nothing was.
inline constexpr const char* kPictures = "pictures";

/// What differs from the defaults: {"every": 10, "crop": [0, 0, 640, 480], "scale": "1/2", "kind": "grey"}.
nlohmann::ordered_json change_json(const PictureChange& change);

/// The options of `render` that ask for what change_json says: {{"every", "10"}, {"crop", "0,0,640,480"},
/// ...}.
std::vector<std::pair<std::string, std::string>> change_options(const nlohmann::ordered_json& json);

/// The cameras of changed pictures. A cut moves the principal point. A scaled pixel c covers the pixels whose
/// centres are around N (c + 0.5) - 0.5: so are cx and cy scaled, and the focal length is divided.
vision::StereoRig changed(vision::StereoRig rig, const PictureChange& change);

/// The drive of changed pictures: rigs, encoding and kind of picture, and steps without pictures where those
/// are left out.
/// @throws std::runtime_error, one line, where the cut reaches out of the picture, a side is no multiple of
///   the divisor, or the drive has no truth for what is asked: rows of a rolling shutter that are cut or
///   scaled; flow of a late right camera that is scaled
DatasetDrive changed(DatasetDrive drive, const PictureChange& change);

}  // namespace stereobench::harness
