#include "harness/io/float_picture.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "harness/io/picture_file.h"
#include "renderer/pictures/tiff_memory.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

cv::Mat some_floats(int type) {
  cv::Mat picture(5, 7, type);
  cv::RNG(3).fill(picture, cv::RNG::UNIFORM, -1e3, 1e3);
  picture.ptr<float>(1)[2] = std::numeric_limits<float>::infinity();
  return picture;
}

bool are_same(const cv::Mat& one, const cv::Mat& other) {
  return one.type() == other.type() && one.size() == other.size() &&
         std::memcmp(one.data, other.data, one.total() * one.elemSize()) == 0;
}

// Laws: what is written is read, and what OpenCV writes. Mutations: rows not turned over; red first.
TEST(FloatPicture, IsReadAsItWasWritten) {
  const TestFolder folder;
  for (const int type : {CV_32FC1, CV_32FC3}) {
    const cv::Mat picture = some_floats(type);
    EXPECT_TRUE(are_same(read_float_picture(folder.write("a.pfm", encoded(".pfm", picture))), picture));
    cv::imwrite((folder.path() / "b.pfm").string(), picture);
    EXPECT_TRUE(are_same(read_float_picture(folder.path() / "b.pfm"), picture));
  }
}

/// A column of luminances and colours of which four rows share one: libtiff makes a row of six numbers.
std::string column_of_shared_colours() {
  renderer::TiffOutput output;
  renderer::OpenTiff tiff = renderer::open_tiff(output);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, 1U);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, 4U);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 3);
  TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_YCBCR);
  TIFFSetField(tiff.get(), TIFFTAG_YCBCRSUBSAMPLING, 4, 1);
  TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, 4U);
  std::array<float, 24> numbers = {};
  TIFFWriteEncodedStrip(tiff.get(), 0, numbers.data(), sizeof(numbers));
  tiff.reset();
  return output.bytes;
}

// Rows that are longer than the picture's would be written beyond its end. Mutation: no look at their length.
TEST(FloatPicture, OfTiffHasRowsOfItsPixels) {
  const TestFolder folder;
  const auto file = folder.write("a.tiff", column_of_shared_colours());
  EXPECT_THAT([&] { read_float_picture(file); },
              ThrowsMessage<std::runtime_error>(HasSubstr("expected floats of 32 bits, 1 or 3 channels")));
}

// Laws: every bit is kept, numbers that are none too; OpenCV reads what is written, and what OpenCV writes
// (another compression, with a predictor) is read. Mutations: red last in the file; the last strip of fewer
// rows left out.
TEST(FloatPicture, OfTiffIsReadAsItWasWritten) {
  const TestFolder folder;
  for (const int type : {CV_32FC1, CV_32FC3}) {
    cv::Mat picture(70, 9, type);
    cv::RNG(5).fill(picture, cv::RNG::UNIFORM, -1e3, 1e3);
    picture.ptr<float>(1)[2] = std::numeric_limits<float>::infinity();
    picture.ptr<float>(3)[1] = -0.0F;
    const auto file = folder.write("a.tiff", encoded(".tiff", picture));
    EXPECT_TRUE(are_same(read_float_picture(file), picture));
    EXPECT_TRUE(are_same(cv::imread(file.string(), cv::IMREAD_UNCHANGED), picture));
    constexpr int kLzw = 5;
    cv::imwrite((folder.path() / "b.tiff").string(), picture, {cv::IMWRITE_TIFF_COMPRESSION, kLzw});
    EXPECT_TRUE(are_same(read_float_picture(folder.path() / "b.tiff"), picture));
  }
}

// A part of a picture, whose rows do not follow each other in memory.
TEST(FloatPicture, OfTiffMayBeAPartOfAnother) {
  const TestFolder folder;
  const cv::Mat part = some_floats(CV_32FC1)(cv::Rect(1, 1, 3, 2));
  EXPECT_TRUE(are_same(read_float_picture(folder.write("a.tiff", encoded(".tiff", part))), part.clone()));
}

// Law: a file cut short anywhere is refused in one line with its name, or read whole.
TEST(FloatPicture, OfTiffIsRefusedWhereItIsCutShort) {
  const TestFolder folder;
  const cv::Mat picture = some_floats(CV_32FC3);
  const std::string whole = encoded(".tiff", picture);
  int refused = 0;
  for (std::size_t size = 4; size < whole.size(); size += 7) {
    const auto file = folder.write("cut.tiff", whole.substr(0, size));
    try {
      EXPECT_TRUE(are_same(read_float_picture(file), picture)) << size;
    } catch (const std::runtime_error& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr("cut.tiff: "));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(refused, 10);
}

// Mutation: the result of reading a row not looked at.
TEST(FloatPicture, OfTiffIsRefusedWhereItsRowsAreDamaged) {
  const TestFolder folder;
  std::string bytes = encoded(".tiff", some_floats(CV_32FC1));
  const std::size_t frame = bytes.find("\x28\xb5\x2f\xfd");  // where Zstandard's bytes begin
  ASSERT_NE(frame, std::string::npos);
  bytes[frame] = 'x';
  EXPECT_THAT([&] { read_float_picture(folder.write("a.tiff", bytes)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a.tiff: ")));
}

TEST(FloatPicture, OfTiffIsRefusedWhereItHoldsNoFloats) {
  const TestFolder folder;
  cv::imwrite((folder.path() / "a.tiff").string(), cv::Mat(4, 4, CV_8UC1, cv::Scalar(3)));
  EXPECT_THAT([&] { read_float_picture(folder.path() / "a.tiff"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("expected floats of 32 bits")));
}

// Mutation: the sign of the scale ignored.
TEST(FloatPicture, IsReadInEitherByteOrder) {
  const TestFolder folder;
  const auto file =
      folder.write("a.pfm", std::string("Pf\n2 1\n1.0\n") + std::string("\x3f\x80\0\0\x40\0\0\0", 8));
  EXPECT_TRUE(are_same(read_float_picture(file), (cv::Mat_<float>(1, 2) << 1.0F, 2.0F)));
}

// Mutation: each line of the checks left out.
TEST(FloatPicture, RefusesWhatIsNone) {
  const TestFolder folder;
  const auto complains = [&](const std::string& bytes, const char* complaint) {
    EXPECT_THAT([&] { read_float_picture(folder.write("a.pfm", bytes)); },
                ThrowsMessage<std::runtime_error>(HasSubstr(complaint)))
        << bytes;
  };
  complains("", "is neither a portable float map (PFM) nor a TIFF file");
  complains("P6\n1 1\n255\nabc", "is neither a portable float map (PFM) nor a TIFF file");
  complains("Pf\n1 1\n0\n1234", "is neither a portable float map (PFM) nor a TIFF file");
  complains("Pf\n0 1\n-1\n", "has no size that a picture may have");
  complains("Pf\n1 99999\n-1\n", "has no size that a picture may have");
  complains("Pf\n1 1\n-1\n123", "is cut short, or longer than it says");
  complains("Pf\n1 1\n-1\n12345", "is cut short, or longer than it says");
}

}  // namespace
}  // namespace stereobench::harness
