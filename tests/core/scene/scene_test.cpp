#include "core/scene/scene.h"

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <stdexcept>

#include <gtest/gtest.h>

// Every field of a scene, broken in turn: validate() must name it.

namespace boule {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// One of everything, all of it valid.
Scene full_scene() {
  Scene scene;
  scene.camera = PinholeCamera{{{0, 1, 6}, {0, 1, 0}, {0, 1, 0}}, 40, FovAxis::x};
  scene.background = GradientBackground{};
  scene.materials = {{"matte", Matte{}}, {"plastic", Plastic{}},   {"metal", Metal{}},
                     {"glass", Glass{}}, {"emissive", Emissive{}}, {"phong", Phong{}}};
  scene.lights = {PointLight{{4, 6, 4}, {1, 1, 1}, Falloff::none}, DirectionalLight{},
                  SphereLight{}};
  scene.spheres = {{{0, 1, 0}, 1, 0}, {{2, 1, 0}, 0.5f, 5}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 1}};
  return scene;
}

PinholeCamera& pinhole(Scene& scene) { return std::get<PinholeCamera>(*scene.camera); }
OrthographicCamera& orthographic(Scene& scene) {
  scene.camera = OrthographicCamera{pinhole(scene).pose, 2};
  return std::get<OrthographicCamera>(*scene.camera);
}
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

TEST(Validate, AcceptsAFullScene) { EXPECT_FALSE(validate(full_scene())); }
TEST(Validate, AcceptsAnEmptyScene) { EXPECT_FALSE(validate(Scene{})); }

/// A way to break a scene, the key that must be named and a part of the message.
struct Breakage {
  const char* name;
  const char* key;
  const char* message;
  std::function<void(Scene&)> apply;
};

std::ostream& operator<<(std::ostream& out, const Breakage& b) { return out << b.name; }

class ValidateRefuses : public testing::TestWithParam<Breakage> {};

TEST_P(ValidateRefuses, AndNamesTheKey) {
  Scene scene = full_scene();
  GetParam().apply(scene);
  const Status status = validate(scene);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->key, GetParam().key);
  EXPECT_NE(status->message.find(GetParam().message), std::string::npos) << status->message;
}

std::string name_of(const testing::TestParamInfo<Breakage>& info) { return info.param.name; }

constexpr char not_negative[] = "must be finite and 0 or above";
constexpr char positive[] = "must be finite and above 0";
constexpr char finite[] = "must be finite";

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

const Breakage camera[] = {
    {"EyeNaN", "camera.eye", finite, [](Scene& s) { pinhole(s).pose.eye.y = nan; }},
    {"EyeInfinite", "camera.eye", finite, [](Scene& s) { pinhole(s).pose.eye.x = inf; }},
    {"LookAtNaN", "camera.look_at", finite, [](Scene& s) { pinhole(s).pose.look_at.z = nan; }},
    {"LookAtIsEye", "camera.look_at", "must differ from eye",
     [](Scene& s) { pinhole(s).pose.look_at = pinhole(s).pose.eye; }},
    {"UpNaN", "camera.up", finite, [](Scene& s) { pinhole(s).pose.up.x = nan; }},
    {"UpZero", "camera.up", "zero vector",
     [](Scene& s) {
       pinhole(s).pose.up = {0, 0, 0};
     }},
    {"UpAlongView", "camera.up", "1e-6",
     [](Scene& s) {
       pinhole(s).pose.up = {0, 0, -3};
     }},
    {"UpAgainstView", "camera.up", "1e-6",
     [](Scene& s) {
       pinhole(s).pose.up = {0, 0, 2};
     }},
    {"UpNearView", "camera.up", "1e-6",
     [](Scene& s) {
       pinhole(s).pose.up = {0, 9e-7f, -1};
     }},
    {"FovZero", "camera.fov", "is 0", [](Scene& s) { pinhole(s).fov = 0; }},
    {"FovNegative", "camera.fov", "is -5", [](Scene& s) { pinhole(s).fov = -5; }},
    {"FovHalfTurn", "camera.fov", "is 180", [](Scene& s) { pinhole(s).fov = 180; }},
    {"FovNaN", "camera.fov", "180 degrees", [](Scene& s) { pinhole(s).fov = nan; }},
    {"HeightZero", "camera.height", positive, [](Scene& s) { orthographic(s).height = 0; }},
    {"HeightInfinite", "camera.height", positive, [](Scene& s) { orthographic(s).height = inf; }},
    {"OrthographicUpZero", "camera.up", "zero vector",
     [](Scene& s) {
       orthographic(s).pose.up = {0, 0, 0};
     }},
};
FisheyeCamera& fisheye(Scene& scene) {
  scene.camera = FisheyeCamera{pinhole(scene).pose};
  return std::get<FisheyeCamera>(*scene.camera);
}
ThinLensCamera& thin_lens(Scene& scene) {
  scene.camera = ThinLensCamera{pinhole(scene).pose};
  return std::get<ThinLensCamera>(*scene.camera);
}

const Breakage round_cameras[] = {
    {"FisheyeFovZero", "camera.fov", "is 0", [](Scene& s) { fisheye(s).fov = 0; }},
    {"FisheyeFovNaN", "camera.fov", "360 degrees", [](Scene& s) { fisheye(s).fov = nan; }},
    {"FisheyeFovTooLarge", "camera.fov", "is 361", [](Scene& s) { fisheye(s).fov = 361; }},
    {"FisheyeUpZero", "camera.up", "zero vector",
     [](Scene& s) {
       fisheye(s).pose.up = {0, 0, 0};
     }},
    {"LensFov", "camera.fov", "is 180", [](Scene& s) { thin_lens(s).fov = 180; }},
    {"ApertureNegative", "camera.aperture", not_negative,
     [](Scene& s) { thin_lens(s).aperture = -1; }},
    {"ApertureInfinite", "camera.aperture", not_negative,
     [](Scene& s) { thin_lens(s).aperture = inf; }},
    {"FocusZero", "camera.focus", positive, [](Scene& s) { thin_lens(s).focus = 0.0f; }},
    {"FocusNaN", "camera.focus", positive, [](Scene& s) { thin_lens(s).focus = nan; }},
};
DistortionMap& distortion(Scene& scene) {
  scene.distortion = DistortionMap{2, 3, std::vector<float>(12, 0.5f)};
  return *scene.distortion;
}

const Breakage distortions[] = {
    {"OneColumn", "camera.distortion.file", "2 x 2 pixels or more, has 1 x 3",
     [](Scene& s) { distortion(s).width = 1; }},
    {"NoRows", "camera.distortion.file", "has 2 x 0", [](Scene& s) { distortion(s).height = 0; }},
    {"TooFew", "camera.distortion.file", "two numbers a pixel",
     [](Scene& s) { distortion(s).st.pop_back(); }},
    {"NaN", "camera.distortion.file", finite, [](Scene& s) { distortion(s).st[7] = nan; }},
};
INSTANTIATE_TEST_SUITE_P(Distortion, ValidateRefuses, testing::ValuesIn(distortions), name_of);

LensCamera& lens(Scene& scene) {
  LensCamera two_faces{pinhole(scene).pose, {{50, 5, 1.5f, 20}, {0, 1, 1, 10}, {-50, 0, 1, 20}}};
  scene.camera = two_faces;
  return std::get<LensCamera>(*scene.camera);
}

TEST(Validate, AcceptsALens) {
  Scene scene = full_scene();
  lens(scene);
  EXPECT_FALSE(validate(scene));
}

const Breakage lenses[] = {
    {"FilmWidth", "camera.film_width", positive, [](Scene& s) { lens(s).film_width = 0; }},
    {"Scale", "camera.scale", positive, [](Scene& s) { lens(s).scale = nan; }},
    {"LensFocus", "camera.focus", positive, [](Scene& s) { lens(s).focus = -1.0f; }},
    {"NoSurfaces", "camera.file", "must have surfaces", [](Scene& s) { lens(s).surfaces = {}; }},
    {"Radius", "camera.file", "surface 1: its radius must be finite",
     [](Scene& s) { lens(s).surfaces[0].radius = nan; }},
    {"Thickness", "camera.file", "surface 2: its thickness must be finite and 0 or above",
     [](Scene& s) { lens(s).surfaces[1].thickness = -1; }},
    {"Index", "camera.file", "surface 3: its index must be from 0.25 to 8, is 0",
     [](Scene& s) { lens(s).surfaces[2].index = 0; }},
    {"IndexOfNoMedium", "camera.file", "surface 1: its index must be from 0.25 to 8, is 0.1875",
     [](Scene& s) { lens(s).surfaces[0].index = 0.1875f; }},
    {"IndexNaN", "camera.file", "surface 2: its index must be from 0.25 to 8",
     [](Scene& s) { lens(s).surfaces[1].index = nan; }},
    {"Aperture", "camera.file", "surface 1: its aperture must be finite and above 0",
     [](Scene& s) { lens(s).surfaces[0].aperture = 0; }},
    {"TooWide", "camera.file", "surface 1: its aperture is wider than its sphere",
     [](Scene& s) { lens(s).surfaces[0].aperture = 101; }},
    {"TooNarrow", "camera.file", "surface 2: its aperture is less than a 500th of the last one's",
     [](Scene& s) { lens(s).surfaces[1].aperture = 0.039f; }},
    {"Diverging", "camera.file", "must gather light",
     [](Scene& s) {
       lens(s).surfaces = {{-50, 5, 1.5f, 20}, {50, 0, 1, 20}};
     }},
    // Its picture lies 0.01 behind a lens 100,000,000 long: of the last surface, 20 wide, a ten
    // billionth sends light to the middle.
    {"DarkMiddle", "camera.file", "no light to the middle of the film",
     [](Scene& s) {
       LensCamera& long_one = lens(s);
       long_one.surfaces = {
           {0, 5, 1.5f, 20}, {-5e7f, 99999992, 1, 20}, {0, 7.99f, 1, 20}, {0, 0, 1, 20}};
       long_one.scale = 1e-30f;
     }},
    {"TooNear", "camera.focus", "nearer than the lens can be focused",
     [](Scene& s) { lens(s).focus = 0.01f; }},
};
INSTANTIATE_TEST_SUITE_P(Lens, ValidateRefuses, testing::ValuesIn(lenses), name_of);

INSTANTIATE_TEST_SUITE_P(RoundCameras, ValidateRefuses, testing::ValuesIn(round_cameras), name_of);

INSTANTIATE_TEST_SUITE_P(Camera, ValidateRefuses, testing::ValuesIn(camera), name_of);

TEST(Validate, AcceptsAnEnvironment) {
  Scene scene = full_scene();
  environment(scene).pixels[2] = {3e38f, 3e38f, 3e38f};
  EXPECT_FALSE(validate(scene));
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
    {"PhongIor", "material.phong.ior", positive, [](Scene& s) { material<Phong>(s).ior = -1; }},
};
INSTANTIATE_TEST_SUITE_P(Materials, ValidateRefuses, testing::ValuesIn(materials), name_of);

const Breakage primitives[] = {
    {"CenterNaN", "sphere[1].center", finite, [](Scene& s) { s.spheres[1].center.z = nan; }},
    {"RadiusZero", "sphere[0].radius", positive, [](Scene& s) { s.spheres[0].radius = 0; }},
    {"RadiusNegative", "sphere[1].radius", "is -2", [](Scene& s) { s.spheres[1].radius = -2; }},
    {"RadiusInfinite", "sphere[0].radius", positive, [](Scene& s) { s.spheres[0].radius = inf; }},
    {"SphereMaterial", "sphere[1].material", "names no material",
     [](Scene& s) { s.spheres[1].material = 6; }},
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

TEST_P(ValidateAccepts, TheLimitItself) {
  Scene scene = full_scene();
  GetParam().apply(scene);
  const Status status = validate(scene);
  EXPECT_FALSE(status) << format_diagnostic(*status);
}
INSTANTIATE_TEST_SUITE_P(Limits, ValidateAccepts, testing::ValuesIn(limits), name_of);

TEST(Validate, NamesTheFirstOfSeveral) {
  Scene scene = full_scene();
  scene.spheres[1].radius = 0;
  scene.spheres[0].radius = 0;
  scene.planes[0].normal = {0, 0, 0};
  EXPECT_EQ(validate(scene)->key, "sphere[0].radius");
}

/// The short cut for millions of spheres is true for the same ones as what it stands for.
TEST(FindProblem, ValidSpheresAreThoseWithFiniteNumbersAndARadius) {
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

TEST(Validate, LeavesPrimitivesToReadersThatHaveCheckedThem) {
  Scene scene = full_scene();
  scene.spheres[1].radius = 0;
  scene.planes[0].normal = {0, 0, 0};
  EXPECT_FALSE(validate_all_but_primitives(scene));
  scene.image.spp = 0;
  EXPECT_EQ(validate_all_but_primitives(scene)->key, "image.spp");
}

TEST(FindProblem, SpeaksOfOneThingByItself) {
  EXPECT_FALSE(find_problem(Sphere{}));
  EXPECT_FALSE(find_problem(Plane{}));
  const auto problem = find_problem(Sphere{{0, 0, 0}, -1, 0});
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->field, "radius");
  EXPECT_EQ(problem->message, "must be finite and above 0, is -1");
}

}  // namespace
}  // namespace boule
