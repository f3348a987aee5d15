// A packed scene has the picture, the hits, the hash and the camera of the scene that was packed.
#include <algorithm>
#include <limits>

#include "render/prepare/default_camera.h"
#include "render/renderer/renderer.h"
#include "render/renderer/scene_hash.h"
#include "render/renderer/tracer.h"
#include "simd/geometry/bvh_builder.h"
#include "tests/render/files/packed/packed_scenes.h"

namespace boule::test {
namespace {

/// Rays from all around, and what a scene says of them.
std::vector<TracedHit> hits_of(const Scene& scene) {
  std::vector<Ray> rays;
  CaseRandom random(5);
  for (int i = 0; i < 4000; ++i) {
    const Vec3d org = random.direction() * 5.0;
    rays.push_back({org, vec_cast<float>(random.direction() * random.uniform(0, 1.5) - org)});
  }
  std::vector<TracedHit> hits(rays.size());
  auto tracer = Tracer::create(scene, {});
  if (!tracer || !tracer.value().closest(rays, hits)) ADD_FAILURE();
  return hits;
}

void expect_same_hits(const Scene& a, const Scene& b) {
  const std::vector<TracedHit> x = hits_of(a), y = hits_of(b);
  int met = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_EQ(x[i].t, y[i].t) << i;
    ASSERT_EQ(x[i].id, y[i].id) << i;
    met += x[i].id >= 0 ? 1 : 0;
  }
  EXPECT_GT(met, 0);
}

class PackedScenes : public PackedTest {
 protected:
  /// Packs a scene at once, in parts, and in chunks of so many spheres, and compares pictures of
  /// both methods, AOVs, hits, hash.
  void expect_same(const Scene& scene, std::uint64_t chunk = 700) {
    constexpr std::uint64_t one_chunk = packed_format::packed_spheres;
    for (const auto& [memory, most] :
         {std::pair{much_memory, one_chunk}, {little_memory, one_chunk}, {little_memory, chunk}}) {
      const Scene other = packed(scene, memory, most);
      ASSERT_EQ(other.packed == nullptr, scene.spheres.empty());
      EXPECT_EQ(scene_hash(other), scene_hash(scene));
      expect_same_hits(scene, other);
      for (const Method method : {Method::whitted, Method::path}) {
        RenderOptions options = options_of(scene);
        options.method = method;
        options.spp = 2;
        EXPECT_EQ(differing_pixels(render(scene, options), render(other, options)), 0)
            << name_of(method) << " " << memory << " " << most;
      }
    }
  }
};

TEST_F(PackedScenes, KeepTheirCapsules) {
  Scene scene = cloud(1000);
  scene.capsules = {{{-1, 0, 1}, {1, 0.5F, 1}, 0.2F, MaterialRef::colored(0, {200, 9, 9})},
                    {{0, -1, 0.5F}, {3, 1, 0}, 0.1F, 2}};
  expect_same(scene);
  scene.camera.reset();
  expect_same(scene);
}

TEST_F(PackedScenes, AreThoseThatWerePacked) {
  for (const int spheres : {0, 1, 16, 48, 49, 1000, 20'000}) {
    SCOPED_TRACE(spheres);
    Scene scene = cloud(spheres);
    if (spheres == 0) scene.planes.push_back({{0, 0, -3}, {0, 0.5F, 1}, 0});
    expect_same(scene);
  }
}

TEST_F(PackedScenes, OfEveryMaterialAndLight) { expect_same(mixed_scene(48, 36)); }

TEST_F(PackedScenes, KeepAllElse) {
  Scene scene = cloud(300);
  scene.image = {31, 17, 3, PixelFilter::tent, true, 1.5F};
  scene.render = {7, Method::path};
  scene.ambient = {0.1F, 0.2F, 0.3F};
  scene.backdrop = Color{1, 0, 1};
  const Scene other = packed(scene);
  EXPECT_EQ(scene_hash(other), scene_hash(scene));
  EXPECT_EQ(other.image.width, 31);
  EXPECT_EQ(other.image.spp, 3);
  EXPECT_EQ(other.image.filter, PixelFilter::tent);
  EXPECT_EQ(other.image.outline, 1.5F);
  EXPECT_EQ(other.render.max_depth, 7);
  EXPECT_EQ(other.render.method, Method::path);
  EXPECT_EQ(other.materials.size(), scene.materials.size());
  EXPECT_EQ(other.materials[2].name, scene.materials[2].name);
}

TEST_F(PackedScenes, WithGiantsAndUnboxedSpheres) {
  Scene scene = cloud(3000);
  scene.spheres[7] = {{0, -1001, 0}, 1000, 0};
  scene.spheres[2999] = {{0, 0, 0}, 4000, 1};
  expect_same(scene);
  scene.spheres[1500] = {{0, -3e18F, 0}, 2.99e18F, 0};
  expect_same(scene, packed_format::packed_spheres);
}

TEST_F(PackedScenes, OfSeveralChunksRefuseSpheresFarAway) {
  Scene scene = cloud(300);
  scene.spheres[7] = {{0, -3e18F, 0}, 2.99e18F, 0};
  pack_to(path("far.boule"), scene, much_memory, 100);
  const auto file = PackedFile::open(path("far.boule"));
  ASSERT_TRUE(file);
  EXPECT_EQ(file.value().contents().chunks.size(), 3U);
  const auto refused = file.value().scene();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "has chunks of spheres, of which some are farther away or larger than 1e17");
}

/// More copies than fit at a time, of which the first two count.
TEST_F(PackedScenes, WithCopies) {
  Scene scene = cloud(500);
  for (int i = 0; i < 6000; ++i) {
    scene.spheres.insert(scene.spheres.begin() + i % 500, {{0.3F, 0.2F, 0.1F}, 0.25F, 2});
    scene.spheres.push_back({{-0.3F, 0.2F, 0.1F}, 0.2F, 1});
  }
  expect_same(scene);
  std::fill(scene.spheres.begin(), scene.spheres.end(), Sphere{{0.3F, 0.2F, 0.1F}, 0.25F, 2});
  expect_same(scene);
}

/// All centres lie in one point, or along one line.
TEST_F(PackedScenes, WithoutRoomBetweenCentres) {
  Scene scene = cloud(5000);
  for (std::size_t i = 0; i < scene.spheres.size(); ++i)
    scene.spheres[i].radius = 0.1F + 1e-4F * static_cast<float>(i % 4000);
  for (Sphere& sphere : scene.spheres) sphere.center = {0, 0, 0};
  expect_same(scene);
  for (std::size_t i = 0; i < scene.spheres.size(); ++i)
    scene.spheres[i].center.x = i < 4990 ? 0 : static_cast<float>(i) - 4990;
  expect_same(scene);
}

TEST_F(PackedScenes, AreTheSameForAnyThreads) {
  const Scene scene = cloud(20'000);
  pack_to(path("a.boule"), scene, little_memory);
  Scene rest = scene;
  SpheresInMemory spheres(std::exchange(rest.spheres, {}));
  // The calls in reverse, as threads may make them.
  const ParallelFor backward = [](std::size_t count, const auto& body) {
    while (count-- > 0) body(count);
  };
  ASSERT_TRUE(pack({rest,
                    {1, 2, 3},
                    spheres,
                    path("b.boule"),
                    {.memory = little_memory, .beside = {}, .parallel_for = backward}}));
  EXPECT_TRUE(read_bytes(path("a.boule")) == read_bytes(path("b.boule")));
}

TEST_F(PackedScenes, HaveTheDefaultCamera) {
  Scene scene = cloud(5000);
  scene.camera.reset();
  scene.lights.clear();
  const auto expect_same_camera = [&] {
    const Scene other = packed(scene, little_memory);
    ASSERT_FALSE(other.camera);
    for (const auto& [width, height] : {std::pair{64, 48}, {48, 64}, {100, 10}}) {
      Scene a = scene, b = other;
      a.camera = default_camera(scene, width, height);
      b.camera = default_camera(other, width, height);
      EXPECT_EQ(scene_hash(a), scene_hash(b)) << width;
      EXPECT_EQ(differing_pixels(render(a), render(b)), 0);
    }
  };
  expect_same_camera();
  scene.planes.clear();
  for (Sphere& sphere : scene.spheres) sphere.center.y *= 0.01F;  // nearly a sheet
  expect_same_camera();
  scene.fit.type = FittedCamera::orthographic;
  scene.fit.direction = Vec3f{1, 2, 3};
  expect_same_camera();
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {  // a lattice: many are outermost
    const auto k = static_cast<int>(i);
    scene.spheres[i] = {{0.1F * static_cast<float>(k % 17), 0.1F * static_cast<float>(k / 17 % 17),
                         0.1F * static_cast<float>(k / 289)},
                        0.05F,
                        0};
  }
  scene.fit = {};
  expect_same_camera();
}

TEST_F(PackedScenes, SayWhatIsInThem) {
  const Scene scene = cloud(1000);
  const Scene other = packed(scene);
  const PackedSpheres& spheres = *other.packed;
  EXPECT_EQ(spheres.count, 1000U);
  EXPECT_TRUE(spheres.has_own_colors);
  EXPECT_EQ(spheres.emissive.size(), 28U);
  EXPECT_EQ(spheres.made_of[3], 28U);
  EXPECT_EQ(spheres.made_of[0] + spheres.made_of[1] + spheres.made_of[2], 972U);
  const SphereBounds a = bounds_of(scene), b = bounds_of(other);
  EXPECT_EQ(a.low.x, b.low.x);
  EXPECT_EQ(a.high.z, b.high.z);
}

TEST_F(PackedScenes, RefuseOtherSpheresBeside) {
  Scene scene = packed(cloud(100));
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  const Status done = validate(scene);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().key, "packed");
  scene.spheres.clear();
  scene.materials.pop_back();
  EXPECT_FALSE(validate(scene));
}

TEST_F(PackedScenes, LeaveNothingBehind) {
  Scene scene = cloud(3000);
  pack_to(path("scene.boule"), scene, little_memory);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& one :
       std::filesystem::directory_iterator(std::filesystem::path(path("x")).parent_path()))
    ++files;
  EXPECT_EQ(files, 1U);
  int asked = 0;
  SpheresInMemory spheres(std::exchange(scene.spheres, {}));
  const auto stopped =
      pack({scene,
            {},
            spheres,
            path("stopped.boule"),
            {.memory = little_memory, .beside = {}, .stop = [&] { return ++asked > 4; }}});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().message, "interrupted");
  EXPECT_FALSE(std::filesystem::exists(path("stopped.boule")));
}

TEST_F(PackedScenes, AreVerified) {
  if (!Checksum::available()) GTEST_SKIP() << "this build has no checksums";
  pack_to(path("scene.boule"), cloud(1000));
  std::string bytes = read_bytes(path("scene.boule"));
  EXPECT_TRUE(PackedFile::open(path("scene.boule")).value().verify(serial_for));
  bytes[packed_format::page + 5] ^= 1;  // of a sphere
  write_bytes(path("scene.boule"), bytes);
  const Status done = PackedFile::open(path("scene.boule")).value().verify(serial_for);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "its section blocks is damaged");
}

}  // namespace
}  // namespace boule::test
