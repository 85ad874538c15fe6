#include "harness/io/gzip.h"

#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

#include "slam/math/random.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

std::string unpacked_bytes(const std::string& packed) {
  const TestFolder folder;
  gzFile stream = gzopen(folder.write("file.gz", packed).c_str(), "rb");
  std::string bytes(1 << 20, '\0');
  bytes.resize(static_cast<std::size_t>(gzread(stream, bytes.data(), static_cast<unsigned>(bytes.size()))));
  gzclose(stream);
  return bytes;
}

// Mutations: a bound that is too small; the packed bytes of the last member alone.
TEST(Gzip, MembersOneAfterTheOtherAreAllThatIsInThem) {
  slam::RandomStream random(1, slam::Stream::kWorld);
  std::string noise;
  for (int i = 0; i < 100'000; ++i) noise += static_cast<char>(random.bits() & 0xffU);
  const std::string text(200'000, 'x');
  EXPECT_EQ(unpacked_bytes(gzip(noise) + gzip("") + gzip(text)), noise + text);
  EXPECT_LT(gzip(text).size(), 1000U);
}

// A name or a time in it would differ from run to run: RFC 1952's flags and time.
TEST(Gzip, SaysNeitherNameNorTime) {
  EXPECT_EQ(gzip("abc").substr(0, 8), std::string("\x1f\x8b\x08\0\0\0\0\0", 8));
}

}  // namespace
}  // namespace stereobench::harness
