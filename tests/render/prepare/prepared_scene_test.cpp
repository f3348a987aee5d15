#include "render/prepare/prepared_scene.h"
#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"

#include <gtest/gtest.h>

#include <memory>
#include <tuple>

#include "core/reference.h"
#include "render/prepare/default_camera.h"
#include "render/prepare/default_light.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

TEST(DefaultView, IsValidForEmptyAndExtremeScenes) {
  Scene nothing, plane, tiny;
  plane.planes = {{{1e6f, 0, 0}, {0, 0, 3}, 0}};
  tiny.spheres = {{{1e8f, 1e8f, 0}, 1e-6f, 0}};
  for (const Scene* scene : {&nothing, &plane, &tiny}) {
    EXPECT_FALSE(find_problem(default_camera(*scene, 40, 30)));
  }
  for (const Vec3f& normal : {Vec3f{0, 1, 0}, Vec3f{0, 0, 3}, Vec3f{-1, 2, 5}}) {
    plane.planes = {{{2, 3, 4}, normal, 0}};
    const Ray ray = primary_ray(build_camera(default_camera(plane, 40, 30), 40, 30), 20, 15);
    EXPECT_EQ(reference::closest_hit(ray, {}, plane.planes).id, 0);
    EXPECT_LT(dot(vec_cast<double>(ray.dir), vec_cast<double>(normal)), 0);  // from its outside
  }
}

TEST(Prepare, RefusesObjectsThatCannotBeFramed) {
  Scene scene;
  add_material(scene, Matte{});
  scene.spheres = {{{3e38f, 0, 0}, 3e38f, 0}, {{-3e38f, 0, 0}, 3e38f, 0}};
  const auto prepared = prepare(scene, 10, 10);
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().key, "camera");
}

TEST(Prepare, DefaultLightOnlyWhereNothingShines) {
  Scene scene = empty_scene(10, 10);
  const auto lit = [&] { return prepare(scene, 10, 10).value().lights; };
  ASSERT_EQ(lit().size(), 2u);
  const auto key = std::get<DirectionalLight>(lit()[0]);
  EXPECT_GT(key.direction.x,
            0.3f);  // to the right, down, and away from the camera, which looks along -z
  EXPECT_LT(key.direction.y, -0.3f);
  EXPECT_LT(key.direction.z, -0.3f);
  const auto fill = std::get<PointLight>(lit()[1]);
  EXPECT_EQ(fill.position, (Vec3f{0, 0, 5}));
  EXPECT_LT(fill.intensity.r, key.intensity.r);
  EXPECT_EQ(fill.falloff, Falloff::none);
  EXPECT_EQ(prepare(scene, 10, 10).value().notes.size(), 1u);

  scene.background = GradientBackground{};
  EXPECT_TRUE(lit().empty());
  scene.background = ConstantBackground{gray(1)};
  EXPECT_EQ(lit().size(), 2u);
  scene.background = GradientBackground{{}, {}, {0, 1, 0}};  // black, which gives no light
  EXPECT_EQ(lit().size(), 2u);
  scene.background = ConstantBackground{};
  add_material(scene, Emissive{});
  EXPECT_EQ(lit().size(), 2u);  // no object is made of the material
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  EXPECT_TRUE(lit().empty());
  scene.materials[0].material = Emissive{gray(0)};
  EXPECT_EQ(lit().size(), 2u);
  scene.materials[0].material = Emissive{};
  scene.spheres.clear();
  scene.groups = {{"lamp", {{{0, 0, 0}, 1, 0}}, {}, {}}};
  EXPECT_EQ(lit().size(), 2u);
  scene.instances = {Instance{}};
  EXPECT_TRUE(lit().empty());
  scene.instances.clear();
  scene.groups.clear();
  scene.materials.clear();
  scene.lights = {DirectionalLight{}};
  EXPECT_EQ(lit().size(), 1u);
  EXPECT_TRUE(std::holds_alternative<DirectionalLight>(lit()[0]));
  EXPECT_TRUE(prepare(scene, 10, 10).value().notes.empty());
}

TEST(Prepare, PackedEmissiveSpheresAreLightUnlessBlack) {
  Scene scene = empty_scene(10, 10);
  add_material(scene, Emissive{});
  PackedSpheres spheres;
  spheres.count = 1;
  spheres.emissive = {{{0, 0, 0}, 1, 0}};
  scene.packed = std::make_shared<PackedSpheres>(spheres);
  EXPECT_FALSE(lacks_light(scene, Method::path));
  scene.materials[0].material = Emissive{gray(0)};
  EXPECT_TRUE(lacks_light(scene, Method::path));
}

/// By Whitted's method a gradient and what is emissive are seen, but light nothing: what is matte
/// would be black. Where nothing is, or ambient light is there, they stay as they are.
TEST(Prepare, WhittedGivesMatteObjectsADefaultLight) {
  Scene gradient = empty_scene(10, 10);
  gradient.background = GradientBackground{};
  Scene lamp = empty_scene(10, 10);
  add_material(lamp, Emissive{});
  lamp.spheres = {{{0, 0, 0}, 1, 0}};
  for (const auto& [scene, words] :
       {std::pair{&gradient, "its gradient is none"}, {&lamp, "its emissive objects are none"}}) {
    for (const Material& material :
         {Material{Matte{}}, Material{Plastic{}}, Material{Phong{}}, Material{Metal{}},
          Material{Glass{}}, Material{Phong{{1, 1, 1}, 0.5F, 1, 0, 0, 0, 1}}}) {
      Scene with = *scene;
      const auto index = static_cast<std::uint32_t>(with.materials.size());
      add_material(with, material);
      const bool needs =
          material.index() < 2 || (material.index() == 5 && !(std::get<Phong>(material).ka > 0));
      EXPECT_TRUE(prepare(with, 10, 10).value().lights.empty());  // no object has it
      with.spheres.push_back({{3, 0, 0}, 1, index});
      const auto prepared = prepare(with, 10, 10);
      EXPECT_EQ(prepared.value().lights.size(), needs ? 2U : 0U) << material.index();
      const auto& notes = prepared.value().notes;
      EXPECT_EQ(notes.size(), needs ? 1U : 0U);
      if (needs) EXPECT_NE(notes.back().find(words), std::string::npos);
      EXPECT_TRUE(prepare(with, 10, 10, serial_for, Method::path).value().lights.empty());
      with.ambient = gray(0.1F);
      EXPECT_TRUE(prepare(with, 10, 10).value().lights.empty());
    }
  }
}

TEST(Prepare, TellsOfCapsulesThatShine) {
  Scene scene = empty_scene(10, 10);
  add_material(scene, Matte{});
  add_material(scene, Emissive{});
  scene.capsules = {{{0, 0, 0}, {1, 0, 0}, 1, 0}};
  const auto notes = [&](Method method) {
    scene.lights = {PointLight{}};
    return prepare(scene, 10, 10, serial_for, method).value().notes;
  };
  EXPECT_TRUE(notes(Method::path).empty());
  scene.capsules[0].material = MaterialRef(1);
  EXPECT_TRUE(notes(Method::whitted).empty());
  ASSERT_EQ(notes(Method::path).size(), 1U);
  EXPECT_NE(notes(Method::path)[0].find("no lights to sample"), std::string::npos);
}

TEST(Prepare, NonBlackBackgroundsLightPathTracing) {
  Scene scene;
  const auto lights = [&] {
    return prepare(scene, 10, 10, serial_for, Method::path).value().lights.size();
  };
  EXPECT_EQ(lights(), 2u);
  scene.background = ConstantBackground{{0, 0.1f, 0}};
  EXPECT_EQ(lights(), 0u);
  scene.background = EnvironmentBackground{2, 1, {gray(0), gray(1)}};
  EXPECT_EQ(lights(), 0u);
  scene.background = EnvironmentBackground{2, 1, {gray(0), gray(0)}};
  EXPECT_EQ(lights(), 2u);
}

/// By method whitted an environment is seen in mirrors only; without a light matte objects would be
/// black.
TEST(Prepare, EnvironmentIsNoLightInWhitted) {
  Scene scene = empty_scene(10, 10);
  scene.background = EnvironmentBackground{2, 1, {gray(1), gray(1)}};
  const auto prepared = prepare(scene, 10, 10);
  ASSERT_EQ(prepared.value().lights.size(), 2u);
  ASSERT_EQ(prepared.value().notes.size(), 1u);
  EXPECT_NE(prepared.value().notes[0].find("environment"), std::string::npos);
}

TEST(FlatMaterial, GlassAboveWhiteAgreesInBothMethods) {
  for (const Color& color : {Color{2, 1, 0.5f}, Color{1, 1, 1}, Color{0.25f, 0.5f, 1}}) {
    const FlatMaterial whitted = flatten(Glass{color, 1.5f}, gray(1));
    const FlatMaterial path = flatten_for_paths(Glass{color, 1.5f});
    EXPECT_EQ(whitted.mirror, path.mirror);
    EXPECT_EQ(whitted.transmission, path.transmission);
    EXPECT_EQ(whitted.transmission, color * (1 / std::max(color.r, 1.0f)));
    EXPECT_TRUE(is_black(whitted.constant));  // glass ignores ambient light
  }
  EXPECT_TRUE(is_black(flatten(Metal{{2, 2, 2}}, gray(1)).constant));
  EXPECT_EQ(flatten(Phong{{1, 1, 1}, 0, 1, 0.5f, 0, 0, 1}, gray(1)).highlight, 0);  // shininess 0
}

TEST(Prepare, PicksAreaLightsByPowerOrEvenly) {
  Scene scene;
  scene.lights = {PointLight{}, SphereLight{{1, 2, 3}, 2, {1, 0, 0}},
                  SphereLight{{0, 0, 0}, 9, {0, 0, 0}}};
  const auto lamp = add_material(scene, Emissive{gray(1)});
  const auto dark = add_material(scene, Emissive{gray(0)});
  scene.spheres = {{{4, 5, 6}, 2, lamp}, {{7, 8, 9}, 5, dark}, {{7, 8, 9}, 1, lamp}};
  std::vector<Material> materials;
  for (const NamedMaterial& named : scene.materials) materials.push_back(named.material);
  const AreaLights lights(scene.lights, scene.spheres, materials);  // powers 4, 12 and 3
  EXPECT_EQ(lights.sphere_light_count(), 1u);
  // By power in 19ths for one half, evenly in 3rds for the other.
  ASSERT_EQ(lights.all().size(), 3u);
  std::size_t i = 0;
  for (const auto& [before, share, x] :
       {std::tuple{0.0, 31.0, 1.0}, {31.0, 55.0, 4.0}, {86.0, 28.0, 7.0}}) {
    const LightSphere& light = lights.all()[i++];
    EXPECT_NEAR(light.before, before / 114, 1e-15);
    EXPECT_NEAR(light.share, share / 114, 1e-15);
    EXPECT_EQ(light.center[0], x);
  }
  EXPECT_NEAR(lights.share_of(scene.spheres[2], gray(1)), 28 / 114.0, 1e-15);
  EXPECT_TRUE(AreaLights({}, {}, {}).empty());
}

TEST(Prepare, SaysThatItMadeACamera) {
  Scene scene;
  scene.lights = {DirectionalLight{}};
  EXPECT_TRUE(prepare(scene, 10, 10).value().notes.empty());  // there is nothing to frame
  scene.materials = {{"white", Matte{}}};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  const auto prepared = prepare(scene, 10, 10);
  ASSERT_EQ(prepared.value().notes.size(), 1u);
  EXPECT_NE(prepared.value().notes[0].find("camera"), std::string::npos);
}

TEST(Prepare, KnowsTheCoherenceOfPrimaryRays) {
  Scene scene = empty_scene(10, 10);
  EXPECT_EQ(prepare(scene, 10, 10).value().coherence, Coherence::common_origin);
  scene.camera = OrthographicCamera{};
  EXPECT_EQ(prepare(scene, 10, 10).value().coherence, Coherence::common_direction);
}

TEST(Prepare, FindsMaterialsBySlotOrId) {
  Scene scene = empty_scene(10, 10);
  const auto red = add_material(scene, Matte{{1, 0, 0}});
  const auto blue = add_material(scene, Matte{{0, 0, 1}});
  scene.spheres = {{{0, 0, 0}, 1, blue}, {{0, 0, 0}, 2, red}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, blue}, {{0, 0, 0}, {0, 1, 0}, red}};
  const auto prepared = prepare(scene, 10, 10);
  const SphereView spheres = prepared.value().geometry.view().spheres;
  for (std::uint32_t slot = 0; slot < 2; ++slot) {
    const Color expected = spheres.id[slot] == 0 ? Color{0, 0, 1} : Color{1, 0, 0};
    EXPECT_EQ(prepared.value().material_of({1, spheres.id[slot], slot}).diffuse, expected) << slot;
  }
  EXPECT_EQ(prepared.value().material_of({1, 2}).diffuse, (Color{0, 0, 1}));
  EXPECT_EQ(prepared.value().material_of({1, 3}).diffuse, (Color{1, 0, 0}));
}

TEST(FlatMaterial, HasTheTablesCoefficients) {
  const Color ambient{0.5f, 0.25f, 0}, c{0.5f, 1, 0.25f};
  const FlatMaterial matte = flatten(Matte{c}, ambient);
  EXPECT_EQ(matte.constant, c * ambient);
  EXPECT_EQ(matte.diffuse, c);
  EXPECT_FALSE(scatters(matte));
  EXPECT_TRUE(takes_direct_light(matte));

  const FlatMaterial plastic = flatten(Plastic{c, 0.5f, 9, 0.25f}, ambient);
  EXPECT_EQ(plastic.highlight, 0.5);
  EXPECT_EQ(plastic.shininess, 9);
  EXPECT_EQ(plastic.mirror, gray(0.25f));
  EXPECT_EQ(flatten(Plastic{c, 0.5f, 0, 0}, ambient).highlight, 0);  // no shininess, no highlight

  const FlatMaterial metal = flatten(Metal{c}, ambient);
  EXPECT_EQ(metal.mirror, c);
  EXPECT_TRUE(is_black(metal.constant));
  EXPECT_FALSE(takes_direct_light(metal));

  const FlatMaterial glass = flatten(Glass{c, 1.25f}, ambient);
  EXPECT_EQ(glass.mirror, gray(1));
  EXPECT_EQ(glass.transmission, c);
  EXPECT_EQ(glass.ior, 1.25);
  EXPECT_TRUE(glass.fresnel && is_black(glass.constant) && !takes_direct_light(glass));

  const FlatMaterial lamp = flatten(Emissive{{3, 2, 1}}, ambient);
  EXPECT_EQ(lamp.constant, (Color{3, 2, 1}));
  EXPECT_FALSE(scatters(lamp) || takes_direct_light(lamp));

  const FlatMaterial phong = flatten(Phong{c, 0.25f, 0.5f, 0.125f, 3, 0.75f, 2}, ambient);
  EXPECT_EQ(phong.constant, (Color{0.375f, 0.5f, 0.0625f}));
  EXPECT_EQ(phong.diffuse, c * 0.5f);
  EXPECT_EQ(phong.highlight, 0.125);
  EXPECT_EQ(phong.mirror, gray(0.125f));
  EXPECT_EQ(phong.transmission, gray(0.75f));
  EXPECT_EQ(phong.ior, 2);
  EXPECT_FALSE(phong.fresnel);
}

}  // namespace
}  // namespace boule::test
