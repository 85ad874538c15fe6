/// The back ends side by side: what they call themselves, which one is the default, and that the two in
/// software give the same bytes, also when both live in one process, where two copies of Mesa share libglapi
/// and LLVM.

#include "renderer/backend.h"

#include <cstdlib>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/gl/context.h"
#include "renderer/renderer.h"
#include "tests/renderer/frames.h"
#include "tests/renderer/in_software.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer {
namespace {

using test::same;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

class InSoftware : public test::EachInSoftware {};
class Egl : public test::BothInSoftware {};

/// A rasteriser that is not llvmpipe comes through OSMesa alone: EGL's is asked what it is.
class OtherRasteriser : public test::OnMachinesWith {
 protected:
  void SetUp() override { need(Backend::kOsmesa); }
};

TEST_P(InSoftware, SaysWhatItIsAndRendersItsTestFrame) {
  const BackendInfo info = backend_info(GetParam());
  EXPECT_THAT(info.gl_version, HasSubstr("Mesa"));
  EXPECT_THAT(info.gl_renderer, StartsWith("llvmpipe"));
  EXPECT_FALSE(info.gl_vendor.empty());
  EXPECT_EQ(render_test_frame(GetParam()).complaint, "");
}

TEST_P(InSoftware, RefusesVectorsThatCrashTheRasteriser) {
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "512", 1);
  EXPECT_THAT([] { backend_info(GetParam()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("LP_NATIVE_VECTOR_WIDTH=512")));
  ::unsetenv("LP_NATIVE_VECTOR_WIDTH");
  EXPECT_NO_THROW(backend_info(GetParam()));
}

// Mutation: destructors that do not leave, which crashes the next context.
TEST_P(InSoftware, NewContextsGiveTheSameBytes) {
  const StereoFrame frame = test::room_frame(1, GetParam());
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(same(frame, test::room_frame(1, GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Backends, InSoftware, test::kInSoftware);

TEST_F(Egl, GivesTheBytesOfOsmesa) {
  for (std::uint64_t room = 0; room < 8; ++room) {
    EXPECT_TRUE(same(test::room_frame(room, Backend::kEgl), test::room_frame(room, Backend::kOsmesa)))
        << room;
  }
}

// Mutation: make_current that does not unbind the context before: the two libraries then draw into each
// other's pictures.
TEST_F(Egl, LivesBesideOsmesa) {
  const worlds::World world = test::random_room(2);
  const slam::Pose pose = test::random_pose(2);
  const StereoFrame expected = Renderer(world, test::small_rig()).render(pose);
  std::optional<Renderer> osmesa(std::in_place, world, test::small_rig(), Backend::kOsmesa);
  std::optional<Renderer> egl(std::in_place, world, test::small_rig(), Backend::kEgl);
  Renderer other_egl(test::random_room(3), test::small_rig(), Backend::kEgl);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(same(expected, osmesa->render(pose)));
    EXPECT_TRUE(same(expected, egl->render(pose)));
    EXPECT_FALSE(same(expected, other_egl.render(pose)));
  }
  osmesa.reset();
  EXPECT_TRUE(same(expected, egl->render(pose))) << "after osmesa's end";
  osmesa.emplace(world, test::small_rig(), Backend::kOsmesa);
  egl.reset();
  EXPECT_TRUE(same(expected, osmesa->render(pose))) << "after egl's end";
}

/// OpenGL leaves rounding, and which pixels the edge of a triangle covers, to whoever implements it; all else
/// is the same everywhere.
void expect_alike(const StereoFrame& a, const StereoFrame& b, double depth_share = 1e-5) {
  const test::Difference difference = test::difference(a, b, depth_share);
  const double pixels = 2.0 * static_cast<double>(a.left.ball_id.total());
  EXPECT_LE(difference.ids, 1e-5 * pixels);
  EXPECT_LE(difference.colours, 1e-4 * pixels);
  EXPECT_LE(difference.depths, 1e-5 * pixels);
}

// Mesa's other rasteriser interprets shaders and has its own way with triangles, blending and depth. It
// claims OpenGL 3.3 only, but can what is used here.
TEST_F(OtherRasteriser, SeesWhatLlvmpipeSees) {
  const auto frames = test::frames_of_process(
      "GALLIUM_DRIVER=softpipe MESA_GL_VERSION_OVERRIDE=4.5 MESA_GLSL_VERSION_OVERRIDE=450", Backend::kOsmesa,
      2);
  for (std::uint64_t room = 0; room < frames.size(); ++room) {
    EXPECT_FALSE(same(frames[room], test::room_frame(room, Backend::kOsmesa))) << "not another rasteriser";
    expect_alike(frames[room], test::room_frame(room, Backend::kOsmesa));
  }
}

// A card rounds depths as it likes: on an NVIDIA H200 those of planes were off by 8e-5 of themselves at most,
// half a millimetre at 6 m, those of balls by nothing.
TEST(GraphicsCard, SeesWhatLlvmpipeSees) {
  constexpr double kDepthShare = 1e-4;
  try {
    backend_info(Backend::kEglGpu);
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  EXPECT_EQ(render_test_frame(Backend::kEglGpu).complaint, "");
  for (std::uint64_t room = 0; room < 8; ++room) {
    expect_alike(test::room_frame(room, Backend::kEglGpu), test::room_frame(room, Backend::kSoftware),
                 kDepthShare);
  }
}

// Property: equal pixels, equal fingerprints; so the back end's name has no part in it.
TEST_F(Egl, HasTheFingerprintOfOsmesa) {
  const auto fingerprint_of = [](Backend backend) {
    return fingerprint(backend_info(backend), render_test_frame(backend));
  };
  EXPECT_EQ(fingerprint_of(Backend::kEgl), fingerprint_of(Backend::kOsmesa));
}

// Mutations: leaving out the version, the rasteriser, or the frame.
TEST(Fingerprint, ChangesWithEachOfItsParts) {
  const BackendInfo info{"4.5 Mesa 22.3.6", "llvmpipe (256 bits)", "Mesa"};
  const std::string usual = fingerprint(info, {"", 1});
  EXPECT_EQ(usual, "4.5 Mesa 22.3.6, llvmpipe (256 bits), frame 0000000000000001");
  EXPECT_NE(usual, fingerprint({"4.5 Mesa 22.3.7", info.gl_renderer, info.gl_vendor}, {"", 1}));
  EXPECT_NE(usual, fingerprint({info.gl_version, "llvmpipe (128 bits)", info.gl_vendor}, {"", 1}));
  EXPECT_NE(usual, fingerprint(info, {"", 2}));
}

// Red, here or without_osmesa, where the default is egl, or osmesa, on every machine, and where it is always
// called osmesa.
TEST(Software, IsOsmesaWhereItsLibraryIsAndEglElse) {
  const Backend expected = test::has_library(Backend::kOsmesa) ? Backend::kOsmesa : Backend::kEgl;
  EXPECT_EQ(drawn_by(Backend::kSoftware), expected);
  EXPECT_STREQ(name_of(Backend::kSoftware), name_of(expected));
  EXPECT_TRUE(same(test::room_frame(1, Backend::kSoftware), test::room_frame(1, expected)));
  for (const Backend backend : kBackends) EXPECT_EQ(drawn_by(backend), backend);
}

TEST(BackendName, IsReadBackAndAnUnknownOneIsRefused) {
  for (const Backend backend : kBackends) EXPECT_EQ(backend_named(name_of(backend)), backend);
  for (const char* name : {"", "OSMesa", "egl_gpu", "glx"}) {
    EXPECT_THAT([&] { backend_named(name); },
                ThrowsMessage<std::runtime_error>(HasSubstr("osmesa, egl, egl-gpu")))
        << name;
  }
}

}  // namespace
}  // namespace stereobench::renderer
