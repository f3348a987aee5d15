// Every field of a camera and of what is before it, broken in turn: validate() must name it.
#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "tests/core/scene/broken_scene.h"

namespace boule::test::camera_fields {
namespace {

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
  EXPECT_TRUE(validate(scene));
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

}  // namespace
}  // namespace boule::test::camera_fields
