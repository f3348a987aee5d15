// No key of the scene format is silent in `boule info`: whatever a reader knows is changed once,
// and must show in the text and in the JSON. The keys are those that the reader itself lists.
#include "render/apps/cli/info/scene_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "tests/render/apps/cli/info/made_fields.h"
#include "tests/render/npy_files.h"
#include "tests/support/temp_dir.h"

namespace boule::cli {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::set<std::string>;

/// A kind of table: what stands before it, its header, all its keys. `elsewhere` are keys that
/// cannot stand beside these, or have no meaning there: another kind has them.
struct Kind {
  std::string name, before, header;
  std::vector<Field> fields;
  Names elsewhere{};
  std::optional<int> frame{};
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

/// The kind's scene, with the other value of one of its keys, and a line more.
std::string text_of(const Kind& kind, const Field* changed, const std::string& more = "") {
  std::string text = "schema = 1\n" + kind.before + kind.header + "\n";
  for (const Field& field : kind.fields) {
    const std::string& value = &field == changed ? field.other : field.value;
    if (!value.empty()) text += field.key + " = " + value + "\n";
  }
  return text + more;
}

class SceneInfo : public testing::TestWithParam<Kind> {
 protected:
  SceneInfo() {
    const std::filesystem::path scenes = BOULE_SCENES;
    for (const char* name : {"a", "b"}) {
      const auto to = [&](const char* extension) {
        return folder_.path() / (name + std::string(extension));
      };
      std::filesystem::copy(scenes / "barrel.exr", to(".exr"));
      std::filesystem::copy(scenes / "double_gauss_50mm.lens", to(".lens"));
      const std::string centers =
          test::npy_file(test::npy_dict("'<f4'", "(1, 3)"), std::string(12, '\0'));
      std::ofstream(to(".npy"), std::ios::binary) << centers;
    }
    write_numbers("a_colors.npy", "(1, 3)", {0.25F, 0.5F, 0.75F});
    write_numbers("b_colors.npy", "(1, 3)", {0.5F, 0.5F, 0.75F});
    write_numbers("a_scalar.npy", "(1,)", {0});
    write_numbers("b_scalar.npy", "(1,)", {1});
    write_numbers("c.npy", "(1, 6)", {0, 0, 0, 1, 0, 0});
    const std::string cell =
        "Lattice=\"4 0 0 0 4 0 0 0 4\" Properties=species:S:1:pos:R:3:charge:R:1\n";
    const std::string frame = "2\n" + cell + "O 1 1 1 0.5\nH 5 1 2 0.25\n";
    std::ofstream(folder_.path() / "a.xyz") << "1\n" + cell + "O 1 1 1 0.5\n" + frame;
    std::ofstream(folder_.path() / "b.xyz") << frame + "1\n" + cell + "O 1 1 1 0.5\n";
  }

  void write_numbers(const char* name, const char* shape, const std::vector<float>& numbers) const {
    std::string data;
    for (const float number : numbers) test::append_bytes(data, number);
    std::ofstream(folder_.path() / name, std::ios::binary)
        << test::npy_file(test::npy_dict("'<f4'", shape), data);
  }

  Result<LoadedScene> load(const std::string& text) const {
    const std::string path = (folder_.path() / "scene.toml").string();
    std::ofstream(path) << text;
    return load_scene(path, {PolygonPolicy::plane, GetParam().frame});
  }

  /// What is told of a scene, but for the sum of it all.
  Json told(const std::string& text) const {
    auto loaded = load(text);
    EXPECT_TRUE(loaded) << format_diagnostic(loaded.error()) << "\n" << text;
    if (!loaded) return {};
    Json info = scene_info(std::move(loaded).value(), "scene.toml");
    info.erase("hash");
    return info;
  }

  /// The keys that the reader knows here, as it lists them where one is unknown.
  Names known_keys() const {
    const auto loaded = load(text_of(GetParam(), nullptr, "qqqqqqqqqqqqqqqq = 1\n"));
    if (loaded) return {};
    const std::string& list = loaded.error().message;
    Names keys;
    for (std::size_t at = list.find("expected '");
         (at = list.find('\'', at)) != std::string::npos;) {
      const std::size_t end = list.find('\'', at + 1);
      keys.insert(list.substr(at + 1, end - at - 1));
      at = end + 1;
    }
    return keys;
  }

 private:
  test::TempDir folder_;
};

TEST_P(SceneInfo, ShowsEveryKey) {
  const Json before = told(text_of(GetParam(), nullptr));
  for (const Field& field : GetParam().fields) {
    SCOPED_TRACE(field.key);
    const Json after = told(text_of(GetParam(), &field));
    EXPECT_NE(before, after);
    EXPECT_NE(scene_info_text(before), scene_info_text(after));
  }
}

TEST_P(SceneInfo, NoKeyIsLeftOutHere) {
  Names here = GetParam().elsewhere;
  for (const Field& field : GetParam().fields) here.insert(field.key);
  const Names known = known_keys();
  EXPECT_THAT(known, testing::Not(testing::IsEmpty()));
  for (const std::string& key : known) EXPECT_TRUE(here.count(key) != 0) << key;
}

const Field eye{"eye", "[0, 0, 5]", "[0, 1, 5]"};
const Field look_at{"look_at", "[0, 0, 0]", "[0, 0.5, 0]"};
const Field up{"up", "[0, 1, 0]", "[0.1, 1, 0]"};
const Field fov{"fov", "40", "50"};
const Field fov_axis{"fov_axis", "\"x\"", "\"y\""};
const Field distortion{"distortion", "{file = \"a.exr\"}", "{file = \"b.exr\"}"};
const Field focus{"focus", "4", "[0, 0, 2]"};
const Field color{"color", "[0.1, 0.2, 0.3]", "[0.1, 0.2, 0.4]"};
const Field ambient{"ambient", "", "[0, 0, 0.1]"};
const Field backdrop{"backdrop", "", "\"#ffffff\""};
const Field intensity{"intensity", "[1, 2, 3]", "[1, 2, 4]"};
const Field relative_to{"relative_to", "\"scene\"", "\"camera\""};
const Field center{"center", "[1, 2, 3]", "[1, 2, 4]"};
const Field radius{"radius", "1", "2"};
const Field material{"material", "\"m\"", "\"n\""};
const Field sphere{"sphere", "[{}]", "[{radius = 2}]"};
const Field spheres{"spheres", "", "[{file = \"a.npy\", radius = 1}]"};
const Field particles{"particles", "", "[{file = \"a.xyz\"}]"};
const Field plane{"plane", "[{}]", "[{point = [0, 1, 0]}]"};
const std::string materials = "[material.m]\n[material.n]\n";
const std::string groups = materials + "[[group.g.sphere]]\n[[group.h.plane]]\n";

/// The kinds of a variant, by their fields, each with those that all kinds have besides. Kinds that
/// need a file are among those below.
template <class Variant>
struct MadeKinds;
template <class... Types>
struct MadeKinds<std::variant<Types...>> {
  std::string section;
  std::vector<Field> besides{};
  Names elsewhere{};

  void add_to(std::vector<Kind>& kinds) const { (add<Types>(kinds), ...); }

 private:
  template <class Type>
  void add(std::vector<Kind>& kinds) const {
    if (std::is_same_v<Type, LensCamera> || std::is_same_v<Type, EnvironmentBackground>) return;
    const std::string type(boule::fields<Type>.type);
    FieldMaker maker;
    maker.add_all<Type>();
    maker.fields.insert(maker.fields.end(), besides.begin(), besides.end());
    Kind kind{.name = type + "_made",
              .before = {},
              .header = section + "\ntype = \"" + type + "\"",
              .fields = maker.fields,
              .elsewhere = elsewhere};
    kind.elsewhere.insert("type");
    kinds.push_back(std::move(kind));
  }
};

/// The settings of a section; those that are not changed are left out.
template <class Settings>
Kind settings_kind(const std::vector<Field>& besides = {}) {
  FieldMaker maker;
  maker.add_all<Settings>();
  for (Field& field : maker.fields) field.value.clear();
  maker.fields.insert(maker.fields.end(), besides.begin(), besides.end());
  const std::string name(boule::fields<Settings>.type);
  return {.name = name, .before = {}, .header = "[" + name + "]", .fields = maker.fields};
}

std::vector<Kind> made_kinds() {
  std::vector<Kind> kinds{settings_kind<ImageSettings>({{"size", "[32, 18]", "[18, 32]"}}),
                          settings_kind<RenderSettings>()};
  MadeKinds<Camera>{"[camera]", {distortion}, {"fit", "key", "f_number", "focal_length"}}.add_to(
      kinds);
  MadeKinds<Background>{"[background]", {ambient, backdrop}}.add_to(kinds);
  MadeKinds<Material>{"[material.m]"}.add_to(kinds);
  MadeKinds<Light>{"[[light]]"}.add_to(kinds);
  return kinds;
}

const Kind kinds[] = {
    {"root",
     "sphere = [{}]\n",
     "",
     {{"origin", "[0, 0, 0]", "[1, 0, 0]"}},
     {"schema", "image", "camera", "background", "render", "material", "light", "sphere", "spheres",
      "packed", "particles", "plane", "capsule", "capsules", "clip", "group", "instance"}},
    {"fitted",
     "[[sphere]]\n[[sphere]]\ncenter = [2, 1, 0]\n",
     "[camera]\nfit = true",
     {{"direction", "[0, 0, -1]", "[1, 0, -1]"},
      {"up", "[0, 1, 0]", "[1, 1, 0]"},
      fov,
      fov_axis,
      {"margin", "0", "0.1"},
      {"roll", "0", "10"},
      {"room", "0", "0.2"}},
     {"fit", "type", "pose", "eye", "look_at", "key", "distortion"}},
    {"fitted_principal",
     "[[sphere]]\n[[sphere]]\ncenter = [2, 1, 0]\n",
     "[camera]\nfit = true",
     {{"pose", "\"upright\"", "\"principal\""}},
     {"fit", "type", "direction", "up", "fov", "fov_axis", "margin", "roll", "room", "eye",
      "look_at", "key", "distortion"}},
    {"fitted_orthographic",
     "[[sphere]]\n[[sphere]]\ncenter = [2, 1, 0]\n",
     "[camera]\nfit = true",
     {{"type", "\"pinhole\"", "\"orthographic\""}},
     {"fit", "direction", "up", "fov", "fov_axis", "margin", "pose", "roll", "room", "eye",
      "look_at", "key", "distortion"}},
    {"pinhole",
     "",
     "[camera]",
     {{"type", "\"pinhole\"", "\"fisheye\""}, eye, look_at, up, fov, fov_axis, distortion},
     {"key", "fit"}},
    {"thin_lens_by_number",
     "",
     "[camera]\ntype = \"thin_lens\"",
     {eye, look_at, {"f_number", "4", "8"}, {"focal_length", "0.05", "0.04"}},
     {"type", "fit", "key", "up", "fov", "fov_axis", "distortion", "focus", "aperture"}},
    {"lens",
     "",
     "[camera]\ntype = \"lens\"",
     {eye,
      look_at,
      up,
      distortion,
      focus,
      {"file", "\"a.lens\"", "\"b.lens\""},
      {"f_number", "2", "4"},
      {"film_width", "36", "24"},
      {"scale", "0.001", "0.002"}},
     {"type", "fit", "key"}},
    {"camera_key",
     "",
     "[camera]\ntype = \"thin_lens\"\n[[camera.key]]\nframe = 1\neye = [0, 0, 5]\n"
     "look_at = [0, 0, 0]\nfov = 30\naperture = 0.1\nfocus = 3\n[[camera.key]]",
     {{"frame", "5", "9"},
      {"eye", "[0, 0, 6]", "[0, 1, 6]"},
      {"look_at", "[0, 0, 1]", "[0, 1, 1]"},
      fov,
      {"aperture", "0.2", "0.3"},
      {"focus", "4", "5"}},
     {},
     3},
    {"distortion",
     "",
     "[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\n[camera.distortion]",
     {{"file", "\"a.exr\"", "\"b.exr\""}}},
    {"no_background",
     "",
     "[background]",
     {{"type", "\"constant\"", "\"gradient\""}, ambient, backdrop},
     {"color"}},
    {"environment",
     "",
     "[background]\ntype = \"environment\"",
     {{"file", "\"a.exr\"", "\"b.exr\""}, {"rotation", "0", "90"}, ambient, backdrop},
     {"type"}},
    {"matte", "", "[material.m]", {{"type", "\"matte\"", "\"metal\""}, color}},
    {"directional",
     "",
     "[[light]]",
     {{"type", "\"directional\"", "\"point\""},
      intensity,
      {"direction", "", "[0, 0, 1]"},
      relative_to}},
    {"sphere", materials, "[[sphere]]", {center, radius, material, color}},
    {"spheres",
     materials,
     "[[spheres]]",
     {{"file", "\"a.npy\"", "\"b.npy\""}, radius, material, color},
     {"colors", "color_space", "scalar", "map", "range"}},
    {"colored_spheres",
     "",
     "[[spheres]]\nfile = \"a.npy\"\nradius = 1",
     {{"colors", "\"a_colors.npy\"", "\"b_colors.npy\""},
      {"color_space", "\"srgb\"", "\"linear\""}},
     {"file", "radius", "material", "color", "scalar", "map", "range"}},
    {"mapped_spheres",
     "",
     "[[spheres]]\nfile = \"a.npy\"\nradius = 1",
     {{"scalar", "\"a_scalar.npy\"", "\"b_scalar.npy\""},
      {"map", "\"viridis\"", "\"grey\""},
      {"range", "[-1, 2]", "[-1, 3]"}},
     {"file", "radius", "material", "color", "colors", "color_space"}},
    {"particles",
     materials,
     "[[particles]]",
     {{"file", "\"a.xyz\"", "\"b.xyz\""},
      {"frame", "-1", "0"},
      {"radius", "\"covalent\"", "\"vdw\""},
      {"radii", "{ C = 1 }", "{ O = 1 }"},
      {"scale", "1", "2"},
      material,
      {"color", "\"#102030\"", "\"element\""},
      {"colors", "{ C = \"red\" }", "{ O = \"red\" }"},
      {"bonds", "2", "\"none\""},
      {"bond_radius", "0.1", "0.2"},
      {"bond_color", "\"red\"", "\"blue\""},
      {"select", "", "\"x < 2\""},
      {"ghost", "", "\"x < 2\""},
      {"wrap", "false", "true"},
      {"unwrap", "false", "true"},
      {"replicate", "[1, 1, 1]", "[2, 1, 1]"}},
     {"format", "columns", "water", "nan_color", "outline_by", "style", "cell_edges", "axes",
      "arrows", "arrow_scale", "topology", "boundary", "labels", "label_text", "opacity"}},
    {"plane",
     materials,
     "[[plane]]",
     {{"point", "[1, 2, 3]", "[1, 2, 4]"}, {"normal", "[0, 1, 0]", "[0, 2, 0]"}, material, color}},
    {"capsule",
     materials,
     "[[capsule]]",
     {{"a", "[1, 2, 3]", "[1, 2, 4]"}, {"b", "[0, 1, 0]", "[0, 2, 0]"}, radius, material, color}},
    {"clip",
     "[[sphere]]\n",
     "[[clip]]",
     {{"point", "[0, 0.1, 0]", "[0, 0.2, 0]"}, {"normal", "[0, 1, 0]", "[0, 2, 0]"}}},
    {"instance",
     groups,
     "[[instance]]",
     {{"group", "\"g\"", "\"h\""},
      {"translate", "[1, 2, 3]", "[1, 2, 4]"},
      {"rotate", "[10, 20, 30]", "[10, 20, 40]"},
      {"scale", "1", "2"},
      material}},
    {"group",
     groups,
     "[group.k]",
     {sphere,
      spheres,
      particles,
      plane,
      {"capsule", "[{}]", "[{radius = 2}]"},
      {"capsules", "", "[{file = \"c.npy\", radius = 1}]"},
      {"instance", "[{group = \"g\"}]", "[{group = \"h\"}]"}}},
    {"group_instance",
     groups,
     "[[group.k.instance]]",
     {{"group", "\"g\"", "\"h\""},
      {"translate", "[1, 2, 3]", "[1, 2, 4]"},
      {"rotate", "[10, 20, 30]", "[10, 20, 40]"},
      {"scale", "1", "2"},
      material}},
};
INSTANTIATE_TEST_SUITE_P(Made, SceneInfo, testing::ValuesIn(made_kinds()),
                         [](const auto& kind) { return kind.param.name; });
INSTANTIATE_TEST_SUITE_P(Keys, SceneInfo, testing::ValuesIn(kinds),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace boule::cli
