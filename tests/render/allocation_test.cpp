#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "core/reference.h"
#include "render/integrators/whitted.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/test_scenes.h"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  if (void* memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded))
    return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace boule::test {
namespace {

TEST(Allocation, NothingIsAllocatedInTheSteadyState) {
  for (const Scene& scene : {mixed_scene(32, 32), glass_cloud(32, 32)}) {
    const PreparedScene prepared = prepare(scene, 32, 32).value();
    IntegratorSettings settings;
    settings.stream_size = 256;
    Whitted whitted(prepared, *select_kernels("auto").value(), settings);
    const CameraBasis basis = camera_basis(*scene.camera, 32, 32);
    RayBuffer rays(1024);
    for (int i = 0; i < 1024; ++i) {
      rays.set(static_cast<std::size_t>(i),
               reference::primary_ray(basis, i % 32 + 0.5, i / 32 + 0.5));
    }
    std::vector<Color> radiance(1024);
    const long start = allocations;
    ASSERT_TRUE(whitted.trace(rays, prepared.coherence, radiance.data()));
    const long first = allocations;
    EXPECT_GT(first, start);
    ASSERT_TRUE(whitted.trace(rays, prepared.coherence, radiance.data()));
    EXPECT_EQ(allocations, first);
  }
}

/// Two parallel mirrors: one ray for ever.
TEST(Allocation, DoesNotGrowWithTheDepthWhereOneRayGoesOn) {
  Scene scene = empty_scene(1, 1);
  const auto mirror = add_material(scene, Metal{gray(1)});
  scene.planes = {{{0, 0, -1}, {0, 0, 1}, mirror}, {{0, 0, 6}, {0, 0, -1}, mirror}};
  const PreparedScene prepared = prepare(scene, 1, 1).value();
  const auto allocated_at_depth = [&](int max_depth) {
    IntegratorSettings settings;
    settings.max_depth = max_depth;
    Whitted whitted(prepared, *select_kernels("auto").value(), settings);
    RayBuffer ray(1);
    ray.set(0, {{0, 0, 5}, {0, 0, -1}});
    Color radiance;
    const long start = allocations;
    EXPECT_TRUE(whitted.trace(ray, Coherence::common_origin, &radiance));
    EXPECT_EQ(whitted.counts().continuation, static_cast<std::uint64_t>(max_depth));
    return allocations - start;
  };
  EXPECT_EQ(allocated_at_depth(10000), allocated_at_depth(100));
}

}  // namespace
}  // namespace boule::test
