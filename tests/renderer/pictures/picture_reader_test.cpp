#include "renderer/pictures/picture_reader.h"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <turbojpeg.h>
#include <zlib.h>

#include "renderer/pictures/png_picture.h"
#include "tests/renderer/picture_complaint.h"
#include "tests/renderer/pictures/odd_png.h"

namespace stereobench::renderer {
namespace {

using test::complaint;
using testing::StartsWith;

using File = std::vector<std::uint8_t>;

/// Smooth shades with grain, of any type, so that all of a format's ways to pack find something.
cv::Mat random_picture(int width, int height, int type, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat small(3, 4, type), picture;
  const double most = CV_MAT_DEPTH(type) == CV_16U ? 65535.0 : 255.0;
  random.fill(small, cv::RNG::UNIFORM, 0.0, most);
  cv::resize(small, picture, {width, height}, 0.0, 0.0, cv::INTER_CUBIC);
  cv::Mat grain(height, width, type);
  random.fill(grain, cv::RNG::UNIFORM, 0.0, 0.05 * most);
  return picture + grain;
}

/// What a file holds by OpenCV's own readers, as eight bits without transparency.
cv::Mat by_opencv(const File& file) {
  cv::Mat picture = cv::imdecode(file, cv::IMREAD_UNCHANGED);
  if (picture.depth() == CV_16U) picture.convertTo(picture, CV_8U, 1.0 / 257.0);
  if (picture.channels() == 4) cv::cvtColor(picture, picture, cv::COLOR_BGRA2BGR);
  return picture;
}

File bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

struct Written {
  const char* name;
  const char* extension;
  std::vector<int> types;
  std::vector<int> options = {};
};

File file_of(const Written& how, int type, std::uint64_t seed) {
  File file;
  cv::imencode(how.extension, random_picture(37, 23, type, seed), file, how.options);
  return file;
}

void PrintTo(const Written& how, std::ostream* out) {
  *out << how.name;
}

class PictureFormat : public testing::TestWithParam<Written> {};

/// One that says how much there is of it; in figures, half of the last number is a number.
class CountedPicture : public PictureFormat {};

const Written kCounted[] = {
    {"png", ".png", {CV_8UC3, CV_8UC1, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4}},
    {"jpeg", ".jpg", {CV_8UC3, CV_8UC1}, {cv::IMWRITE_JPEG_QUALITY, 60}},
    {"progressive_jpeg", ".jpg", {CV_8UC3, CV_8UC1}, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}},
    {"tiff", ".tiff", {CV_8UC3, CV_8UC1, CV_16UC1, CV_16UC3}},
    {"plain_tiff", ".tiff", {CV_8UC3, CV_8UC1, CV_16UC1}, {cv::IMWRITE_TIFF_COMPRESSION, 1}},
    {"deflated_tiff", ".tiff", {CV_16UC1, CV_8UC3, CV_16UC3}, {cv::IMWRITE_TIFF_COMPRESSION, 8}},
    {"bmp", ".bmp", {CV_8UC3, CV_8UC1, CV_8UC4}},
    {"ppm", ".ppm", {CV_8UC3, CV_16UC3}},
    {"pgm", ".pgm", {CV_8UC1, CV_16UC1}}};
const Written kInFigures[] = {{"ppm_in_figures", ".ppm", {CV_8UC3, CV_16UC3}, {cv::IMWRITE_PXM_BINARY, 0}},
                              {"pgm_in_figures", ".pgm", {CV_8UC1}, {cv::IMWRITE_PXM_BINARY, 0}}};

// An independent reference: OpenCV's readers, level by level.
TEST_P(PictureFormat, IsReadAsOpenCvReadsIt) {
  for (const int type : GetParam().types) {
    const File file = file_of(GetParam(), type, 7);
    const cv::Mat read = decode_picture(file), expected = by_opencv(file);
    ASSERT_EQ(read.type(), CV_MAT_CN(type) == 1 ? CV_8UC1 : CV_8UC3);
    ASSERT_EQ(read.size(), cv::Size(37, 23));
    EXPECT_EQ(cv::norm(read, expected, cv::NORM_INF), 0.0) << cv::typeToString(type);
  }
}

TEST_P(CountedPicture, CutShortIsReadWholeOrRefused) {
  const int type = GetParam().types.front();
  const File whole = file_of(GetParam(), type, 8);
  const cv::Mat picture = decode_picture(whole);
  int read = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const File part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    const std::string why = complaint(part);
    EXPECT_EQ(why.find('\n'), std::string::npos);
    if (why != "no complaint") continue;
    ++read;
    EXPECT_EQ(cv::norm(decode_picture(part), picture, cv::NORM_INF), 0.0) << size << " bytes";
  }
  EXPECT_LE(read, 1 + static_cast<int>(whole.size() / 4)) << "what stands behind the pixels may be missing";
}

INSTANTIATE_TEST_SUITE_P(Counted, PictureFormat, testing::ValuesIn(kCounted));
INSTANTIATE_TEST_SUITE_P(InFigures, PictureFormat, testing::ValuesIn(kInFigures));
INSTANTIATE_TEST_SUITE_P(All, CountedPicture, testing::ValuesIn(kCounted));

// Cameras leave stray bytes between a JPEG's parts. Mutation: what follows them may be missing.
TEST(PictureReader, PassesOverStrayBytesOfAWholeJpeg) {
  File file = file_of(kCounted[2], CV_8UC3, 3);
  const cv::Mat picture = decode_picture(file);
  constexpr std::array<std::uint8_t, 2> kScan = {0xFF, 0xDA};
  file.insert(std::find_end(file.begin(), file.end(), kScan.begin(), kScan.end()), 5, 0);
  EXPECT_EQ(cv::norm(decode_picture(file), picture, cv::NORM_INF), 0.0);
  file.resize(file.size() - 20);
  EXPECT_THAT(complaint(file), StartsWith("is no whole picture: "));
}

// Palettes, few bits, interlacing, one colour that is transparent: what OpenCV does not write.
TEST(PictureReader, ReadsEveryKindOfPng) {
  for (const test::OddPng& kind : test::every_png()) {
    const File file = test::odd_png(kind, 19, 11);
    const cv::Mat read = decode_picture(file);
    cv::Mat expected = by_opencv(file);
    if (read.channels() == 1) cv::extractChannel(expected, expected, 0);
    ASSERT_EQ(read.size(), cv::Size(19, 11));
    EXPECT_EQ(read.channels(), (kind.colour & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1);
    EXPECT_EQ(cv::norm(read, expected, cv::NORM_INF), 0.0) << kind.colour << ": " << kind.bits << " bits";
  }
}

TEST(PictureReader, ScalesWhatIsNotOf255) {
  const cv::Mat read = decode_picture(bytes_of("P3 # a comment\n2 1\n#another\n 15 15 0 5\n1 2 15"));
  ASSERT_EQ(read.size(), cv::Size(2, 1));
  EXPECT_EQ(read.at<cv::Vec3b>(0, 0), cv::Vec3b(85, 0, 255));
  EXPECT_EQ(read.at<cv::Vec3b>(0, 1), cv::Vec3b(255, 34, 17));
}

/// A number of a file's, of two or four bytes.
void put(File& file, std::size_t at, std::uint32_t value, std::size_t size, bool highest_first) {
  for (std::size_t i = 0; i < size; ++i)
    file[at + (highest_first ? size - 1 - i : i)] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// A number that a TIFF's list of tags gives.
void put_tag(File& tiff, std::uint8_t tag, std::uint32_t value) {
  const std::size_t list = tiff[4] + 256U * tiff[5] + 65536U * tiff[6];
  for (std::size_t at = list + 2; at < list + 2 + 12U * tiff[list]; at += 12)
    if (tiff[at] == tag && tiff[at + 1] == 1) put(tiff, at + 8, value, 2, false);
}

constexpr std::uint32_t kClaimed_px = 16000;  // 768 MB, if anybody believed it

/// Small files of each kind that claim to be large.
std::vector<File> boasters() {
  const cv::Mat small(4, 4, CV_8UC3, cv::Scalar(1, 2, 3));
  File png = encode_png(small), jpeg, tiff, bmp;
  put(png, 16, kClaimed_px, 4, true);
  put(png, 20, kClaimed_px, 4, true);
  put(png, 29, static_cast<std::uint32_t>(crc32(0, &png[12], 17)), 4, true);
  cv::imencode(".jpg", small, jpeg);
  constexpr std::array<std::uint8_t, 2> kFrame = {0xFF, 0xC0};
  const auto frame = std::search(jpeg.begin(), jpeg.end(), kFrame.begin(), kFrame.end()) - jpeg.begin();
  put(jpeg, static_cast<std::size_t>(frame) + 5, kClaimed_px, 2, true);
  put(jpeg, static_cast<std::size_t>(frame) + 7, kClaimed_px, 2, true);
  cv::imencode(".tiff", small, tiff);
  put_tag(tiff, 0, kClaimed_px);
  put_tag(tiff, 1, kClaimed_px);
  cv::imencode(".bmp", small, bmp);
  put(bmp, 18, kClaimed_px, 4, false);
  put(bmp, 22, kClaimed_px, 4, false);
  return {png, jpeg, tiff, bmp, bytes_of("P6 16000 16000 255\nabc"), bytes_of("P2 16000 16000 255 1 2")};
}

// Mutation: sizes looked at once pictures are decoded, which says that they are cut short.
TEST(PictureReader, RefusesWhatIsTooLargeByWhatItsHeaderClaims) {
  for (const File& file : boasters()) {
    EXPECT_EQ(complaint(file, 15999), "is 16000 x 16000, more than 15999 pixels");
    EXPECT_THAT(complaint(file, 4096), StartsWith("is 16000 x 16000, more than 4096"));
  }
  const File fits = encode_png(cv::Mat(3, 9, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(complaint(fits, 9), "no complaint");
  EXPECT_EQ(complaint(fits, 8), "is 9 x 3, more than 8 pixels");
}

File four_printing_colours() {
  const cv::Mat cmyk(8, 8, CV_8UC4, cv::Scalar(10, 20, 30, 40));
  const std::unique_ptr<void, int (*)(tjhandle)> jpeg(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  tjCompress2(jpeg.get(), cmyk.data, 8, 0, 8, TJPF_CMYK, &bytes, &size, TJSAMP_444, 90, 0);
  File file(bytes, bytes + size);
  tjFree(bytes);
  return file;
}

TEST(PictureReader, SaysInOneLineWhatIsWrong) {
  File huge_png = encode_png(cv::Mat(1, 1, CV_8UC1, cv::Scalar(0)));
  huge_png[17] = 15;  // the second byte of the width: 983,041 pixels
  EXPECT_THAT(complaint(huge_png), StartsWith("is no whole picture: ")) << "its checksum";
  EXPECT_EQ(complaint({}), "is empty");
  EXPECT_EQ(complaint(bytes_of("hello")), "is no picture that can be read (PNG, JPEG, TIFF, BMP, PNM, TGA)");
  EXPECT_EQ(complaint(bytes_of("P6 60000 60000 255\n")),
            "is 60000 x 60000 pixels, more than 268435456 in all");
  EXPECT_EQ(complaint(bytes_of("P5 3 3 255\n12345678")), "is no whole picture: it is cut short");
  EXPECT_EQ(complaint(bytes_of("P5 0 3 255\n")), "is no whole picture: it has no pixels");
  EXPECT_EQ(complaint(bytes_of("P2 1 1 0\n1")),
            "is no whole picture: its largest number is not between 1 and 65535");
  EXPECT_EQ(complaint(bytes_of("P2 1 1 255\nx")), "is no whole picture: a number is missing");
  EXPECT_EQ(complaint(bytes_of("P2 1 99999999999 255\n")),
            "is no whole picture: it has a number without end");
  EXPECT_EQ(complaint(four_printing_colours()),
            "is a picture in four printing colours, which cannot be read");
}

/// A BMP with one of its header's numbers changed.
std::string bmp_with(std::size_t at, std::uint32_t value) {
  File file;
  cv::imencode(".bmp", cv::Mat(4, 4, CV_8UC1, cv::Scalar(9)), file);
  for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  return complaint(file);
}

TEST(PictureReader, TakesNoBmpAtItsWord) {
  EXPECT_EQ(bmp_with(18, 4), "no complaint");
  EXPECT_EQ(bmp_with(22, 0xFFFFFFFC), "no complaint") << "from top to bottom";
  EXPECT_EQ(bmp_with(22, 0x80000000), "is 4 x 2147483648 pixels, more than 268435456 in all");
  EXPECT_EQ(bmp_with(18, 0x80000000), "is no whole picture: it has no pixels");
  EXPECT_EQ(bmp_with(10, 0xFFFFFFFF), "is no whole picture: it is cut short");
  EXPECT_EQ(bmp_with(14, 0xFFFFFFFF), "is no whole picture: it is cut short");
  EXPECT_EQ(bmp_with(46, 257), "is no whole picture: its palette has no end");
  EXPECT_EQ(bmp_with(30, 1), "is a packed BMP, which cannot be read");
}

// Mutations: blue first; the lower byte of 16 bits first; differences to the pixel's own channels before.
TEST(Png, IsReadByOpenCvAsItWasWritten) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4})
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 40), cv::Size(40, 1), cv::Size(101, 67)}) {
      const cv::Mat noise = random_picture(size.width, size.height, type, 9),
                    flat = cv::Mat::ones(size, type);
      for (const cv::Mat& picture : {noise, flat})
        EXPECT_EQ(cv::norm(cv::imdecode(encode_png(picture), cv::IMREAD_UNCHANGED), picture, cv::NORM_INF),
                  0.0)
            << cv::typeToString(type) << size;
    }
  const cv::Mat part = random_picture(101, 67, CV_8UC3, 10)(cv::Rect(5, 6, 20, 30));
  EXPECT_EQ(encode_png(part), encode_png(part.clone())) << "rows that do not follow each other";
}

// Noise cannot be packed. Mutation: it is all the same, and longer than it was.
TEST(Png, IsNeverMuchLargerThanItsPixels) {
  const cv::Mat noise = random_picture(301, 200, CV_16UC3, 11);
  EXPECT_LT(static_cast<double>(encode_png(noise).size()), 1.01 * 301 * 200 * 6);
  EXPECT_LT(encode_png(cv::Mat::zeros(200, 301, CV_16UC3)).size(), 3000U);
}

// Its bytes are those of the pixels, a filter's byte for each row, and less than a hundredth of headers.
// Mutation: packed all the same.
TEST(Png, IsStoredUnpackedAndReadByOpenCv) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3}) {
    const cv::Mat picture = cv::Mat::ones(101, 167, type);
    const std::vector<std::uint8_t> bytes = encode_png(picture, PngPacking::kStored);
    EXPECT_EQ(cv::norm(cv::imdecode(bytes, cv::IMREAD_UNCHANGED), picture, cv::NORM_INF), 0.0);
    const auto pixels = static_cast<double>(picture.total() * picture.elemSize());
    EXPECT_GT(static_cast<double>(bytes.size()), pixels) << cv::typeToString(type);
    EXPECT_LT(static_cast<double>(bytes.size()), 1.02 * pixels) << cv::typeToString(type);
  }
}

TEST(Png, RefusesToHoldWhatIsNoPicture) {
  EXPECT_THROW(encode_png(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(encode_png(cv::Mat(2, 2, CV_32FC1)), std::invalid_argument);
  EXPECT_THROW(encode_png(cv::Mat(2, 2, CV_8UC2)), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::renderer
