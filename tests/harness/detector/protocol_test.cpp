#include "harness/detector/protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/json/json_line.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

DetectorSetup odd_setup() {
  DetectorSetup setup;
  setup.rig = {{640, 480, 512.3456789012345, 1.0 / 3.0, 239.5}, 0.1 + 0.02, 0.3, 1e-17};
  setup.rig.right_turn_rad = {0.1 / 3.0, -0.01, 1e-9};
  setup.rig.distortion = {
      .k1 = -0.1 / 3.0, .k2 = 0.01, .p1 = 1e-3, .p2 = -2e-3, .k3 = 1e-5, .pixel_aspect = 1.1};
  setup.ball_radius_m = 0.07 / 3.0;
  setup.ball_radius_sd_m = 0.001 / 7.0;
  setup.rows_within_px = 20.0 / 3.0;
  setup.noise_sd_levels = 2.0 / 7.0;
  setup.encoding = worlds::Encoding::kGamma;
  setup.gamma = 1.9;
  return setup;
}

// Law: a program is told exactly what we know. Mutation: the encoding not read.
TEST(Protocol, SetupIsReadBackExactly) {
  const DetectorSetup setup = odd_setup();
  const DetectorSetup read = read_setup(setup_line(setup));
  EXPECT_EQ(setup_line(read), setup_line(setup));
  EXPECT_EQ(read.rig.intrinsics.cx_px, setup.rig.intrinsics.cx_px);
  EXPECT_EQ(read.rig.pitch_down_rad, setup.rig.pitch_down_rad);
  EXPECT_EQ(read.rig.right_turn_rad, setup.rig.right_turn_rad);
  EXPECT_EQ(read.rig.distortion, setup.rig.distortion);
  EXPECT_EQ(read.ball_radius_m, setup.ball_radius_m);
  EXPECT_EQ(read.ball_radius_sd_m, setup.ball_radius_sd_m);
  EXPECT_EQ(read.rows_within_px, setup.rows_within_px);
  EXPECT_EQ(read.noise_sd_levels, setup.noise_sd_levels);
  EXPECT_EQ(read.encoding, setup.encoding);
  EXPECT_EQ(read.gamma, setup.gamma);
  for (const auto encoding : {worlds::Encoding::kLinear, worlds::Encoding::kSrgb})
    EXPECT_EQ(read_setup(setup_line({.encoding = encoding})).encoding, encoding);
}

// Law: those who speak the first version need not say by how many rows a rig may be off.
TEST(Protocol, RowsAreTenWhereNothingIsSaidOfThem) {
  nlohmann::json line = nlohmann::json::parse(setup_line({}));
  line.erase("rows_within_px");
  EXPECT_EQ(read_setup(line.dump()).rows_within_px, 10.0);
}

TEST(Protocol, SetupHasThePaletteAndAVersion) {
  EXPECT_THAT(setup_line({}), HasSubstr(R"("palette_rgb":[[229,0,0],[0,229,0],)"));
  EXPECT_THAT(setup_line({}), HasSubstr(R"("version":1)"));
}

TEST(Protocol, FramesAreReadBackExactly) {
  const FrameRequest read =
      read_request(request_line({12, -5'000'000'001, "/tmp/a b/l.png", "/tmp/\"r\".png"}));
  EXPECT_EQ(read.frame, 12U);
  EXPECT_EQ(read.stamp_ns, -5'000'000'001);
  EXPECT_EQ(read.left, "/tmp/a b/l.png");
  EXPECT_EQ(read.right, "/tmp/\"r\".png");
}

TEST(Protocol, RefusesWhatItDoesNotKnow) {
  std::string other = setup_line({});
  other.replace(other.find("\"version\":1"), 11, "\"version\":2");
  EXPECT_THAT([&] { read_setup(other); }, ThrowsMessage<BadLine>(HasSubstr("version: expected 1 (got 2)")));
  EXPECT_THAT([] { read_setup("{}"); }, ThrowsMessage<BadLine>(HasSubstr("expected \"protocol\"")));
  EXPECT_THAT([] { read_setup(""); }, ThrowsMessage<BadLine>(HasSubstr("JSON")));
  EXPECT_THAT([] { read_request(R"({"frame": -1})"); }, ThrowsMessage<BadLine>(HasSubstr("frame: expected")));
}

}  // namespace
}  // namespace stereobench::harness
