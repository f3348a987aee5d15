// Every field of a scene, broken in turn: validate() must name it. Cameras: camera_fields_test.cpp.
#include "core/scene/scene.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/core/scene/broken_scene.h"

namespace boule::test {
namespace {

GradientBackground& gradient(Scene& scene) {
  return std::get<GradientBackground>(scene.background);
}
EnvironmentBackground& environment(Scene& scene) {
  scene.background = EnvironmentBackground{3, 2, std::vector<Color>(6, {1, 1, 1}), 0};
  return std::get<EnvironmentBackground>(scene.background);
}
template <class M>
M& material(Scene& scene) {
  for (NamedMaterial& named : scene.materials) {
    if (auto* found = std::get_if<M>(&named.material)) return *found;
  }
  throw std::logic_error("full_scene() lacks a material");
}
PointLight& point_light(Scene& scene) { return std::get<PointLight>(scene.lights[0]); }
SphereLight& sphere_light(Scene& scene) { return std::get<SphereLight>(scene.lights[2]); }
DirectionalLight& directional_light(Scene& scene) {
  return std::get<DirectionalLight>(scene.lights[1]);
}

TEST(Validate, AcceptsAFullScene) { EXPECT_TRUE(validate(full_scene())); }
TEST(Validate, AcceptsAnEmptyScene) { EXPECT_TRUE(validate(Scene{})); }

TEST_P(ValidateRefuses, NamingTheKey) {
  Scene scene = full_scene();
  GetParam().apply(scene);
  const Status status = validate(scene);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().key, GetParam().key);
  EXPECT_NE(status.error().message.find(GetParam().message), std::string::npos)
      << status.error().message;
}

const Breakage settings[] = {
    {"WidthZero", "image.size", "1 to 65535, is 0", [](Scene& s) { s.image.width = 0; }},
    {"WidthHuge", "image.size", "is 65536", [](Scene& s) { s.image.width = 65536; }},
    {"HeightNegative", "image.size", "is -1", [](Scene& s) { s.image.height = -1; }},
    {"HeightHuge", "image.size", "is 65536", [](Scene& s) { s.image.height = 65536; }},
    {"SppZero", "image.spp", "1 or above, is 0", [](Scene& s) { s.image.spp = 0; }},
    {"DepthNegative", "render.max_depth", "0 or above, is -1",
     [](Scene& s) { s.render.max_depth = -1; }},
};
INSTANTIATE_TEST_SUITE_P(Settings, ValidateRefuses, testing::ValuesIn(settings), name_of);

TEST(Validate, AcceptsAnEnvironment) {
  Scene scene = full_scene();
  environment(scene).pixels[2] = {3e38f, 3e38f, 3e38f};
  EXPECT_TRUE(validate(scene));
}

const Breakage environments[] = {
    {"NoColumns", "background.file", "width x height pixels",
     [](Scene& s) { environment(s).width = 0; }},
    {"NegativeRows", "background.file", "width x height pixels",
     [](Scene& s) { environment(s).height = -2; }},
    {"BothNegative", "background.file", "width x height pixels",
     [](Scene& s) {
       environment(s).width = -3;
       environment(s).height = -2;
     }},
    {"TooFew", "background.file", "width x height pixels",
     [](Scene& s) { environment(s).pixels.pop_back(); }},
    {"Negative", "background.file", "finite numbers of 0 or above",
     [](Scene& s) { environment(s).pixels[5].b = -1; }},
    {"NaN", "background.file", "finite numbers of 0 or above",
     [](Scene& s) { environment(s).pixels[0].r = nan; }},
    {"Infinite", "background.file", "finite numbers of 0 or above",
     [](Scene& s) { environment(s).pixels[3].g = inf; }},
    {"Rotation", "background.rotation", finite, [](Scene& s) { environment(s).rotation = nan; }},
    {"RotationInfinite", "background.rotation", finite,
     [](Scene& s) { environment(s).rotation = -inf; }},
};
INSTANTIATE_TEST_SUITE_P(Environment, ValidateRefuses, testing::ValuesIn(environments), name_of);

const Breakage surroundings[] = {
    {"ConstantNegative", "background.color", not_negative,
     [](Scene& s) {
       s.background = ConstantBackground{{0, -1, 0}};
     }},
    {"BottomNaN", "background.bottom", not_negative, [](Scene& s) { gradient(s).bottom.b = nan; }},
    {"TopNegative", "background.top", not_negative, [](Scene& s) { gradient(s).top.r = -0.1f; }},
    {"UpZero", "background.up", "zero vector",
     [](Scene& s) {
       gradient(s).up = {0, 0, 0};
     }},
    {"UpInfinite", "background.up", finite, [](Scene& s) { gradient(s).up.z = inf; }},
    {"AmbientNegative", "background.ambient", not_negative, [](Scene& s) { s.ambient.g = -1; }},
    {"PointPositionNaN", "light[0].position", finite,
     [](Scene& s) { point_light(s).position.x = nan; }},
    {"PointIntensityNegative", "light[0].intensity", not_negative,
     [](Scene& s) { point_light(s).intensity.r = -1; }},
    {"SphereLightCenter", "light[2].center", finite,
     [](Scene& s) { sphere_light(s).center.z = inf; }},
    {"SphereLightRadiusZero", "light[2].radius", positive,
     [](Scene& s) { sphere_light(s).radius = 0; }},
    {"SphereLightRadiusNaN", "light[2].radius", positive,
     [](Scene& s) { sphere_light(s).radius = nan; }},
    {"SphereLightRadianceNegative", "light[2].radiance", not_negative,
     [](Scene& s) { sphere_light(s).radiance.g = -1; }},
    {"DirectionZero", "light[1].direction", "zero vector",
     [](Scene& s) {
       directional_light(s).direction = {0, 0, 0};
     }},
    {"DirectionNaN", "light[1].direction", finite,
     [](Scene& s) { directional_light(s).direction.y = nan; }},
    {"DirectionalIntensityInfinite", "light[1].intensity", not_negative,
     [](Scene& s) { directional_light(s).intensity.b = inf; }},
};
INSTANTIATE_TEST_SUITE_P(Surroundings, ValidateRefuses, testing::ValuesIn(surroundings), name_of);

const Breakage materials[] = {
    {"MatteRed", "material.matte.color", not_negative,
     [](Scene& s) { material<Matte>(s).color.r = -1; }},
    {"MatteGreen", "material.matte.color", not_negative,
     [](Scene& s) { material<Matte>(s).color.g = nan; }},
    {"MatteBlue", "material.matte.color", not_negative,
     [](Scene& s) { material<Matte>(s).color.b = inf; }},
    {"PlasticColor", "material.plastic.color", not_negative,
     [](Scene& s) { material<Plastic>(s).color.g = -1; }},
    {"PlasticSpecular", "material.plastic.specular", not_negative,
     [](Scene& s) { material<Plastic>(s).specular = -1; }},
    {"PlasticShininess", "material.plastic.shininess", not_negative,
     [](Scene& s) { material<Plastic>(s).shininess = inf; }},
    {"PlasticReflect", "material.plastic.reflect", not_negative,
     [](Scene& s) { material<Plastic>(s).reflect = nan; }},
    {"MetalColor", "material.metal.color", not_negative,
     [](Scene& s) { material<Metal>(s).color.b = -2; }},
    {"GlassColor", "material.glass.color", not_negative,
     [](Scene& s) { material<Glass>(s).color.r = nan; }},
    {"GlassIor", "material.glass.ior", positive, [](Scene& s) { material<Glass>(s).ior = 0; }},
    {"EmissiveRadiance", "material.emissive.radiance", not_negative,
     [](Scene& s) { material<Emissive>(s).radiance.g = -1; }},
    {"PhongColor", "material.phong.color", not_negative,
     [](Scene& s) { material<Phong>(s).color.g = -1; }},
    {"PhongKa", "material.phong.ka", not_negative, [](Scene& s) { material<Phong>(s).ka = -1; }},
    {"PhongKd", "material.phong.kd", not_negative, [](Scene& s) { material<Phong>(s).kd = nan; }},
    {"PhongKs", "material.phong.ks", not_negative, [](Scene& s) { material<Phong>(s).ks = -1; }},
    {"PhongShininess", "material.phong.shininess", not_negative,
     [](Scene& s) { material<Phong>(s).shininess = -1; }},
    {"PhongTransmission", "material.phong.transmission", not_negative,
     [](Scene& s) { material<Phong>(s).transmission = -1; }},
    {"GhostColor", "material.ghost.color", not_negative,
     [](Scene& s) { material<Ghost>(s).color.b = nan; }},
    {"GhostOpacity", "material.ghost.opacity", "must be from 0 to 1",
     [](Scene& s) { material<Ghost>(s).opacity = 1.1f; }},
    {"PhongIor", "material.phong.ior", positive, [](Scene& s) { material<Phong>(s).ior = -1; }},
};
INSTANTIATE_TEST_SUITE_P(Materials, ValidateRefuses, testing::ValuesIn(materials), name_of);

const Breakage primitives[] = {
    {"CenterNaN", "sphere[1].center", finite, [](Scene& s) { s.spheres[1].center.z = nan; }},
    {"RadiusZero", "sphere[0].radius", positive, [](Scene& s) { s.spheres[0].radius = 0; }},
    {"RadiusNegative", "sphere[1].radius", "is -2", [](Scene& s) { s.spheres[1].radius = -2; }},
    {"RadiusInfinite", "sphere[0].radius", positive, [](Scene& s) { s.spheres[0].radius = inf; }},
    {"SphereMaterial", "sphere[1].material", "names no material",
     [](Scene& s) { s.spheres[1].material = 7; }},
    {"PointInfinite", "plane[0].point", finite, [](Scene& s) { s.planes[0].point.x = -inf; }},
    {"NormalZero", "plane[0].normal", "zero vector",
     [](Scene& s) {
       s.planes[0].normal = {0, -0.0f, 0};
     }},
    {"NormalNaN", "plane[0].normal", finite, [](Scene& s) { s.planes[0].normal.x = nan; }},
    {"PlaneMaterial", "plane[0].material", "names no material",
     [](Scene& s) { s.planes[0].material = 0xffffffff; }},
};
INSTANTIATE_TEST_SUITE_P(Primitives, ValidateRefuses, testing::ValuesIn(primitives), name_of);

/// The other side of every limit.
const Breakage limits[] = {
    {"LargestImage", "", "",
     [](Scene& s) {
       s.image = {65535, 65535, max_count};
     }},
    {"SmallestImage", "", "",
     [](Scene& s) {
       s.image = {1, 1, 1};
     }},
    {"NoBounces", "", "", [](Scene& s) { s.render.max_depth = 0; }},
    {"DeepestRays", "", "", [](Scene& s) { s.render.max_depth = max_count; }},
    {"WidestFov", "", "", [](Scene& s) { pinhole(s).fov = std::nextafter(180.0f, 0.0f); }},
    {"NarrowestFov", "", "", [](Scene& s) { pinhole(s).fov = 0x1p-149f; }},
    {"UpJustOffTheView", "", "",
     [](Scene& s) {
       pinhole(s).pose.up = {0, 1.1e-6f, -1};
     }},
    {"TinyUp", "", "",
     [](Scene& s) {
       pinhole(s).pose.up = {0, 0x1p-149f, 0};
     }},
    {"Orthographic", "", "", [](Scene& s) { orthographic(s).height = 0x1p-149f; }},
    {"BlackConstant", "", "", [](Scene& s) { s.background = ConstantBackground{}; }},
    {"DarkMaterials", "", "",
     [](Scene& s) {
       material<Phong>(s) = {{0, 0, 0}, 0, 0, 0, 0, 0, 0x1p-149f};
     }},
    {"TinyRadius", "", "", [](Scene& s) { s.spheres[0].radius = 0x1p-149f; }},
    {"HugeRadius", "", "",
     [](Scene& s) { s.spheres[0].radius = std::numeric_limits<float>::max(); }},
    {"NoLights", "", "", [](Scene& s) { s.lights.clear(); }},
};

class ValidateAccepts : public testing::TestWithParam<Breakage> {};

TEST_P(ValidateAccepts, TheLimitsThemselves) {
  Scene scene = full_scene();
  GetParam().apply(scene);
  const Status status = validate(scene);
  EXPECT_TRUE(status) << format_diagnostic(status.error());
}
INSTANTIATE_TEST_SUITE_P(Limits, ValidateAccepts, testing::ValuesIn(limits), name_of);

TEST(Validate, NamesTheFirstOfSeveralProblems) {
  Scene scene = full_scene();
  scene.spheres[1].radius = 0;
  scene.spheres[0].radius = 0;
  scene.planes[0].normal = {0, 0, 0};
  EXPECT_EQ(validate(scene).error().key, "sphere[0].radius");
}

/// The short cut for millions of spheres is true for the same ones as what it stands for.
TEST(FindProblem, ValidSpheresAreFiniteWithPositiveRadius) {
  constexpr float max = std::numeric_limits<float>::max();
  const float numbers[] = {0, -0.0f, 1, -1, 0x1p-149f, max, -max, inf, -inf, nan, -nan};
  for (const float x : numbers) {
    for (const float y : numbers) {
      for (const float r : numbers) {
        const bool is_good = std::isfinite(x) && std::isfinite(y) && std::isfinite(r) && r > 0;
        for (const Vec3f& center : {Vec3f{x, y, 1}, Vec3f{1, x, y}, Vec3f{y, 1, x}}) {
          const Sphere sphere{center, r, 0};
          EXPECT_EQ(is_valid(sphere), is_good) << x << " " << y << " " << r;
          EXPECT_EQ(find_problem(sphere).has_value(), !is_good) << x << " " << y << " " << r;
        }
      }
    }
  }
}

TEST(Validate, CanSkipCheckedPrimitives) {
  Scene scene = full_scene();
  scene.spheres[1].radius = 0;
  scene.planes[0].normal = {0, 0, 0};
  EXPECT_TRUE(validate_all_but_primitives(scene));
  scene.image.spp = 0;
  EXPECT_EQ(validate_all_but_primitives(scene).error().key, "image.spp");
}

TEST(FindProblem, ChecksOneObject) {
  EXPECT_FALSE(find_problem(Sphere{}));
  EXPECT_FALSE(find_problem(Plane{}));
  const auto problem = find_problem(Sphere{{0, 0, 0}, -1, 0});
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->field, "radius");
  EXPECT_EQ(problem->message, "must be finite and above 0, is -1");
}

}  // namespace
}  // namespace boule::test
