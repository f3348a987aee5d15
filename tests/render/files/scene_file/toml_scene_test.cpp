#include <limits>

#include "tests/render/files/scene_file/scene_dump.h"
#include "tests/render/files/scene_file/scene_folder.h"

// TOML files that are right: the Scene is exactly what they say.

namespace boule::toml_scene {
namespace {

using test::dump;
using test::SceneFolder;

Scene load(const std::string& text) {
  auto loaded = SceneFolder{}.load("scene.toml", text);
  if (!loaded) throw std::runtime_error(format_diagnostic(loaded.error()));
  EXPECT_TRUE(loaded.value().warnings.empty());
  return std::move(loaded).value().scene;
}

TEST(TomlScene, SchemaAloneGivesTheDefaults) {
  EXPECT_EQ(dump(load("schema = 1\n")), dump(Scene{}));
}

TEST(TomlScene, TheDocumentedExample) {
  const Scene scene = load(R"(schema = 1
[image]
size = [1280, 720]
spp = 16
[camera]                      # a comment
type = "pinhole"
eye = [0.0, 1.5, 6.0]
look_at = [0.0, 1.0, 0.0]
up = [0.0, 1.0, 0.0]
fov = 40.0
[background]
type = "constant"
color = [0.2, 0.3, 0.5]
[material.red]
type = "plastic"
color = [0.8, 0.1, 0.1]
[[light]]
type = "point"
position = [4.0, 6.0, 4.0]
intensity = [1.0, 1.0, 1.0]
[[sphere]]
center = [0.0, 1.0, 0.0]
radius = 1.0
material = "red"
[[plane]]
point = [0.0, 0.0, 0.0]
normal = [0.0, 1.0, 0.0]
material = "red"
[render]
method = "whitted"
max_depth = 5
)");
  Scene expected;
  expected.image = {1280, 720, 16};
  expected.camera = PinholeCamera{{{0, 1.5f, 6}, {0, 1, 0}, {0, 1, 0}}, 40, FovAxis::x};
  expected.background = ConstantBackground{{0.2f, 0.3f, 0.5f}};
  expected.materials = {{"red", Plastic{{0.8f, 0.1f, 0.1f}}}};
  expected.lights = {PointLight{{4, 6, 4}}};
  expected.spheres = {{{0, 1, 0}, 1, 0}};
  expected.planes = {{{0, 0, 0}, {0, 1, 0}, 0}};
  EXPECT_EQ(dump(scene), dump(expected));
}

const char* const every_key = R"(schema = 1
image = {size = [1, 65535], spp = 2147483647, filter = "tent"}
render = {max_depth = 0, method = "path"}
[camera]
type = "orthographic"
eye = [1, 2, 3]
look_at = [4, 5, 7]
up = [0, 0, 1]
height = 0.25
[background]
type = "gradient"
bottom = [0.1, 0.2, 0.3]
top = [1, 2, 3]
up = [0, 0, 2]
ambient = [0.5, 0.25, 0.125]
[material.z]
type = "matte"
color = [0.1, 0.2, 0.3]
[material.y]
type = "plastic"
specular = 0.5
shininess = 7
reflect = 0.25
[material.x]
type = "metal"
color = [1, 0.5, 0.25]
[material."a.b c"]
type = "glass"
ior = 1.33
color = [0.9, 1, 0.9]
[material.w]
type = "emissive"
radiance = [10, 20, 30]
[material.v]
type = "phong"
color = [0.5, 0.5, 0.5]
ka = 0.1
kd = 0.7
ks = 0.2
shininess = 30
transmission = 0.3
ior = 1.5
[[light]]
type = "point"
position = [1, 2, 3]
intensity = [4, 5, 6]
falloff = "inverse_square"
[[light]]
type = "directional"
direction = [0, -1, 1]
intensity = [0.5, 0.5, 0.5]
[[light]]
type = "sphere"
center = [7, 8, 9]
radius = 0.25
radiance = [10, 11, 12]
[[plane]]
point = [1, 2, 3]
normal = [0, 0, 4]
material = "a.b c"
[[sphere]]
material = "v"
)";

TEST(TomlScene, EveryKeyOfEveryType) {
  const Scene scene = load(every_key);
  Scene expected;
  expected.image = {1, 65535, 2147483647, PixelFilter::tent};
  expected.render = {0, Method::path};
  expected.camera = OrthographicCamera{{{1, 2, 3}, {4, 5, 7}, {0, 0, 1}}, 0.25f};
  expected.background = GradientBackground{{0.1f, 0.2f, 0.3f}, {1, 2, 3}, {0, 0, 2}};
  expected.ambient = {0.5f, 0.25f, 0.125f};
  expected.materials = {{"z", Matte{{0.1f, 0.2f, 0.3f}}},
                        {"y", Plastic{{0.8f, 0.8f, 0.8f}, 0.5f, 7, 0.25f}},
                        {"x", Metal{{1, 0.5f, 0.25f}}},
                        {"a.b c", Glass{{0.9f, 1, 0.9f}, 1.33f}},
                        {"w", Emissive{{10, 20, 30}}},
                        {"v", Phong{{0.5f, 0.5f, 0.5f}, 0.1f, 0.7f, 0.2f, 30, 0.3f, 1.5f}}};
  expected.lights = {PointLight{{1, 2, 3}, {4, 5, 6}, Falloff::inverse_square},
                     DirectionalLight{{0, -1, 1}, {0.5f, 0.5f, 0.5f}},
                     SphereLight{{7, 8, 9}, 0.25f, {10, 11, 12}}};
  expected.spheres = {{{0, 0, 0}, 1, 5}};
  expected.planes = {{{1, 2, 3}, {0, 0, 4}, 3}};
  EXPECT_EQ(dump(scene), dump(expected));
}

TEST(TomlScene, TypesHaveDefaults) {
  const Scene scene = load(R"(schema = 1
[camera]
eye = [0, 0, 5]
look_at = [0, 0, 0]
[background]
[material.m]
[[light]]
)");
  Scene expected;
  expected.camera = PinholeCamera{{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}}, 45, FovAxis::x};
  expected.materials = {{"m", Matte{}}};
  expected.lights = {PointLight{}};
  EXPECT_EQ(dump(scene), dump(expected));
}

TEST(TomlScene, FovAxes) {
  const std::string camera = "schema = 1\n[camera]\neye = [0,0,5]\nlook_at = [0,0,0]\nfov_axis = ";
  EXPECT_EQ(std::get<PinholeCamera>(*load(camera + "\"x\"").camera).fov_axis, FovAxis::x);
  EXPECT_EQ(std::get<PinholeCamera>(*load(camera + "\"y\"").camera).fov_axis, FovAxis::y);
  EXPECT_EQ(std::get<PinholeCamera>(*load(camera + "\"max\"").camera).fov_axis, FovAxis::max);
}

TEST(TomlScene, FittedCamera) {
  const std::string fitted = "schema = 1\n[camera]\nfit = true\n";
  EXPECT_FALSE(load(fitted).camera);
  EXPECT_EQ(load(fitted).fit, CameraFit{});
  const CameraFit all{FittedCamera::pinhole, Vec3f{1, 2, 3}, Vec3f{0, 0, 1}, 20,
                      FovAxis::max,          0.25f};
  EXPECT_EQ(load(fitted + "direction = [1, 2, 3]\nup = [0, 0, 1]\nfov = 20\nfov_axis = \"max\"\n"
                          "margin = 0.25\n")
                .fit,
            all);
  EXPECT_EQ(load(fitted + "type = \"orthographic\"\n").fit.type, FittedCamera::orthographic);
  EXPECT_TRUE(
      load("schema = 1\n[camera]\nfit = false\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n").camera);
}

TEST(TomlScene, RoundCameras) {
  const std::string start = "schema = 1\n[camera]\neye = [0,0,5]\nlook_at = [0,0,0]\ntype = ";
  const CameraPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  const auto expect = [&](const std::string& text, const Camera& camera) {
    Scene expected;
    expected.camera = camera;
    EXPECT_EQ(dump(load(start + text)), dump(expected)) << text;
  };
  expect("\"fisheye\"", FisheyeCamera{pose, 180, FovAxis::x});
  expect("\"fisheye\"\nfov = 360\nfov_axis = \"max\"", FisheyeCamera{pose, 360, FovAxis::max});
  expect("\"thin_lens\"\naperture = 0", ThinLensCamera{pose, 45, FovAxis::x, 0, {}});
  expect("\"thin_lens\"\naperture = 0.5\nfov = 30\nfov_axis = \"y\"\nfocus = 7",
         ThinLensCamera{pose, 30, FovAxis::y, 0.5f, 7.0f});
  expect("\"thin_lens\"\naperture = 0.5\nfocus = [9, 9, 3]",
         ThinLensCamera{pose, 45, FovAxis::x, 0.5f, 2.0f});
  expect("\"thin_lens\"\nf_number = 2\nfocal_length = 0.05",
         ThinLensCamera{pose, 45, FovAxis::x, 0.0125f, {}});
}

TEST(TomlScene, LensesComeFromFiles) {
  const test::SceneFolder files;
  static_cast<void>(files.write("two.lens", "# glass\n\n 50 5.5 1.5\t20 # front\r\n-50 0 1 21"));
  const auto loaded = files.load("scene.toml", R"(schema = 1
[camera]
type = "lens"
eye = [0, 0, 5]
look_at = [0, 0, 0]
file = "two.lens"
film_width = 24
scale = 0.01
focus = [1, 1, 2]
)");
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  Scene expected;
  expected.camera = LensCamera{
      {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}}, {{50, 5.5f, 1.5f, 20}, {-50, 0, 1, 21}}, 24, 0.01f, 3.0f};
  EXPECT_EQ(dump(loaded.value().scene), dump(expected));
}

constexpr const char* five_surfaces =
    " 50 5 1.5 20\n-50 2 1 20\n0 3 1 8\n-200 2 1.5 20\n-60 0 1 20\n";

TEST(TomlScene, AnFNumberNarrowsALensStop) {
  const test::SceneFolder files;
  static_cast<void>(files.write("five.lens", five_surfaces));
  const auto lens = [&](const std::string& keys) {
    const auto loaded = files.load("scene.toml",
                                   "schema = 1\n[camera]\ntype = \"lens\"\neye = [0, 0, 5]\n"
                                   "look_at = [0, 0, 0]\nfile = \"five.lens\"\n" +
                                       keys);
    EXPECT_TRUE(loaded) << format_diagnostic(loaded.error());
    return std::get<LensCamera>(*loaded.value().scene.camera);
  };
  const LensCamera open = lens(""), f16 = lens("f_number = 16"), f32 = lens("f_number = 32.0");
  EXPECT_EQ(open.surfaces[2].aperture, 8);
  EXPECT_EQ(f16.surfaces[2].aperture, 2 * f32.surfaces[2].aperture);
  // Through the first two surfaces from the height 1, by the thick lens' formulas.
  const double power = 0.5 / 50, lens_power = 2 * power - power * power * 5 / 1.5;
  const double behind = 1 - power * 5 / 1.5, at_stop = behind - 2 * lens_power;
  EXPECT_NEAR(static_cast<double>(f16.surfaces[2].aperture),
              at_stop * focal_length(open.surfaces) / 16, 1e-5);
  for (std::size_t i : {0U, 1U, 3U, 4U}) EXPECT_EQ(f16.surfaces[i].aperture, 20) << i;
}

TEST(TomlScene, UnreachableFNumberIsRefused) {
  const test::SceneFolder files;
  static_cast<void>(files.write("five.lens", five_surfaces));
  static_cast<void>(files.write("none.lens", "50 5 1.5 20\n-50 0 1 20\n"));
  static_cast<void>(files.write("two.lens", "0 1 1 9\n50 5 1.5 20\n-50 2 1 20\n0 0 1 9\n"));
  static_cast<void>(files.write("flat.lens", "50 5 1.5 20\n0 0 1 20\n"));
  const auto expect = [&](const std::string& lens, const std::string& value,
                          const std::string& words) {
    const auto loaded = files.load("scene.toml",
                                   "schema = 1\n[camera]\ntype = \"lens\"\neye = [0, 0, 5]\n"
                                   "look_at = [0, 0, 0]\nfile = \"" +
                                       lens + ".lens\"\nf_number = " + value + "\n");
    ASSERT_FALSE(loaded) << lens << " " << value;
    EXPECT_EQ(loaded.error().key, "camera.f_number");
    EXPECT_EQ(loaded.error().line, 7);
    EXPECT_EQ(loaded.error().column, 12);
    EXPECT_THAT(loaded.error().message, testing::HasSubstr(words));
  };
  expect("five", "\"f/8\"", "expected a number, got a string");
  for (const char* value : {"0", "-8", "inf", "nan"}) expect("five", value, "finite and above 0");
  for (const char* value : {"1.0", "1e30"}) expect("five", value, "wide open to ");
  for (const char* lens : {"none", "two", "flat"}) expect(lens, "8", "must have one stop");
}

TEST(TomlScene, DefaultMaterialIsMatteDarkerForPlanes) {
  const Scene scene = load(R"(schema = 1
[[plane]]
[[sphere]]
[material.red]
[[sphere]]
material = "red"
)");
  Scene expected;
  expected.materials = {
      {"red", Matte{}}, {"default", Matte{}}, {"default plane", Matte{gray(0.45f)}}};
  expected.spheres = {{{0, 0, 0}, 1, 1}, {{0, 0, 0}, 1, 0}};
  expected.planes = {{{0, 0, 0}, {0, 1, 0}, 2}};
  EXPECT_EQ(dump(scene), dump(expected));
}

TEST(TomlScene, NumbersAreRoundedToFloatOnce) {
  const auto x = [](const std::string& number) {
    return load("schema = 1\norigin = [0, 0, 0]\n[[sphere]]\ncenter = [" + number + ", 0, 0]\n")
        .spheres[0]
        .center.x;
  };
  EXPECT_EQ(x("0.1"), 0.1f);
  EXPECT_EQ(x("16777217"), 16777216.0f);
  EXPECT_EQ(x("9223372036854775807"), 0x1p63f);
  EXPECT_EQ(x("0x10"), 16.0f);
  EXPECT_EQ(x("1_000.5"), 1000.5f);
  EXPECT_EQ(x("3.4028235677973362e38"), std::numeric_limits<float>::max());
  EXPECT_EQ(x("-3.4028235677973362e38"), -std::numeric_limits<float>::max());
  EXPECT_EQ(x("1e-40"), 1e-40f);
  EXPECT_EQ(x("1e-46"), 0.0f);
  EXPECT_EQ(x("1e-400"), 0.0f);
}

TEST(TomlScene, ByteOrderMarkAndDosLineEnds) {
  const Scene scene = load("\xef\xbb\xbfschema = 1\r\n[image]\r\nspp = 4\r\n");
  EXPECT_EQ(scene.image.spp, 4);
}

TEST(TomlScene, DottedKeysAndInlineTables) {
  const Scene scene = load(
      "schema = 1\nmaterial.a.type = \"metal\"\nmaterial.a.color = [1, 1, 1]\n"
      "sphere = [{radius = 2, material = \"a\"}, {radius = 3}]\nlight = []\n");
  Scene expected;
  expected.materials = {{"a", Metal{{1, 1, 1}}}, {"default", Matte{}}};
  expected.spheres = {{{0, 0, 0}, 2, 0}, {{0, 0, 0}, 3, 1}};
  EXPECT_EQ(dump(scene), dump(expected));
}

TEST(TomlScene, DeepKeysAreRefusedAtAnyLength) {
  std::string key = "a";
  for (int i = 0; i < 1000000; ++i) key += ".a";
  for (const std::string& text : {key + " = 1\n", "[" + key + "]\n"}) {
    const auto loaded = SceneFolder{}.load("scene.toml", text);
    ASSERT_FALSE(loaded.ok());
    EXPECT_THAT(loaded.error().message, testing::HasSubstr("at most 32 dotted parts"));
    EXPECT_EQ(loaded.error().line, 1);
  }
}

TEST(TomlScene, NamesBeyondAscii) {
  const Scene scene = load(
      "schema = 1 # gr\xc3\xbcn\n[material.\"gr\xc3\xbcn\"]\n"
      "[[sphere]]\nmaterial = 'gr\xc3\xbcn'\n");
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].name, "gr\xc3\xbcn");
}

TEST(TomlScene, DotsElsewhereMakeNoKeys) {
  std::string dots(100, '.'), list = "[[0.5, 0.5, 0.5]";
  for (int i = 0; i < 40; ++i) list += ", [0.5, 0.5, 0.5]";
  const std::string text = "# " + dots + "\nschema = 1\n[material.\"" + dots + "\"]\n[material.'" +
                           dots + "\\']\n[image]\nsize = " + list + "]\n";
  const auto loaded = SceneFolder{}.load("scene.toml", text);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().message, "expected an array of 2 integers, got 41");
}

}  // namespace
}  // namespace boule::toml_scene
