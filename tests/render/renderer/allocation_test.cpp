#include <gtest/gtest.h>

#include <fstream>
#include <new>
#include <string>
#include <vector>

#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "core/reference.h"
#include "render/files/scene_file/scene_file.h"
#include "render/integrators/path.h"
#include "render/integrators/whitted.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/renderer.h"
#include "render/renderer/tracer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/path_scenes.h"
#include "tests/render/renderer/counted_allocations.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

TEST(Allocation, WhittedAllocatesNothingWhenWarm) {
  for (const Scene& scene : {mixed_scene(32, 32), glass_cloud(32, 32)}) {
    const PreparedScene prepared = prepare(scene, 32, 32).value();
    IntegratorSettings settings;
    settings.stream_size = 256;
    Whitted whitted(prepared, *select_kernels("auto").value(), settings);
    const CameraView view = build_camera(*scene.camera, 32, 32);
    RayBuffer rays(1024);
    for (int i = 0; i < 1024; ++i) {
      rays.set(static_cast<std::size_t>(i), primary_ray(view, i % 32 + 0.5, i / 32 + 0.5));
    }
    std::vector<Color> radiance(1024);
    const long start = allocations();
    ASSERT_TRUE(whitted.trace({rays, prepared.coherence, nullptr}, radiance.data()));
    const long first = allocations();
    EXPECT_GT(first, start);
    ASSERT_TRUE(whitted.trace({rays, prepared.coherence, nullptr}, radiance.data()));
    EXPECT_EQ(allocations(), first);
  }
}

TEST(Allocation, PathTracingAllocatesNothingWhenWarm) {
  const Scene scene = path_scene(32, 32);
  const PreparedScene prepared = prepare(scene, 32, 32, serial_for, Method::path).value();
  IntegratorSettings settings;
  settings.stream_size = 256;
  Path path(prepared, *select_kernels("auto").value(), settings);
  const CameraView view = build_camera(*scene.camera, 32, 32);
  RayBuffer rays(1024);
  std::vector<SampleId> ids;
  for (int i = 0; i < 1024; ++i) {
    ids.push_back({i % 32, i / 32, 0});
    rays.set(static_cast<std::size_t>(i), primary_ray(view, i % 32 + 0.5, i / 32 + 0.5));
  }
  std::vector<Color> radiance(1024);
  ASSERT_TRUE(path.trace({rays, prepared.coherence, ids.data()}, radiance.data()));
  const long first = allocations();
  ASSERT_TRUE(path.trace({rays, prepared.coherence, ids.data()}, radiance.data()));
  EXPECT_EQ(allocations(), first);
}

/// Two parallel mirrors, between which a ray goes on for ever.
TEST(Allocation, SameForOneRayAtAnyDepth) {
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
    const long start = allocations();
    EXPECT_TRUE(whitted.trace({ray, Coherence::common_origin, nullptr}, &radiance));
    EXPECT_EQ(whitted.counts().continuation, static_cast<std::uint64_t>(max_depth));
    return allocations() - start;
  };
  EXPECT_EQ(allocated_at_depth(10000), allocated_at_depth(100));
}

/// The number of allocations of the first and the second render() of one renderer.
struct RenderAllocations {
  long first, second;
};

RenderAllocations count_render(const Scene& scene, const RenderOptions& options) {
  auto renderer = Renderer::create(scene, options);
  EXPECT_TRUE(renderer.ok());
  const auto counted_render = [&] {
    const long start = allocations();
    const auto image = renderer.value().render();
    EXPECT_TRUE(image.ok());
    return allocations() - start;
  };
  const long first = counted_render();
  return {first, counted_render()};
}

RenderOptions small_blocks(int width, int height, int spp, unsigned threads) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.spp = spp;
  options.tile = 8;
  options.threads = threads;
  return options;
}

/// An upper bound for the allocations of one worker: each of its buffers grows at most once per
/// power of two of the rays in a stream, however many blocks it renders.
constexpr long most_per_worker = 400;

/// A second picture allocates the picture itself and what starting threads takes.
TEST(Allocation, DoesNotGrowWithTheBlockCount) {
  for (const Scene& scene : {mixed_scene(32, 32), glass_cloud(32, 32)}) {
    for (const int side : {32, 128, 512}) {  // 16, 256, 4096 blocks
      for (const int spp : {1, 5}) {
        const auto [first, second] = count_render(scene, small_blocks(side, side, spp, 1));
        EXPECT_LE(first, most_per_worker) << side << " pixels, " << spp << " spp";
        EXPECT_EQ(second, 1) << side << " pixels, " << spp << " spp";
      }
    }
  }
}

/// It is chance which worker gets the block with the most rays, so each may allocate in either
/// picture.
TEST(Allocation, GrowsWithThreadsAtMost) {
  for (const unsigned threads : {2U, 4U}) {
    for (const int side : {128, 512}) {
      const auto [first, second] =
          count_render(mixed_scene(32, 32), small_blocks(side, side, 2, threads));
      EXPECT_LE(first + second, static_cast<long>(threads) * most_per_worker) << side << " pixels";
    }
  }
}

/// 64 blocks. In each of them two rays go on from 16 pixels more than in the block before, so
/// streams grow by packets until they are larger than those of the camera's rays.
TEST(Allocation, DoesNotGrowAsBlocksFillUp) {
  constexpr int tile = 32, blocks = 64, width = tile * blocks;
  Scene scene = empty_scene(width, tile);
  const Vec3f middle{width / 2, tile / 2, 0};
  scene.camera = OrthographicCamera{{middle + Vec3f{0, 0, 10}, middle, {0, 1, 0}}, tile};
  const auto material = add_material(scene, Phong{gray(1), 0, 0.5F, 0.5F, 0, 0.5F, 1});
  for (int block = 0; block < blocks; ++block) {
    for (int i = 0; i < 16 * block; ++i) {
      const auto x = static_cast<float>(tile * block + i % tile), y = static_cast<float>(i / tile);
      scene.spheres.push_back({{x + 0.5F, y + 0.5F, 0}, 0.25F, material});
    }
  }
  RenderOptions options = small_blocks(width, tile, 1, 1);
  options.tile = tile;
  options.order = PixelOrder::rows;
  const auto [first, second] = count_render(scene, options);
  EXPECT_LE(first, most_per_worker);
  EXPECT_EQ(second, 1);
}

/// Calls `make` with ever more memory until it returns true, and counts the calls before. Each of
/// them returns false or throws std::bad_alloc; any other end would end the test program.
template <class Make>
int failures_of(const Make& make) {
  int failures = 0;
  for (long allowed = 0; allowed < 100000; allowed += 1 + allowed / 50) {
    bool done = false;
    try {
      const ShortMemory memory(allowed);
      done = make();
    } catch (const std::bad_alloc&) {  // no memory even for a Diagnostic
    }
    if (done) return failures;
    ++failures;
  }
  ADD_FAILURE() << "never done";
  return failures;
}

TEST(Allocation, OutOfMemoryIsAnError) {
  const Scene scene = mixed_scene(32, 32);
  RenderOptions options = options_of(scene);
  options.threads = 2;
  EXPECT_GT(failures_of([&] {
              auto renderer = Renderer::create(scene, options);
              return renderer && renderer.value().render();
            }),
            20);
  auto renderer = Renderer::create(scene, options);
  Film film(renderer.value().rect());
  EXPECT_GT(failures_of([&] {
              auto another = Renderer::create(scene, options);
              return another && another.value().render_live(film).ok();
            }),
            20);
  const TempDir folder;
  const std::string file = (folder.path() / "scene.toml").string();
  std::ofstream(file) << "schema = 1\n[[sphere]]\ncenter = [0, 1, 0]\nradius = 2\n";
  EXPECT_GT(failures_of([&] { return load_scene(file).ok(); }), 20);
  const std::vector<Ray> rays(3000, Ray{{0, 1, 5}, {0, 0, -1}});
  std::vector<TracedHit> hits(rays.size());
  EXPECT_GT(failures_of([&] {
              auto tracer = Tracer::create(scene);
              return tracer && tracer.value().closest(rays, hits).ok();
            }),
            10);
}

}  // namespace
}  // namespace boule::test
