/// Pictures that must not change: their bytes, as hashes, in goldens.txt. What is built with `dev` and with
/// `release` is held to the same ones, and so is what will be built next year.

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/backend.h"
#include "tests/renderer/frames.h"

namespace stereobench::renderer {
namespace {

constexpr const char* kFile = STEREOBENCH_SOURCE_DIR "/tests/renderer/goldens.txt";
constexpr int kGoldenRooms = 4;

struct Golden {
  std::string fingerprint;
  std::string rooms;  ///< hashes, with a space before each
};

/// A line for each fingerprint and one after it for its rooms; those that begin with # say something else.
std::vector<Golden> read_goldens() {
  std::ifstream file(kFile);
  std::vector<Golden> goldens;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    goldens.push_back({line, {}});
    std::getline(file, goldens.back().rooms);
  }
  return goldens;
}

/// A fingerprint in parts: the version, the rasteriser, and the frame. The width of vectors has no part in
/// pixels.
struct Parts {
  std::string rasteriser, frame;
};

Parts parts_of(const std::string& fingerprint) {
  const std::size_t width = fingerprint.rfind(", ", fingerprint.rfind(" bits)"));
  return {fingerprint.substr(0, width), fingerprint.substr(fingerprint.rfind(", frame "))};
}

/// What goldens.txt should say of this machine.
Golden golden_of_this_machine() {
  Golden golden{fingerprint(backend_info(Backend::kSoftware), render_test_frame(Backend::kSoftware)), {}};
  for (std::uint64_t room = 0; room < kGoldenRooms; ++room)
    golden.rooms += fmt::format(" {:016x}", test::hash_of(test::room_frame(room, Backend::kSoftware)));
  return golden;
}

// Where a rasteriser has goldens, a fingerprint that none of them has is a change as well: it is no way past
// this test. Mutations: plaster or a texture's blue brighter by a thousandth; edges that are smoothed in
// other places; a near plane elsewhere.
TEST(Golden, PicturesHaveTheBytesThatTheyHad) {
  const Golden now = golden_of_this_machine();
  const Parts parts = parts_of(now.fingerprint);
  const std::string lines = fmt::format("{}\n{}\n", now.fingerprint, now.rooms);
  bool is_known = false;
  for (const Golden& golden : read_goldens()) {
    const Parts its = parts_of(golden.fingerprint);
    is_known = is_known || its.rasteriser == parts.rasteriser;
    if (its.rasteriser != parts.rasteriser || its.frame != parts.frame) continue;
    EXPECT_EQ(now.rooms, golden.rooms) << "other pixels than before; if they are meant, write\n" << lines;
    return;
  }
  if (!is_known) GTEST_SKIP() << "no goldens of this rasteriser; write\n" << lines;
  ADD_FAILURE() << "other pixels than before; if they are meant, write\n" << lines;
}

}  // namespace
}  // namespace stereobench::renderer
