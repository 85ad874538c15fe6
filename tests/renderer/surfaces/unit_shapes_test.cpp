/// Shapes without a file, and colours that are not the material's own.
#include "renderer/surfaces/unit_shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/ray_caster.h"
#include "worlds/generate/paint.h"

namespace stereobench::renderer {
namespace {

using worlds::MeshShape;

// A closed surface that faces outwards has its volume, and no area in sum. Meant to catch: two corners
// exchanged.
TEST(UnitShapes, AreClosedAndStandOnTheFloor) {
  for (const auto& [shape, volume, most_off] :
       {std::tuple{MeshShape::kBox, 1.0, 1e-12}, {MeshShape::kBall, M_PI / 6.0, 0.02}}) {
    double found = 0.0;
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    Eigen::AlignedBox3d box;
    for (const Triangle& t : unit_shape(shape)) {
      const Eigen::Vector3d face = (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]);
      found += t.corners[0].dot(t.corners[1].cross(t.corners[2])) / 6.0;
      area += face;
      for (int i = 0; i < 3; ++i) {
        box.extend(t.corners[i]);
        EXPECT_GT(face.normalized().dot(t.normals[i]), 0.97);
      }
    }
    EXPECT_NEAR(found, volume, most_off);
    EXPECT_LT(area.norm(), 1e-12);
    EXPECT_NEAR(box.min().z(), 0.0, 0.01);
    EXPECT_NEAR(box.max().z(), 1.0, 0.01);
    EXPECT_NEAR(box.max().x(), 0.5, 0.01);
  }
  EXPECT_EQ(unit_shape(MeshShape::kBall).size(), 320U);
  EXPECT_THROW(unit_shape(MeshShape::kFile), std::invalid_argument);
}

/// A room with a box and a ball that is none.
worlds::World furnished() {
  worlds::World world = test::random_room(3);
  world.meshes.push_back({.position_m = {1.4, 0.3, 0.0},
                          .heading_rad = 0.4,
                          .scale = {0.3, 0.5, 0.4},
                          .material = worlds::Material::kPaint,
                          .shape = MeshShape::kBox,
                          .tint_rgb = {0.9, 0.2, 0.1}});
  world.meshes.push_back({.position_m = {1.2, -0.4, 0.0},
                          .scale = {0.25, 0.25, 0.25},
                          .material = worlds::Material::kPaint,
                          .shape = MeshShape::kBall,
                          .tint_rgb = {0.1, 0.3, 0.9}});
  return world;
}

std::vector<Triangle> placed(const worlds::MeshInstance& mesh) {
  std::vector<Triangle> triangles = unit_shape(mesh.shape);
  for (Triangle& triangle : triangles)
    for (Eigen::Vector3d& corner : triangle.corners)
      corner = mesh.position_m + Eigen::AngleAxisd(mesh.heading_rad, Eigen::Vector3d::UnitZ()) *
                                     mesh.scale.cwiseProduct(corner);
  return triangles;
}

// Away from edges, by the caster's own look at the neighbourhood: depths are those of the shapes, no pixel of
// them is a ball's, and the box is of its paint. Meant to catch: a shape that takes a ball's number.
TEST(UnitShapes, AreSurfacesOfTheirPaintAndNoBalls) {
  const worlds::World world = furnished();
  const StereoFrame frame = Renderer(world, test::small_rig()).render({});
  std::vector<Triangle> triangles = placed(world.meshes[0]);
  const std::size_t of_box = triangles.size();
  for (const Triangle& t : placed(world.meshes[1])) triangles.push_back(t);
  test::RayCaster caster(world, test::small_rig(), triangles);
  caster.stand_at({}, vision::Side::kLeft);
  const int first = static_cast<int>(world.balls.size() + world.walls.size()) + 1;
  int on_box = 0, on_ball = 0;
  for (int v = 2; v < 298; ++v) {
    for (int u = 2; u < 398; ++u) {
      const test::RayHit hit = caster.look(u, v);
      const int triangle = hit.surface - first;
      if (triangle < 0 || triangle >= static_cast<int>(triangles.size())) continue;
      bool is_inside = true;
      for (const auto& [du, dv] : {std::pair{-1.5, 0.0}, {1.5, 0.0}, {0.0, -1.5}, {0.0, 1.5}})
        is_inside = is_inside && caster.look(u + du, v + dv).surface == hit.surface;
      if (!is_inside) continue;
      EXPECT_EQ(frame.left.ball_id.at<std::uint8_t>(v, u), 0);
      EXPECT_NEAR(double{frame.left.depth_m.at<float>(v, u)}, hit.depth_m, 4e-6 * hit.depth_m);
      const cv::Vec3b bgr = frame.left.colour.at<cv::Vec3b>(v, u);
      if (triangle >= static_cast<int>(of_box)) {
        ++on_ball;
        EXPECT_GT(bgr[0], 2 * bgr[2]);
        continue;
      }
      ++on_box;
      const Triangle& face = triangles[static_cast<std::size_t>(triangle)];
      const Eigen::Vector3d normal =
          (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]).normalized();
      const double cosine = normal.dot(world.light.towards_light.normalized());
      const double light = world.light.ambient + world.light.diffuse * std::max(0.0, cosine);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(bgr[i], 255.0 * light * world.meshes[0].tint_rgb[2 - i], 1.0);
    }
  }
  EXPECT_GT(on_box, 3000);
  EXPECT_GT(on_ball, 100);
}

/// Mean colour of a picture's pixels where they are of one identity and depth is finite.
cv::Scalar mean_of(const RenderedImage& frame, int id) {
  return cv::mean(frame.colour, frame.ball_id == id);
}

// Meant to catch: a wall's tint for all walls; the floor's forgotten.
TEST(Tint, MultipliesTheColoursOfWallsAndFloor) {
  worlds::World world;
  world.walls = {{{2.0, -5.0}, {2.0, 5.0}, 2.5, worlds::Material::kBricks}};
  const StereoFrame plain = Renderer(world, test::small_rig()).render({});
  world.walls.front().tint_rgb = {0.5, 1.0, 0.25};
  world.floor_tint_rgb = {1.0, 0.5, 1.0};
  const StereoFrame tinted = Renderer(world, test::small_rig()).render({});
  for (const int row : {40, 280}) {
    const Eigen::Vector3d factors = row == 40 ? world.walls.front().tint_rgb : world.floor_tint_rgb;
    for (int column = 0; column < 400; ++column)
      for (int i = 0; i < 3; ++i)
        ASSERT_NEAR(tinted.left.colour.at<cv::Vec3b>(row, column)[i],
                    plain.left.colour.at<cv::Vec3b>(row, column)[i] * factors[2 - i], 1.0);
  }
}

TEST(Paint, IsWhatABallShows) {
  worlds::World world = test::flat_sky({{{1.5, 0.0, 1.5}, 0.3, 4}});
  const auto shown = [&] { return mean_of(Renderer(world, test::rig_looking_up()).render({}).left, 1); };
  const cv::Scalar palette = shown();
  world.balls.front().paint_rgb = worlds::palette_rgb(4);
  EXPECT_EQ(shown(), palette);
  world.balls.front().paint_rgb = Eigen::Vector3d(0.2, 0.4, 0.8);
  const cv::Scalar painted = shown();
  EXPECT_NEAR(painted[0], 0.8 * 255.0, 3.0);  // rims are mixed with the black sky
  EXPECT_NEAR(painted[1], 0.4 * 255.0, 2.0);
  EXPECT_NEAR(painted[2], 0.2 * 255.0, 2.0);
}

}  // namespace
}  // namespace stereobench::renderer
