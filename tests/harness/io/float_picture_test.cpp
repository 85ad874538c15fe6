#include "harness/io/float_picture.h"

#include <bit>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "harness/io/picture_file.h"
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
  complains("", "is no portable float map (PFM)");
  complains("P6\n1 1\n255\nabc", "is no portable float map (PFM)");
  complains("Pf\n1 1\n0\n1234", "is no portable float map (PFM)");
  complains("Pf\n0 1\n-1\n", "has no size that a picture may have");
  complains("Pf\n1 99999\n-1\n", "has no size that a picture may have");
  complains("Pf\n1 1\n-1\n123", "is cut short, or longer than it says");
  complains("Pf\n1 1\n-1\n12345", "is cut short, or longer than it says");
}

}  // namespace
}  // namespace stereobench::harness
