/// What decode_picture (picture_reader.h) chooses from, a file each; all throw as it does.
#pragma once

#include "renderer/pictures/picture_reader.h"

namespace stereobench::renderer {

cv::Mat decode_png(PictureBytes bytes, int longest_px);
SaidOfLevels said_by_png(PictureBytes bytes);
cv::Mat decode_jpeg(PictureBytes bytes, int longest_px);
cv::Mat decode_tiff(PictureBytes bytes, int longest_px);
/// Uncompressed, of 8 (a palette), 24 or 32 bits a pixel.
cv::Mat decode_bmp(PictureBytes bytes, int longest_px);
/// P2, P3, P5 and P6: shades or colours, in figures or in bytes.
cv::Mat decode_pnm(PictureBytes bytes, int longest_px);
/// Colours of 15 to 32 bits, palettes and shades, packed or not, from any corner.
cv::Mat decode_tga(PictureBytes bytes, int longest_px);
/// Whether a file begins as a TGA does, which has no signature there: what else it may be is asked first.
bool is_tga(PictureBytes bytes);

/// That a file ends before its picture does, or is damaged. @param library what the library of its format
/// says
[[noreturn]] void refuse_broken(const std::string& library);

/// What decoders do before they make room for a picture.
/// @throws std::runtime_error for a picture without pixels, of a longer side than `longest_px`, or with more
///   pixels than a camera's
void check_size(std::int64_t width_px, std::int64_t height_px, int longest_px);

}  // namespace stereobench::renderer
