// Pictures and hits of groups and their instances, compared with those of the scene written out.
#include "core/scene/instances.h"

#include <gtest/gtest.h>

#include "render/renderer/scene_hash.h"
#include "render/renderer/tracer.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/grouped_scene.h"

namespace boule::test {
namespace {

TEST(Instances, PictureHashAndTracesAreThoseOfTheSceneWrittenOut) {
  const Scene grouped = grouped_scene();
  EXPECT_FALSE(validate(grouped));
  Scene flat = grouped;
  expand_instances(flat);
  EXPECT_EQ(flat.spheres.size(), 3u + 3 + 2 + 3);
  EXPECT_EQ(count_primitives(grouped).spheres, flat.spheres.size());
  EXPECT_EQ(count_primitives(grouped).planes, flat.planes.size());
  EXPECT_EQ(scene_hash(grouped), scene_hash(flat));
  EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
  Scene framed = grouped;  // without a camera: framed on what the instances show
  framed.camera.reset();
  flat.camera.reset();
  EXPECT_EQ(differing_pixels(render(framed), render(flat)), 0);

  std::vector<Ray> rays;
  CaseRandom random(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3d from = random.direction() * 6.0, to = random.direction();
    rays.push_back({from, vec_cast<float>(to - from)});
  }
  std::vector<TracedHit> a(rays.size()), b(rays.size());
  EXPECT_FALSE(Tracer::create(grouped).value().closest(rays, a));
  EXPECT_FALSE(Tracer::create(flat).value().closest(rays, b));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_TRUE(a[i].t == b[i].t && a[i].id == b[i].id && a[i].normal == b[i].normal);
  }
}

TEST(Instances, EveryIsaThreadsAndTilesGiveThePictureWrittenOut) {
  Scene flat = grouped_scene();
  expand_instances(flat);
  const Image expected = render(flat);
  for (const char* isa : {"scalar", "auto"}) {
    for (const unsigned threads : {1u, 3u}) {
      RenderOptions options = options_of(flat);
      options.isa = isa;
      options.threads = threads;
      options.tile = threads == 1 ? 7 : 0;
      EXPECT_EQ(differing_pixels(render(grouped_scene(), options), expected), 0);
    }
  }
}

TEST(Instances, PathsSeeTheLampsInGroups) {
  Scene grouped = grouped_scene();
  grouped.groups[1].spheres[0].material = 4;  // the lamp
  grouped.image.spp = 4;
  grouped.render.method = Method::path;
  Scene flat = grouped;
  expand_instances(flat);
  EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
}

/// All AOVs of a scene.
std::vector<ImageChannel> aovs_of(const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.aovs = {true, true, true, true, true};
  auto renderer = Renderer::create(scene, options);
  EXPECT_TRUE(renderer);
  return std::move(renderer.value().render_aovs()).value();
}

void expect_the_same_pictures(const Scene& grouped, const Scene& flat) {
  EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
  const auto found = aovs_of(grouped), expected = aovs_of(flat);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i].samples == expected[i].samples) << found[i].name;
}

TEST(Instances, SharedGroupsHaveThePicturesAndAovsWrittenOut) {
  Scene grouped = shared_scene();
  ASSERT_TRUE(groups_to_share(grouped));
  Scene flat = grouped;
  expand_instances(flat);
  ASSERT_FALSE(groups_to_share(flat));
  EXPECT_GT(flat.spheres.size(), 150'000U);
  expect_the_same_pictures(grouped, flat);
  grouped.render.method = flat.render.method = Method::path;  // with lamps in groups
  grouped.image.spp = flat.image.spp = 3;
  expect_the_same_pictures(grouped, flat);
}

TEST(Instances, SharedGroupsAreFramedAndLitAsThoseWrittenOut) {
  Scene grouped = shared_scene();
  grouped.camera.reset();
  grouped.lights.clear();
  grouped.background = ConstantBackground{};
  grouped.materials[4].material = Matte{};  // no lamp
  Scene flat = grouped;
  expand_instances(flat);
  expect_the_same_pictures(grouped, flat);
}

TEST(Instances, RaysMeetSharedGroupsAsThoseWrittenOut) {
  const Scene grouped = shared_scene();
  Scene flat = grouped;
  expand_instances(flat);
  std::vector<Ray> rays;
  CaseRandom random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d from = random.direction() * 4.0, to = random.direction() * 2.0;
    rays.push_back({from, vec_cast<float>(to - from)});
  }
  for (const Solver solver : {Solver::robust, Solver::fast}) {
    TraceOptions options;
    options.solver = solver;
    std::vector<TracedHit> a(rays.size()), b(rays.size());
    EXPECT_FALSE(Tracer::create(grouped, options).value().closest(rays, a));
    EXPECT_FALSE(Tracer::create(flat, options).value().closest(rays, b));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_TRUE(a[i].t == b[i].t && a[i].id == b[i].id && a[i].normal == b[i].normal) << i;
    }
  }
}

/// What is shared is hashed as it is: everything that a picture depends on counts.
TEST(Instances, HashesOfSharedGroupsDependOnThemAndWhereTheyAre) {
  const Scene scene = shared_scene();
  Scene moved = scene, resized = scene, fewer = scene;
  moved.instances.back().translate.x += 1;
  resized.groups[2].spheres[17].radius *= 2;
  fewer.instances.pop_back();
  for (const Scene& other : {moved, resized, fewer})
    EXPECT_NE(scene_hash(other), scene_hash(scene));
  EXPECT_EQ(scene_hash(shared_scene()), scene_hash(scene));
}

}  // namespace
}  // namespace boule::test
