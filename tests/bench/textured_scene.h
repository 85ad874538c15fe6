/// Rooms whose walls and floor are pictures: of their own, or a mesh's.
#pragma once

#include <opencv2/core.hpp>

#include "tests/bench/bench_scene.h"
#include "tests/renderer/folder.h"

namespace stereobench {

/// 1024 x 1024 texels of grain.
inline std::string write_grain(const renderer::test::Folder& folder) {
  cv::Mat grain(1024, 1024, CV_8UC3);
  cv::RNG random(1);
  random.fill(grain, cv::RNG::UNIFORM, 90, 200);
  return folder.write("grain.png", grain);
}

/// ball_circle with its walls and floor under grain, 2 m a tile.
inline Scene image_textured_scene() {
  static const renderer::test::Folder folder;
  const worlds::SurfaceTexture grain{write_grain(folder), 2.0};
  Scene scene = scenario_scene("ball_circle");
  scene.world.floor = worlds::Material::kFile;
  scene.world.floor_texture = grain;
  for (worlds::Wall& wall : scene.world.walls) {
    wall.material = worlds::Material::kFile;
    wall.texture = grain;
  }
  return scene;
}

/// ball_circle's balls in a textured box, 1024 texels of grain on each 2 m, in files that last as long as the
/// process.
inline Scene textured_scene() {
  static const renderer::test::Folder folder;
  write_grain(folder);
  folder.write("room.mtl", "newmtl grain\nKd 1 1 1\nmap_Kd grain.png\n");
  const std::string file = folder.write(
      "room.obj",
      "mtllib room.mtl\nusemtl grain\n"
      "v -3 -2 0.001\nv 3 -2 0.001\nv 3 4 0.001\nv -3 4 0.001\n"
      "v -3 -2 2.5\nv 3 -2 2.5\nv 3 4 2.5\nv -3 4 2.5\n"
      "vt 0 0\nvt 3 0\nvt 3 1.25\nvt 0 1.25\nvt 3 3\nvt 0 3\n"
      "f 1/1 2/2 3/5 4/6\nf 5/1 6/2 7/5 8/6\nf 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\n"
      "f 4/1 1/2 5/3 8/4\n");
  Scene scene = scenario_scene("ball_circle");
  scene.world.walls.clear();
  scene.world.meshes.push_back({.file = file, .material = worlds::Material::kFile});
  return scene;
}

}  // namespace stereobench
