#include "core/scene/camera.h"
#include "core/scene/field.h"
#include "render/files/file/nearest_name.h"
#include "tests/render/files/scene_file/scene_folder.h"

// TOML files that are wrong: each is refused at its line and column, with its key.

namespace boule::toml_errors {
namespace {

using test::Refusal;

class TomlErrors : public testing::TestWithParam<Refusal> {};

TEST_P(TomlErrors, AreRefusedWithPlaceAndKey) { test::expect_refused(GetParam(), "scene.toml"); }

/// `text` after the line that every scene begins with.
std::string scene(const std::string& text) { return "schema = 1\n" + text; }
std::string camera(const std::string& text) {
  return scene("[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n" + text);
}
/// Every type of camera, the first of which is the default.
std::string camera_types() { return list_names({names<Camera>.begin(), names<Camera>.end()}); }
std::string material(const std::string& type, const std::string& text) {
  return scene("[material.red]\ntype = \"" + type + "\"\n" + text);
}

const Refusal whole[] = {
    {"EmptyFile", "", 1, 1, "schema", "the scene is empty: begin with schema = 1"},
    {"OnlyComments", "# a\n\n# b\n", 1, 1, "schema", "the scene is empty: begin with schema = 1"},
    {"NoSchema", "[image]\n", 1, 1, "schema", "missing key 'schema': write schema = 1"},
    {"OtherSchema", "schema = 2\n", 1, 10, "schema", "must be 1, is 2"},
    {"SchemaType", "schema = 1.0\n", 1, 10, "schema", "expected an integer, got a number"},
    {"SchemaSlip", "shcema = 1\n", 1, 1, "shcema", "did you mean 'schema'?"},
    {"UnknownSection", scene("[camra]\n"), 2, 2, "camra", "did you mean 'camera'?"},
    {"UnknownFarKey", scene("whatever = 1\n"), 2, 1, "whatever",
     "unknown key 'whatever', expected 'schema', 'image', 'camera'"},
    {"SectionNoTable", scene("camera = 5\n"), 2, 10, "camera", "expected a table, got an integer"},
    {"ListNoArray", scene("[light]\n"), 2, 1, "light", "under a header [[light]], got a table"},
    {"ListOfNumbers", scene("sphere = [1]\n"), 2, 11, "sphere[0]", "got an integer"},
    {"MaterialNoTable", scene("[material]\nred = 1\n"), 3, 7, "material.red", "expected a table"},
    {"MaterialList", scene("[[material]]\n"), 2, 1, "material", "expected a table, got an array"},
    {"ControlBytesInKey", scene("\"a\\u001b\" = 1\n"), 2, 1, "a\\x1b", "unknown key 'a\\x1b'"},
    {"LongKey", scene(std::string(200, 'k') + " = 1\n"), 2, 1,
     "kkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkk...", "unknown key"},
};
INSTANTIATE_TEST_SUITE_P(Whole, TomlErrors, testing::ValuesIn(whole), test::refusal_name);

const Refusal fitted[] = {
    {"EyeBesideFit", scene("[camera]\nfit = true\neye = [0, 0, 5]\n"), 4, 7, "camera.eye",
     "cannot stand beside 'fit'"},
    {"LookAtBesideFit", scene("[camera]\nlook_at = [0, 0, 5]\nfit = true\n"), 3, 11,
     "camera.look_at", "cannot stand beside 'fit'"},
    {"KeysBesideFit", scene("[camera]\nfit = true\n[[camera.key]]\nframe = 1\nfov = 30\n"), 2, 1,
     "camera.key", "cannot stand beside 'fit'"},
    {"FitNumber", scene("[camera]\nfit = 1\n"), 3, 7, "camera.fit",
     "expected true or false, got an integer"},
    {"FisheyeFit", scene("[camera]\nfit = true\ntype = \"fisheye\"\n"), 4, 8, "camera.type",
     "'pinhole' or 'orthographic'"},
    {"FovOfOrthographicFit", scene("[camera]\nfit = true\ntype = \"orthographic\"\nfov = 20\n"), 5,
     7, "camera.fov", "an orthographic camera has none"},
    {"HalfMargin", scene("[camera]\nfit = true\nmargin = 0.5\n"), 4, 10, "camera.margin",
     "must be"},
    {"NoPictureLeft", scene("[camera]\nfit = true\nmargin = 0.3\nroom = 0.4\n"), 5, 8,
     "camera.room", "must leave some of the picture"},
    {"NoDirection", scene("[camera]\nfit = true\ndirection = [0, 0, 0]\n"), 4, 13,
     "camera.direction", "must not be the zero vector"},
    {"UpAlongDirection", scene("[camera]\nfit = true\ndirection = [0, 0, -1]\nup = [0, 0, 1]\n"), 5,
     6, "camera.up", "must not be within 1e-6 rad"},
    {"FitSlip", scene("[camera]\nfit = true\nmargins = 0.1\n"), 4, 1, "camera.margins",
     "did you mean 'margin'?"},
};
INSTANTIATE_TEST_SUITE_P(Fitted, TomlErrors, testing::ValuesIn(fitted), test::refusal_name);

const Refusal overlays[] = {
    {"OverlaySlip", scene("[image]\noverlay = [\"scale\", \"lgend\"]\n"), 3, 11, "image.overlay",
     "unknown 'lgend', expected 'legend', 'scale', 'axes' or 'time'; did you mean 'legend'?"},
    {"OverlayTwice", scene("[image]\noverlay = [\"scale\", \"scale\"]\n"), 3, 11, "image.overlay",
     "must have each name once"},
    {"OverlayText", scene("[image]\noverlay = \"scale\"\n"), 3, 11, "image.overlay",
     "expected an array"},
};
INSTANTIATE_TEST_SUITE_P(Overlays, TomlErrors, testing::ValuesIn(overlays), test::refusal_name);

const Refusal syntax[] = {
    {"Garbage", scene("[image]\nspp = = 1\n"), 3, 7, "image.spp", "not valid TOML"},
    {"NameGivenTwice", scene("[image]\nspp = 1\nspp = 2\n"), 4, 7, "image.spp",
     "cannot redefine existing integer 'spp'"},
    {"MaterialGivenTwice", scene("[material.red]\n[material.red]\n"), 3, 1, "material.red",
     "cannot redefine existing table 'material.red'"},
    {"SectionGivenTwice", scene("[camera]\n[camera]\n"), 3, 1, "camera", "cannot redefine"},
    {"InListEntry", scene("[[sphere]]\n[[sphere]]\nradius = x\n"), 4, 10, "sphere[1].radius",
     "not valid TOML"},
    {"NumberBeyondDouble", camera("fov = 1e400\n"), 5, 7, "camera.fov", "'1e400'"},
    {"NumberBeyondInt64", scene("[image]\nspp = 99999999999999999999\n"), 3, 7, "image.spp",
     "not representable in 64 bits"},
    {"InvalidUtf8", scene("a = \"\xff\"\n"), 2, 5, "a", "utf-8"},
    {"BeyondAscii", scene("[image]\nspp = 4\xc3\xa9\n"), 3, 8, "image.spp",
     "only strings and comments"},
    {"BareKeyBeyondAscii", scene("gr\xc3\xbcn = 1\n"), 2, 3, "gr\xc3\xbcn", "only strings"},
    {"StringBehindValue", scene("a = 1\"\xc3\xa9\"\n"), 2, 6, "a", "a string cannot begin here"},
    {"MultiLineString", scene("a = \"\"\"b\"\"\"\n"), 2, 5, "a", "multi-line strings are not"},
    {"MultiLineLiteral", scene("a = \'\'\'b\'\'\'\n"), 2, 5, "a", "multi-line strings are not"},
    {"EscapedQuote", scene("a = \"\\\"\xc3\xa9\" \xc3\xa9\n"), 2, 12, "a", "only strings"},
    {"TableNameAt", scene("[@a]\n"), 2, 2, "@a", "bare key starting character"},
    {"EndsInString", scene("a = \"b\n"), 2, 7, "a", "not valid TOML"},
};
INSTANTIATE_TEST_SUITE_P(Syntax, TomlErrors, testing::ValuesIn(syntax), test::refusal_name);

const Refusal settings[] = {
    {"SizeOne", scene("[image]\nsize = [640]\n"), 3, 8, "image.size",
     "expected an array of 2 integers, got 1"},
    {"SizeThree", scene("[image]\nsize = [1, 2, 3]\n"), 3, 8, "image.size", "got 3"},
    {"SizeNoArray", scene("[image]\nsize = 640\n"), 3, 8, "image.size", "got an integer"},
    {"SizeFraction", scene("[image]\nsize = [640, 480.0]\n"), 3, 14, "image.size",
     "expected an integer, got a number"},
    {"SizeZero", scene("[image]\nsize = [0, 1]\n"), 3, 8, "image.size", "1 to 65535, is 0"},
    {"SizeTooLarge", scene("[image]\nsize = [1, 65536]\n"), 3, 8, "image.size", "is 65536"},
    {"SizeBeyondInt", scene("[image]\nsize = [1, 4294967296]\n"), 3, 12, "image.size",
     "must be an integer of 32 bits"},
    {"SppZero", scene("[image]\nspp = 0\n"), 3, 7, "image.spp", "must be 1 or above, is 0"},
    {"SppText", scene("[image]\nspp = \"4\"\n"), 3, 7, "image.spp", "got a string"},
    {"FilterUnknown", scene("[image]\nfilter = \"tend\"\n"), 3, 10, "image.filter",
     "expected 'box' or 'tent'; did you mean 'tent'?"},
    {"FilterNumber", scene("[image]\nfilter = 2\n"), 3, 10, "image.filter", "expected a string"},
    {"ImageKey", scene("[image]\nsice = [1, 1]\n"), 3, 1, "image.sice", "did you mean 'size'?"},
    {"MethodNumber", scene("[render]\nmethod = 1\n"), 3, 10, "render.method", "expected a string"},
    {"MethodUnknown", scene("[render]\nmethod = \"witted\"\n"), 3, 10, "render.method",
     "expected 'whitted' or 'path'; did you mean 'whitted'?"},
    {"MaxDepthNegative", scene("[render]\nmax_depth = -1\n"), 3, 13, "render.max_depth",
     "must be 0 or above, is -1"},
    {"BackgroundType", scene("[background]\ntype = \"enviroment\"\n"), 3, 8, "background.type",
     "expected 'constant', 'gradient' or 'environment'; did you mean 'environment'?"},
    {"EnvironmentNoFile", scene("[background]\ntype = \"environment\"\n"), 2, 1, "background.file",
     "missing key 'file'"},
    {"EnvironmentNotThere", scene("[background]\ntype = \"environment\"\nfile = \"none.exr\"\n"), 4,
     8, "background.file", "'none.exr': "},
    {"EnvironmentRotation", scene("[background]\ntype = \"environment\"\nrotation = \"left\"\n"), 4,
     12, "background.rotation", "expected a number, got a string"},
    {"EnvironmentColor", scene("[background]\ntype = \"environment\"\ncolor = [0, 0, 0]\n"), 4, 1,
     "background.color", "unknown key 'color'"},
    {"BackgroundColor", scene("[background]\ncolor = [0, nan, 0]\n"), 3, 9, "background.color",
     "must be finite"},
    {"BackgroundOtherType", scene("[background]\ntype = \"gradient\"\ncolor = [0, 0, 0]\n"), 4, 1,
     "background.color", "unknown key 'color'"},
    {"GradientUpZero", scene("[background]\ntype = \"gradient\"\nup = [0, 0, 0]\n"), 4, 6,
     "background.up", "must not be the zero vector"},
    {"Ambient", scene("[background]\nambient = [0, -1, 0]\n"), 3, 11, "background.ambient",
     "0 or above"},
};
INSTANTIATE_TEST_SUITE_P(Settings, TomlErrors, testing::ValuesIn(settings), test::refusal_name);

const Refusal cameras[] = {
    {"NoEye", scene("[camera]\nlook_at = [0, 0, 0]\n"), 2, 1, "camera.eye", "missing key 'eye'"},
    {"NoLookAt", scene("\n[camera]\neye = [0, 0, 0]\n"), 3, 1, "camera.look_at", "missing key"},
    {"LensNoFile", camera("type = \"lens\"\n"), 2, 1, "camera.file", "missing key 'file'"},
    {"LensMissing", camera("type = \"lens\"\nfile = \"none.lens\"\n"), 6, 8, "camera.file",
     "'none.lens': cannot read it: No such file"},
    {"LensNoLens", camera("type = \"lens\"\nfile = \"scene.toml\"\n"), 1, 0, "camera.file",
     "expected four numbers"},
    {"LensFilmText", camera("type = \"lens\"\nfilm_width = \"36mm\"\n"), 6, 14, "camera.film_width",
     "expected a number"},
    {"LensScaleText", camera("type = \"lens\"\nscale = \"mm\"\n"), 6, 9, "camera.scale",
     "expected a number"},
    {"LensFocusBehind", camera("type = \"lens\"\nfocus = [0, 0, 6]\n"), 6, 9, "camera.focus",
     "must lie in front of the camera"},
    {"UnknownType", camera("type = \"pinhol\"\n"), 5, 8, "camera.type",
     "unknown 'pinhol', expected " + camera_types() + "; did you mean 'pinhole'?"},
    {"TypeNoText", camera("type = 1\n"), 5, 8, "camera.type", "expected a string"},
    {"OtherTypesKey", camera("height = 2\n"), 5, 1, "camera.height", "unknown key 'height'"},
    {"KeySlip", camera("fvo = 45\n"), 5, 1, "camera.fvo", "did you mean 'fov'?"},
    {"NamesOnce", scene("[camera]\ntype = \"thin_lens\"\nwhatever = 1\n"), 4, 1, "camera.whatever",
     "expected 'distortion', 'fit', 'key', 'type', 'eye', 'look_at', 'up', 'fov', 'fov_axis', "
     "'focus', "
     "'aperture', 'f_number' or 'focal_length'"},
    {"FovZero", camera("fov = 0\n"), 5, 7, "camera.fov", "above 0 and below 180"},
    {"FovHalfTurn", camera("fov = 180.0\n"), 5, 7, "camera.fov", "below 180"},
    {"FovNan", camera("fov = nan\n"), 5, 7, "camera.fov", "below 180"},
    {"FovTooLarge", camera("fov = 1e39\n"), 5, 7, "camera.fov", "too large for a 32-bit float"},
    {"FovDate", camera("fov = 1979-05-27\n"), 5, 7, "camera.fov", "got a date or time"},
    {"FovBoolean", camera("fov = true\n"), 5, 7, "camera.fov", "got a boolean"},
    {"FovAxis", camera("fov_axis = \"z\"\n"), 5, 12, "camera.fov_axis", "'x', 'y' or 'max'"},
    {"HeightZero", camera("type = \"orthographic\"\nheight = 0\n"), 6, 10, "camera.height",
     "above 0"},
    {"EyeIsLookAt", scene("[camera]\neye = [1, 2, 3]\nlook_at = [1, 2, 3]\n"), 4, 11,
     "camera.look_at", "must differ from eye"},
    {"UpIsTheView", camera("up = [0, 0, 1]\n"), 5, 6, "camera.up", "1e-6 rad"},
    {"UpZero", camera("up = [0, 0, 0]\n"), 5, 6, "camera.up", "zero vector"},
    {"DefaultUpIsTheView", scene("[camera]\neye = [0, 5, 0]\nlook_at = [0, 0, 0]\n"), 2, 1,
     "camera.up", "1e-6 rad"},
    {"EyeInf", scene("[camera]\neye = [0, inf, 0]\nlook_at = [1, 2, 3]\n"), 3, 7, "camera.eye",
     "must be finite"},
    {"EyeText", scene("[camera]\neye = [0, \"1\", 0]\nlook_at = [1, 2, 3]\n"), 3, 11, "camera.eye",
     "expected a number, got a string"},
    {"EyeTwo", scene("[camera]\neye = [0, 1]\nlook_at = [1, 2, 3]\n"), 3, 7, "camera.eye",
     "expected an array of 3 numbers, got 2"},
    {"EyeFour", scene("[camera]\neye = [0, 1, 2, 3]\nlook_at = [1, 2, 3]\n"), 3, 7, "camera.eye",
     "got 4"},
};
std::string lens(const std::string& text) { return camera("type = \"thin_lens\"\n" + text); }

const Refusal round_cameras[] = {
    {"FisheyeFovZero", camera("type = \"fisheye\"\nfov = 0\n"), 6, 7, "camera.fov",
     "must be above 0 and at most 360 degrees, is 0"},
    {"FisheyeFovTooLarge", camera("type = \"fisheye\"\nfov = 360.1\n"), 6, 7, "camera.fov",
     "at most 360"},
    {"FisheyeAperture", camera("type = \"fisheye\"\naperture = 1\n"), 6, 1, "camera.aperture",
     "unknown key 'aperture'"},
    {"LensWithout", lens(""), 2, 1, "camera.aperture",
     "missing key 'aperture', or 'f_number' with 'focal_length'"},
    {"LensTwice", lens("aperture = 1\nf_number = 2\nfocal_length = 0.05\n"), 7, 12,
     "camera.f_number", "cannot stand beside 'aperture'"},
    {"LensNoFocalLength", lens("f_number = 2\n"), 2, 1, "camera.focal_length",
     "missing key 'focal_length': it goes with 'f_number'"},
    {"LensNoFNumber", lens("aperture = 1\nfocal_length = 2\n"), 2, 1, "camera.f_number",
     "missing key 'f_number'"},
    {"ApertureNegative", lens("aperture = -1\n"), 6, 12, "camera.aperture", "0 or above, is -1"},
    {"ApertureText", lens("aperture = \"f/2\"\n"), 6, 12, "camera.aperture", "got a string"},
    {"FNumberZero", lens("f_number = 0\nfocal_length = 1\n"), 6, 12, "camera.f_number", "above 0"},
    {"FocalLength", lens("f_number = 2\nfocal_length = -1\n"), 7, 16, "camera.focal_length",
     "above 0"},
    {"FNumberTiny", lens("f_number = 1e-38\nfocal_length = 1e38\n"), 6, 12, "camera.f_number",
     "makes the lens too large"},
    {"FocusZero", lens("aperture = 1\nfocus = 0\n"), 7, 9, "camera.focus", "above 0, is 0"},
    {"FocusInfinite", lens("aperture = 1\nfocus = inf\n"), 7, 9, "camera.focus", "finite"},
    {"FocusBehind", lens("aperture = 1\nfocus = [0, 0, 6]\n"), 7, 9, "camera.focus",
     "must lie in front of the camera"},
    {"FocusNoEye",
     scene(
         "[camera]\ntype = \"thin_lens\"\naperture = 1\nlook_at = [0, 0, 0]\nfocus = [0, 0, 1]\n"),
     2, 1, "camera.eye", "missing key 'eye'"},
    {"FocusOfTwo", lens("aperture = 1\nfocus = [0, 0]\n"), 7, 9, "camera.focus", "got 2"},
    {"FocusText", lens("aperture = 1\nfocus = \"far\"\n"), 7, 9, "camera.focus", "got a string"},
    {"LensFov", lens("aperture = 1\nfov = 180\n"), 7, 7, "camera.fov", "below 180"},
};
INSTANTIATE_TEST_SUITE_P(RoundCameras, TomlErrors, testing::ValuesIn(round_cameras),
                         test::refusal_name);

INSTANTIATE_TEST_SUITE_P(Cameras, TomlErrors, testing::ValuesIn(cameras), test::refusal_name);

const Refusal materials[] = {
    {"Type", material("mate", ""), 3, 8, "material.red.type", "did you mean 'matte'?"},
    {"OtherTypesKey", material("matte", "ior = 1\n"), 4, 1, "material.red.ior", "unknown key"},
    {"ColorNegative", material("matte", "color = [1, 1, -1]\n"), 4, 9, "material.red.color",
     "0 or above"},
    {"Specular", material("plastic", "specular = -1\n"), 4, 12, "material.red.specular",
     "0 or above"},
    {"Shininess", material("plastic", "shininess = -1\n"), 4, 13, "material.red.shininess",
     "0 or above"},
    {"Reflect", material("plastic", "reflect = -0.5\n"), 4, 11, "material.red.reflect",
     "0 or above"},
    {"Metal", material("metal", "color = [nan, 1, 1]\n"), 4, 9, "material.red.color", "finite"},
    {"Ior", material("glass", "ior = 0\n"), 4, 7, "material.red.ior", "above 0"},
    {"IorInf", material("glass", "ior = inf\n"), 4, 7, "material.red.ior", "finite"},
    {"Radiance", material("emissive", "radiance = [-1, 0, 0]\n"), 4, 12, "material.red.radiance",
     "0 or above"},
    {"Ka", material("phong", "ka = -1\n"), 4, 6, "material.red.ka", "0 or above"},
    {"Kd", material("phong", "kd = -1\n"), 4, 6, "material.red.kd", "0 or above"},
    {"Ks", material("phong", "ks = -1\n"), 4, 6, "material.red.ks", "0 or above"},
    {"PhongShininess", material("phong", "shininess = -1\n"), 4, 13, "material.red.shininess",
     "0 or above"},
    {"Transmission", material("phong", "transmission = -1\n"), 4, 16, "material.red.transmission",
     "0 or above"},
    {"PhongIor", material("phong", "ior = -1.5\n"), 4, 7, "material.red.ior", "above 0"},
};
INSTANTIATE_TEST_SUITE_P(Materials, TomlErrors, testing::ValuesIn(materials), test::refusal_name);

const Refusal objects[] = {
    {"LightType", scene("[[light]]\ntype = \"spere\"\n"), 3, 8, "light[0].type",
     "expected 'point', 'directional' or 'sphere'; did you mean 'sphere'?"},
    {"LightRadiusZero", scene("[[light]]\ntype = \"sphere\"\nradius = 0\n"), 4, 10,
     "light[0].radius", "must be finite and above 0, is 0"},
    {"LightRadiance", scene("[[light]]\ntype = \"sphere\"\nradiance = [0, 0, -2]\n"), 4, 12,
     "light[0].radiance", "0 or above, is -2"},
    {"LightCenter", scene("[[light]]\ntype = \"sphere\"\ncenter = [0, nan, 0]\n"), 4, 10,
     "light[0].center", "must be finite"},
    {"SphereLightOtherKey", scene("[[light]]\ntype = \"sphere\"\nposition = [0, 1, 0]\n"), 4, 1,
     "light[0].position", "unknown key 'position'"},
    {"LightPosition", scene("[[light]]\n[[light]]\nposition = [inf, 0, 0]\n"), 4, 12,
     "light[1].position", "must be finite"},
    {"LightIntensity", scene("[[light]]\nintensity = [-1, 0, 0]\n"), 3, 13, "light[0].intensity",
     "0 or above"},
    {"LightFalloff", scene("[[light]]\nfalloff = \"linear\"\n"), 3, 11, "light[0].falloff",
     "'none' or 'inverse_square'"},
    {"LightDirection", scene("[[light]]\ntype = \"directional\"\ndirection = [0, 0, 0]\n"), 4, 13,
     "light[0].direction", "zero vector"},
    {"LightOtherKey", scene("[[light]]\ntype = \"directional\"\nfalloff = \"none\"\n"), 4, 1,
     "light[0].falloff", "unknown key"},
    {"RadiusZero", scene("[[sphere]]\n[[sphere]]\n[[sphere]]\nradius = 0\n"), 5, 10,
     "sphere[2].radius", "above 0, is 0"},
    {"RadiusNegative", scene("[[sphere]]\nradius = -1\n"), 3, 10, "sphere[0].radius", "is -1"},
    {"RadiusInf", scene("[[sphere]]\nradius = inf\n"), 3, 10, "sphere[0].radius", "finite"},
    {"RadiusUnderflow", scene("[[sphere]]\nradius = 1e-50\n"), 3, 10, "sphere[0].radius",
     "above 0"},
    {"Center", scene("[[sphere]]\ncenter = [0, 0, nan]\n"), 3, 10, "sphere[0].center", "finite"},
    {"SphereKey", scene("[[sphere]]\nraduis = 1\n"), 3, 1, "sphere[0].raduis",
     "did you mean 'radius'?"},
    {"MaterialUnknown", scene("[material.red]\n[[sphere]]\nmaterial = \"rde\"\n"), 4, 12,
     "sphere[0].material", "unknown material 'rde'; did you mean 'red'?"},
    {"MaterialNoText", scene("[[plane]]\nmaterial = 0\n"), 3, 12, "plane[0].material",
     "expected a string"},
    {"PlaneNormal", scene("[[plane]]\nnormal = [0, 0, 0]\n"), 3, 10, "plane[0].normal",
     "zero vector"},
    {"PlanePoint", scene("[[plane]]\npoint = [nan, 0, 0]\n"), 3, 9, "plane[0].point", "finite"},
    {"PlaneKey", scene("[[plane]]\nradius = 1\n"), 3, 1, "plane[0].radius", "unknown key"},
    {"SpheresNoFile", scene("[[spheres]]\n"), 2, 1, "spheres[0].file", "missing key 'file'"},
    {"SpheresRadius", scene("[[spheres]]\nfile = \"a\"\nradius = 0\n"), 4, 10, "spheres[0].radius",
     "above 0"},
    {"SpheresMissing", scene("[[spheres]]\nfile = \"a.npy\"\n"), 3, 8, "spheres[0].file",
     "'a.npy': cannot read it: No such file"},
    {"SpheresFolder", scene("[[spheres]]\nfile = \"\"\n"), 3, 8, "spheres[0].file", "a directory"},
    {"SpheresNul", scene("[[spheres]]\nfile = \"a\\u0000b\"\n"), 3, 8, "spheres[0].file",
     "'a\\x00b': cannot read it: its name holds a NUL byte"},
};
INSTANTIATE_TEST_SUITE_P(Objects, TomlErrors, testing::ValuesIn(objects), test::refusal_name);

}  // namespace
}  // namespace boule::toml_errors
