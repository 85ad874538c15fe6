/// Memory that is asked of the system while frames are looked at.
#include "vision/scratch.h"

#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/observe.h"

#if defined(__SANITIZE_ADDRESS__)
TEST(Scratch, IsTheSystemsUnderTheSanitizer) {
  EXPECT_EQ(&stereobench::vision::scratch_memory(), std::pmr::new_delete_resource());
}
#else

namespace {
thread_local long asked = 0;  // how often this thread asked for memory
}

void* operator new(std::size_t size) {
  ++asked;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++asked;
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
// Not inlined: where one of a pair is and the other is not, GCC takes them for no pair.
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace stereobench::vision {
namespace {

// Balls apart and balls that hide each other, so that outlines of parts are looked for as well.
painter::Scene crowded_scene(const StereoRig& rig) {
  painter::Scene scene;
  scene.balls = painter::scattered_balls(rig, 0.9, 4.0, 3, false);
  scene.noise_sd_levels = 2.0;
  return scene;
}

// Mutations: one vector of the rim, of the shading's samples or of the blobs' forest from the system; a
// stable sort, which asks for a buffer.
TEST(Scratch, ServesAllButTheResultAfterTheFirstFrames) {
  const StereoRig rig = painter::rig_with_pictures_of(560, 420);
  const StereoPair pair = painter::paint(crowded_scene(rig), rig);
  const ObserverSettings settings{.noise_sd_levels = 2.0};
  const auto first = observe(pair, rig, settings);
  observe(pair, rig, settings);
  ASSERT_GT(first.size(), 8U);
  for (int frame = 0; frame < 5; ++frame) {
    const long before = asked;
    const auto balls = observe(pair, rig, settings);
    EXPECT_LE(asked - before, 1) << "frame " << frame;
    EXPECT_EQ(balls.size(), first.size());
  }
}

}  // namespace
}  // namespace stereobench::vision
#endif
