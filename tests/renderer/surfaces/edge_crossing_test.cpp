/// The worst pixel where outlines of balls, walls, meshes and the floor cross, against pictures of five times
/// the size.
///
/// Mutation seen red here: edges mixed over the balls that hide them (up to 88 levels off where a ball covers
/// the whole pixel).

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "renderer/surfaces/mesh_surfaces.h"
#include "tests/renderer/finer.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/ray_caster.h"

namespace stereobench::renderer {
namespace {

enum class Thing { kBall, kWall, kBox, kRoundMesh };

const char* name_of(Thing thing) {
  constexpr std::array<const char*, 4> kNames = {"ball", "wall", "box", "round_mesh"};
  return kNames.at(static_cast<std::size_t>(thing));
}

/// Where three things stand beside each other without touching.
struct Place {
  double ahead_m;
  int column;  ///< -1, 0, 1 from the right
};

/// Puts a thing of some 0.15 m in a world.
void put(worlds::World& world, Thing thing, const Place& place, slam::RandomStream& random) {
  const auto apart = [&](double reach) { return test::between(random, -reach, reach); };
  const double ahead_m = place.ahead_m;
  const double left_m = 0.25 * place.column + apart(0.03), up_m = test::between(random, 0.2, 0.45);
  const Eigen::Vector3d tint(test::between(random, 0.1, 1.0), test::between(random, 0.1, 1.0),
                             test::between(random, 0.1, 1.0));
  if (thing == Thing::kBall) {
    const int colour = static_cast<int>(test::between(random, 0.0, 18.0));
    world.balls.push_back({{ahead_m, left_m, up_m}, test::between(random, 0.04, 0.09), colour});
  } else if (thing == Thing::kWall) {
    const Eigen::Vector2d middle(ahead_m, left_m), reach(apart(0.1), test::between(random, 0.03, 0.09));
    world.walls.push_back({middle - reach, middle + reach, up_m, worlds::Material::kPlain, tint});
  } else {
    worlds::MeshInstance mesh{.position_m = {ahead_m, left_m, 0.0}, .heading_rad = apart(3.0)};
    mesh.scale = {test::between(random, 0.06, 0.13), test::between(random, 0.06, 0.13), up_m};
    mesh.material = worlds::Material::kPaint;
    mesh.shape = thing == Thing::kBox ? worlds::MeshShape::kBox : worlds::MeshShape::kBall;
    mesh.tint_rgb = tint;
    world.meshes.push_back(mesh);
  }
}

vision::StereoRig rig_of_few_pixels() {
  vision::StereoRig rig = test::small_rig();
  rig.intrinsics = {.width_px = 200, .height_px = 150, .focal_px = 260.3, .cx_px = 97.7, .cy_px = 71.2};
  return rig;
}

/// How far the worst pixels are off, in levels of their worst channel.
struct Worst {
  double whole = 0.0, whole_of_ball = 0.0;  ///< of pixels all of which see one primitive
  double mixed = 0.0;                       ///< of the others, as far as a centre sees what they see
  long mixed_pixels = 0, far_off = 0;       ///< by more than eight levels
};

/// Whether all corners of a pixel see what its centre sees, and so do its finer pixels.
bool is_whole(const test::RayCaster& caster, const test::FinerImage& fine, int u, int v) {
  if (!fine.is_one_primitive(u, v, 0)) return false;
  if (fine.is_one_primitive(u, v, 1)) return true;
  const int seen = caster.look(u, v).surface;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      if (caster.look(u + x, v + y).surface != seen) return false;
  return true;
}

test::RayCaster caster_of(const worlds::World& world, const vision::StereoRig& rig) {
  std::vector<Triangle> triangles;
  const std::vector<SurfaceVertex> vertices = place_meshes(world).vertices;
  for (std::size_t i = 0; i < vertices.size(); i += 3) {
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      triangle.corners[k] = Eigen::Vector3f(vertices[i + k].position).cast<double>();
  }
  return {world, rig, triangles};
}

void add_up(const RenderedImage& image, const test::FinerImage& fine, const test::RayCaster& caster,
            Worst& worst) {
  for (int v = 1; v < image.colour.rows - 1; ++v) {
    for (int u = 1; u < image.colour.cols - 1; ++u) {
      const cv::Vec3d colour = image.colour.at<cv::Vec3b>(v, u);
      const double off = cv::norm(colour - fine.mean_colour(u, v), cv::NORM_INF);
      if (is_whole(caster, fine, u, v)) {
        double& whole = image.ball_id.at<std::uint8_t>(v, u) != 0 ? worst.whole_of_ball : worst.whole;
        const double alone = cv::norm(colour - cv::Vec3d(fine.centre_colour(u, v)), cv::NORM_INF);
        whole = std::max(whole, std::min(alone, off));
      } else if (!fine.has_sliver(u, v)) {
        worst.mixed = std::max(worst.mixed, off);
        ++worst.mixed_pixels;
        worst.far_off += off > 8.0 ? 1 : 0;
      }
    }
  }
}

struct Pairing {
  Thing front, behind;
};

void PrintTo(const Pairing& value, std::ostream* out) {
  *out << name_of(value.front) << " before " << name_of(value.behind);
}

class Crossings : public testing::TestWithParam<Pairing> {};

// The floor and its horizon are behind all of them. Seen, where nothing is made of round primitives: whole
// pixels 0.0 to 1.0 (balls) and 8.0 (pixels beside the corner of a box), mixed ones 27 to 67, 0.2 to 1.9 % of
// them by more than eight levels. A round mesh has primitives that no centre sees between a pixel and the
// mesh's outline: 100, 3 %.
TEST_P(Crossings, AreRightInTheWorstPixel) {
  const auto [front, behind] = GetParam();
  const vision::StereoRig rig = rig_of_few_pixels();
  Worst worst;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    slam::RandomStream random(seed, slam::Stream::kWorld, 10);
    worlds::World world;
    world.floor = worlds::Material::kPlain;
    world.light = {.towards_light = {-0.9, 0.3, 0.4}};
    for (const int column : {-1, 0, 1}) {
      put(world, front, {1.2, column}, random);
      put(world, behind, {1.6, column}, random);
    }
    const StereoFrame frame = Renderer(world, rig).render({});
    const auto [left, right] = test::finer_pair(world, rig, {});
    test::RayCaster caster = caster_of(world, rig);
    add_up(frame.left, left, caster, worst);
    caster.stand_at({}, vision::Side::kRight);
    add_up(frame.right, right, caster, worst);
  }
  const bool is_round = front == Thing::kRoundMesh || behind == Thing::kRoundMesh;
  RecordProperty("whole_levels", std::to_string(worst.whole));
  RecordProperty("mixed_levels", std::to_string(worst.mixed));
  RecordProperty("far_off", std::to_string(worst.far_off));
  EXPECT_LE(worst.whole, 8.5);
  EXPECT_LE(worst.whole_of_ball, 1.2);
  EXPECT_GT(worst.mixed_pixels, 3000);
  EXPECT_LE(worst.mixed, is_round ? 105.0 : 70.0);
  EXPECT_LE(worst.far_off, worst.mixed_pixels / (is_round ? 30 : 50));
}

std::vector<Pairing> all_pairings() {
  std::vector<Pairing> pairings;
  for (const Thing front : {Thing::kBall, Thing::kWall, Thing::kBox, Thing::kRoundMesh})
    for (const Thing behind : {Thing::kBall, Thing::kWall, Thing::kBox, Thing::kRoundMesh})
      pairings.push_back({front, behind});
  return pairings;
}

INSTANTIATE_TEST_SUITE_P(Things, Crossings, testing::ValuesIn(all_pairings()), [](const auto& test) {
  return fmt::format("{}_before_{}", name_of(test.param.front), name_of(test.param.behind));
});

}  // namespace
}  // namespace stereobench::renderer
