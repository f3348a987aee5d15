// The bits of pictures and hits do not depend on the number of threads or on which comes first.
#include <gtest/gtest.h>

#include <set>

#include "render/renderer/tracer.h"
#include "tests/render/path_scenes.h"
#include "tests/render/ray_clouds.h"
#include "tests/support/bit_hash.h"

namespace boule::test {
namespace {

constexpr unsigned thread_counts[] = {1, 2, 3, 7, 16, 64};
constexpr int runs = 20;

std::uint64_t hash_of(const Image& image) {
  BitHash hash;
  for (const Color& c : image.pixels) {
    for (const float x : {c.r, c.g, c.b}) hash.add(x);
  }
  return hash.value();
}

/// So many small spheres that several threads build the tree.
Scene crowded(Scene scene) {
  for (Sphere& sphere : sphere_cloud(6000)) {
    scene.spheres.push_back({sphere.center, sphere.radius * 0.2f, 0});
  }
  return scene;
}

/// The hashes of all pictures: a single one unless they differ.
std::set<std::uint64_t> hashes_of_pictures(const Scene& scene) {
  std::set<std::uint64_t> hashes;
  for (const unsigned threads : thread_counts) {
    RenderOptions options = options_of(scene);
    options.threads = threads;
    options.tile = 4;  // so that there are blocks for all of them
    for (int run = 0; run < runs; ++run) hashes.insert(hash_of(render(scene, options)));
  }
  return hashes;
}

TEST(Determinism, OneWhittedPictureForAnyThreads) {
  EXPECT_EQ(hashes_of_pictures(crowded(mixed_scene(36, 28))).size(), 1u);
}

TEST(Determinism, OnePathTracedPictureForAnyThreads) {
  Scene scene = crowded(path_scene(36, 28));
  scene.image.spp = 2;
  EXPECT_EQ(hashes_of_pictures(scene).size(), 1u);
}

TEST(Determinism, OneAnswerToRaysForAnyThreads) {
  const Scene scene = objects(sphere_cloud(6000));
  const std::vector<Ray> rays = ray_cloud(70000);  // more blocks than threads
  std::vector<TracedHit> hits(rays.size());
  std::vector<std::uint8_t> met(rays.size());
  std::set<std::uint64_t> hashes;
  for (const unsigned threads : thread_counts) {
    TraceOptions options;
    options.threads = threads;
    auto tracer = Tracer::create(scene, options);
    for (int run = 0; run < runs; ++run) {
      ASSERT_TRUE(tracer.value().closest(rays, hits));
      ASSERT_TRUE(tracer.value().any(rays, met));
      BitHash hash;
      for (const TracedHit& hit : hits) {
        hash.add(hit.t);
        hash.add(hit.id);
        hash.add(hit.normal);
      }
      for (const std::uint8_t one : met) hash.add(std::uint64_t{one});
      hashes.insert(hash.value());
    }
  }
  EXPECT_EQ(hashes.size(), 1u);
}

}  // namespace
}  // namespace boule::test
