/// What a context keeps of the compiler that it has loaded.

#include "renderer/gl/idle_code.h"

#include <cctype>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "renderer/gl/context.h"
#include "tests/renderer/frames.h"

namespace stereobench::renderer {
namespace {

/// The compiler's code that is in this process, as the kernel counts it.
double compiler_mb() {
  std::ifstream maps("/proc/self/smaps");
  bool is_counted = false;
  double kib = 0.0;
  for (std::string line; std::getline(maps, line);) {
    if (std::isxdigit(static_cast<unsigned char>(line.front())) != 0 && line.find('-') != std::string::npos &&
        line.find('-') < line.find(' '))
      is_counted = line.find(" r-xp ") != std::string::npos && line.find(kCompiler) != std::string::npos;
    else if (is_counted && line.starts_with("Rss:"))
      kib += std::stod(line.substr(4));
  }
  return 1024.0 * kib / 1e6;
}

// LLVM calls all over itself when it is loaded, and not again: 36 MB. Mutation: contexts that do not release.
TEST(IdleCode, IsNotKeptByAContext) {
  const auto context = make_context(Backend::kSoftware);
  EXPECT_LT(compiler_mb(), 2.0);
}

// Mutation: renderers that do not release.
TEST(IdleCode, IsNotKeptOnceAPairIsDrawn) {
  const StereoFrame frame = test::room_frame(1, Backend::kSoftware);
  EXPECT_LT(compiler_mb(), 2.0);
  EXPECT_TRUE(test::same(frame, test::room_frame(1, Backend::kSoftware))) << "it is called again";
}

TEST(IdleCode, IsAllThatLibrariesOfANameHave) {
  const auto context = make_context(Backend::kSoftware);
  EXPECT_GT(release_code(kCompiler), std::size_t{10} << 20U);
  EXPECT_LT(compiler_mb(), 0.1);
}

TEST(IdleCode, OfALibraryThatIsNotThereIsNone) {
  EXPECT_EQ(release_code("libnobodyhasthis"), 0U);
}

}  // namespace
}  // namespace stereobench::renderer
