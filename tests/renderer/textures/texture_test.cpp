/// Textures and corner colours of meshes, from each kind of file to each pixel.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "renderer/renderer.h"
#include "renderer/textures/mip_chain.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/ray_caster.h"
#include "tests/renderer/textures/textures.h"

namespace stereobench::renderer {
namespace {

using test::complaint;
using test::Folder;
using test::light_of;
using testing::HasSubstr;

/// A picture of waves of several lengths and of blocks, no two corners alike.
cv::Mat picture(int width, int height) {
  cv::Mat bgr(height, width, CV_8UC3);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double wave = std::sin(0.19 * u) * std::cos(0.13 * v);
      bgr.at<cv::Vec3b>(v, u) = {cv::saturate_cast<std::uint8_t>(128 + 90 * wave),
                                 static_cast<std::uint8_t>((u / 8 + v / 8) % 2 == 0 ? 60 : 200),
                                 static_cast<std::uint8_t>(255 * u / width)};
    }
  }
  return bgr;
}

/// An upright square of 2 m at x = 0 facing west, its picture upright as seen from there.
const char* const kSquare =
    "mtllib square.mtl\nv 0 1 0\nv 0 -1 0\nv 0 -1 2\nv 0 1 2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl shown\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

worlds::World world_of(const std::string& file, double x_m, double scale = 1.0) {
  worlds::World world;
  world.light = {.towards_light = {0.0, 0.0, 1.0}, .ambient = 1.0, .diffuse = 0.0};
  world.meshes = {{file, {x_m, 0.0, -0.5}, 0.0, {1.0, scale, scale}, worlds::Material::kFile}};
  return world;
}

/// A second way to filter: in double precision, each texel of a level averaged anew from the picture.
class Reference {
 public:
  explicit Reference(cv::Mat bgr) : bgr_(std::move(bgr)) {}

  /// @param place in texels of the picture; width: of the pixel there, in texels
  Eigen::Vector3d look(const Eigen::Vector2d& place, double width) const {
    const double level = std::log2(std::max(width, 1.0));
    const int low = static_cast<int>(level);
    // as a piecewise linear logarithm has it: between powers of two, linear in the width
    const double t = std::max(width, 1.0) / std::exp2(low) - 1.0;
    return (1.0 - t) * bilinear(place, low) + t * bilinear(place, low + 1);
  }

 private:
  Eigen::Vector3d bilinear(const Eigen::Vector2d& place, int level) const {
    const Eigen::Vector2d x = place / std::exp2(level) - Eigen::Vector2d(0.5, 0.5);
    const Eigen::Vector2d cell = x.array().floor();
    const Eigen::Vector2d t = x - cell;
    const auto at = [&](int du, int dv) {
      return block(static_cast<int>(cell.x()) + du, static_cast<int>(cell.y()) + dv, 1 << level);
    };
    return (1 - t.y()) * ((1 - t.x()) * at(0, 0) + t.x() * at(1, 0)) +
           t.y() * ((1 - t.x()) * at(0, 1) + t.x() * at(1, 1));
  }
  Eigen::Vector3d block(int column, int row, int side) const {
    const int columns = bgr_.cols / side, rows = bgr_.rows / side;
    column = ((column % columns) + columns) % columns;
    row = ((row % rows) + rows) % rows;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int v = row * side; v < (row + 1) * side; ++v)
      for (int u = column * side; u < (column + 1) * side; ++u) {
        const cv::Vec3b& c = bgr_.at<cv::Vec3b>(v, u);
        sum += Eigen::Vector3d(light_of(c[2]), light_of(c[1]), light_of(c[0]));
      }
    return sum / (side * side);
  }

  cv::Mat bgr_;
};

struct Distance {
  double x_m;
  double scale;
};

void PrintTo(const Distance& value, std::ostream* out) {
  *out << value.x_m << " m, scale " << value.scale;
}

class Textured : public testing::TestWithParam<Distance> {};

// Each pixel inside of the square, against the ray-caster's place on it. The pixel's width in texels is taken
// from the places of the neighbours of its quad, as a rasteriser does.
TEST_P(Textured, EveryPixelIsWhatTheReferenceFilters) {
  const Folder folder;
  const cv::Mat bgr = picture(128, 64);
  folder.write("p.png", bgr);
  folder.write("square.mtl", "newmtl shown\nKd 1 1 1\nmap_Kd p.png\n");
  const std::string file = folder.write("square.obj", kSquare);
  const auto [x_m, scale] = GetParam();
  const worlds::World world = world_of(file, x_m, scale);
  const vision::StereoRig rig = test::small_rig();
  const slam::Pose pose{0.0, 0.1, 0.15};
  const StereoFrame frame = Renderer(world, rig).render(pose);
  std::vector<Triangle> triangles = read_mesh(file);
  for (Triangle& t : triangles)
    for (Eigen::Vector3d& c : t.corners)
      c = Eigen::Vector3d(x_m, 0.0, -0.5) + Eigen::Vector3d(1.0, scale, scale).cwiseProduct(c);
  test::RayCaster caster(world, rig, triangles);
  caster.stand_at(pose, vision::Side::kLeft);
  const auto place = [&](double u, double v) {
    const Eigen::Vector3d p = caster.look(u, v).point_m;
    return Eigen::Vector2d((scale - p.y()) / (2.0 * scale) * bgr.cols,
                           (2.0 * scale - 0.5 - p.z()) / (2.0 * scale) * bgr.rows);
  };
  const auto is_on = [&](int u, int v) {
    const int surface = caster.look(u, v).surface;
    return surface == 1 || surface == 2;
  };
  const Reference reference(bgr);
  long pixels = 0;
  double worst = 0.0;
  for (int v = 2; v < 296; ++v) {
    for (int u = 2; u < 396; ++u) {
      if (!is_on(u - 2, v) || !is_on(u + 2, v) || !is_on(u, v - 2) || !is_on(u, v + 2)) continue;
      const int u0 = u & ~1, v0 = v & ~1;
      const double width =
          std::max((place(u0 + 1, v) - place(u0, v)).norm(), (place(u, v0 + 1) - place(u, v0)).norm());
      const Eigen::Vector3d rgb = 255.0 * reference.look(place(u, v), width);
      const cv::Vec3b shown = frame.left.colour.at<cv::Vec3b>(v, u);
      const double error = (rgb - Eigen::Vector3d(shown[2], shown[1], shown[0])).lpNorm<Eigen::Infinity>();
      ++pixels;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GT(pixels, 400);
  EXPECT_LE(worst, 0.75) << "half a level is rounding, the rest 11 bits of light";
}

// Near: a texel is several pixels; far: a pixel is several texels; between; and seen at a slant by the pose.
INSTANTIATE_TEST_SUITE_P(Distances, Textured,
                         testing::Values(Distance{1.5, 0.6}, Distance{3.0, 1.0}, Distance{9.0, 1.0},
                                         Distance{25.0, 2.0}));

/// The mean colour of what is in the middle of the picture, red, green, blue.
Eigen::Vector3d middle(const worlds::World& world) {
  const cv::Mat colour = Renderer(world, test::small_rig()).render({}).left.colour;
  const cv::Scalar mean = cv::mean(colour(cv::Rect(colour.cols / 2 - 2, colour.rows / 2 - 2, 4, 4)));
  return {mean[2], mean[1], mean[0]};
}

// Meant to catch: levels for light; the material's colour forgotten.
TEST(Texture, IsLightOnceDecodedTimesTheMaterialsColour) {
  const Folder folder;
  folder.write("p.png", cv::Mat(16, 16, CV_8UC3, cv::Scalar(60, 120, 240)));
  folder.write("square.mtl", "newmtl shown\nKd 1 0.5 1\nmap_Kd p.png\n");
  const Eigen::Vector3d seen = middle(world_of(folder.write("square.obj", kSquare), 2.0));
  EXPECT_NEAR(seen.x(), 255.0 * light_of(240), 1.0);
  EXPECT_NEAR(seen.y(), 255.0 * light_of(120) * 0.5, 1.0);
  EXPECT_NEAR(seen.z(), 255.0 * light_of(60), 1.0);
}

TEST(Texture, BorderGoesOnWhereTheFileSaysSo) {
  const Folder folder;
  cv::Mat halves(16, 16, CV_8UC3, cv::Scalar(0, 0, 255));
  halves.colRange(0, 8).setTo(cv::Scalar(255, 0, 0));
  folder.write("p.png", halves);
  std::string wide = kSquare;  // the picture's left half would be in the middle again
  for (const auto& [from, to] : {std::pair{"vt 1 0", "vt 2.5 0"}, {"vt 1 1", "vt 2.5 1"}})
    wide.replace(wide.find(from), 6, to);
  const std::string file = folder.write("square.obj", wide);
  folder.write("square.mtl", "newmtl shown\nKd 1 1 1\nmap_Kd p.png\n");
  EXPECT_GT(middle(world_of(file, 2.0)).z(), 200.0);
  folder.write("square.mtl", "newmtl shown\nKd 1 1 1\nmap_Kd -clamp on p.png\n");
  EXPECT_GT(middle(world_of(file, 2.0)).x(), 200.0);
}

// A level's light is the mean of the finest one's, whatever the sides. Meant to catch: means of means.
TEST(Pyramid, EveryLevelAveragesTheLightOfItsTexels) {
  for (const auto& [width, height] : {std::pair{64, 16}, {37, 5}, {1, 9}, {1, 1}}) {
    Texture texture{width, height, {true, true}, {}};
    slam::RandomStream random(7, slam::Stream::kWorld);
    for (int i = 0; i < 3 * width * height; ++i)
      texture.rgb.push_back(static_cast<std::uint8_t>(random.bits() & 255U));
    double green = 0.0;
    for (std::size_t i = 1; i < texture.rgb.size(); i += 3) green += light_of(texture.rgb[i]);
    green /= width * height;
    const MipChains mip_chains = make_mip_chains({texture, texture});
    ASSERT_EQ(mip_chains.texels.size(), 2 * mip_size(texture));
    for (const MipPlace& place : mip_chains.places) {
      const auto top =
          mip_chains
              .texels[static_cast<std::size_t>(place.first[static_cast<std::size_t>(place.last_level)])];
      EXPECT_NEAR(((top >> 11U) & 2047U) / 2047.0, green, 3e-4) << width << " x " << height;
    }
  }
  EXPECT_THROW(make_mip_chains({Texture{}}), std::invalid_argument);
}

TEST(Texture, OneThatIsMissingBrokenOrTooLargeIsOneLine) {
  const Folder folder;
  const std::string file = folder.write("square.obj", kSquare);
  worlds::World world = world_of(file, 2.0);
  folder.write("square.mtl", "newmtl shown\nmap_Kd gone.png\n");
  EXPECT_THAT(complaint(world), HasSubstr(file + ": its texture gone.png does not exist"));
  folder.write("gone.png", std::string("\x89PNG\r\n, or so"));
  EXPECT_EQ(complaint(world),
            file + ": its texture gone.png is no whole picture: PNG file corrupted by ASCII conversion");
  folder.write("gone.png", picture(32, 8));
  EXPECT_EQ(complaint(world), "no complaint");
  world.mesh_limits.texture_px = 31;
  EXPECT_EQ(complaint(world), file + ": its texture gone.png is 32 x 8, more than 31 pixels");
  world.mesh_limits.texture_px = 32;
  world.mesh_limits.texture_mib = 1;
  folder.write("gone.png", picture(32, 32));
  EXPECT_EQ(complaint(world), "no complaint");
  world.mesh_limits.texture_px = 4096;
  folder.write("gone.png", picture(1024, 256));
  EXPECT_EQ(complaint(world), file + ": with it the world's textures are more than 1 MiB");
  folder.write("gone.png", std::string());
  EXPECT_EQ(complaint(world), file + ": its texture gone.png is empty");
  world.meshes.front().material = worlds::Material::kWood;
  EXPECT_EQ(complaint(world), "no complaint") << "nobody looks at it";
}

// Corner colours are interpolated. Meant to catch: the first corner's for all.
TEST(CornerColours, AreSeenBetweenTheCorners) {
  const Folder folder;
  const std::string file = folder.write("square.obj",
                                        "v 0 1 0 1 0 0\nv 0 -1 0 0 1 0\nv 0 -1 2 0 1 0\nv 0 1 2 1 0 0\n"
                                        "f 1 2 3\nf 1 3 4\n");
  const Mesh mesh = read_textured_mesh(file);
  EXPECT_TRUE(mesh.textures.empty());
  const worlds::World world = world_of(file, 2.0);
  const cv::Mat colour = Renderer(world, test::small_rig()).render({}).left.colour;
  const int row = colour.rows / 2;
  int last_green = -1;
  for (int column = 120; column < 280; column += 20) {
    const cv::Vec3b bgr = colour.at<cv::Vec3b>(row, column);
    EXPECT_NEAR(bgr[1] + bgr[2], 0.6 * 255.0, 2.0) << column;  // the grey that assimp gives what has none
    EXPECT_GT(bgr[1], last_green) << "green grows to the right";
    last_green = bgr[1];
  }
}

const std::filesystem::path kGallery = STEREOBENCH_SOURCE_DIR "/../shared/data/meshes";

// A picture within a glTF file, and pictures beside a Collada file.
TEST(Texture, OfFilesThatNobodyHereMade) {
  const auto box = kGallery / "good/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb";
  const auto maze = kGallery / "worlds/nist_maze_wall_240/meshes/nist_maze_wall_240.dae";
  if (!std::filesystem::exists(box)) GTEST_SKIP() << "no " << box;
  const Mesh of_box = read_textured_mesh(box);
  ASSERT_EQ(of_box.textures.size(), 1U);
  EXPECT_EQ(of_box.textures[0].width_px, 211);
  EXPECT_TRUE(of_box.textures[0].repeats[0]);
  const Mesh of_maze = read_textured_mesh(maze);
  ASSERT_EQ(of_maze.textures.size(), 1U);
  EXPECT_EQ(of_maze.textures[0].height_px, 256);
  EXPECT_GE(of_maze.triangles.front().texture, 0);
}

}  // namespace
}  // namespace stereobench::renderer
