// Golden pictures: a few small pictures with every feature, whose bits are known. They are the same
// on every machine, so one hash per picture is enough. `boule render` of the scene shows the
// picture. Another hash is another picture: docs/versions.md says what version that makes.
#include "tests/render/picture_comparison.h"
#include "tests/support/bit_hash.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

std::uint64_t bits_of(const Image& image) {
  BitHash hash;
  hash.add(image.width);
  hash.add(image.height);
  for (const Color& c : image.pixels) {
    hash.add(c.r);
    hash.add(c.g);
    hash.add(c.b);
  }
  return hash.value();
}

struct Golden {
  const char* name;
  Scene scene;
  int spp;
  std::uint64_t bits;
};

std::vector<Golden> goldens() {
  Scene parallel = mixed_scene(40, 24);
  parallel.camera = OrthographicCamera{{{3, 4, 6}, {0, 0.8f, 0}, {0, 1, 0}}, 5};
  Scene path = mixed_scene(32, 18);
  path.render.method = Method::path;
  path.lights.push_back(SphereLight{{-1, 4, 3}, 0.5f, {5, 5, 4}});
  Scene path_cloud = glass_cloud(16, 16);
  path_cloud.render.method = Method::path;
  Scene noisy = path;
  noisy.render.noise = 0.1F;
  noisy.render.min_spp = 16;
  return {
      {"every feature, wider than high", mixed_scene(48, 27), 1, 0x4460bf5ca1b22b97},
      {"every feature, higher than wide", mixed_scene(19, 37), 4, 0xf98ce3cc6a82f0d4},
      {"orthographic", parallel, 1, 0xd169a17a2310321f},
      {"a crowd of glass and mirrors", glass_cloud(32, 32), 1, 0xd31a1f403a3353e8},
      {"every feature, by path tracing", path, 4, 0xaa71cd7685fe7507},
      {"a crowd of glass and mirrors, by path tracing", path_cloud, 4, 0xcfe712ed30fb59f3},
      {"every feature, with noise to order", noisy, 128, 0x6f667d440d4f4ce2},
  };
}

TEST(GoldenPicture, HasTheKnownBits) {
  for (Golden& golden : goldens()) {
    golden.scene.image.spp = golden.spp;
    EXPECT_EQ(bits_of(render(golden.scene)), golden.bits) << golden.name;
  }
}

}  // namespace
}  // namespace boule::test
