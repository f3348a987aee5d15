// boule info: what a scene holds.
#include <nlohmann/json.hpp>

#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class Info : public ProgramTest {
 protected:
  static json info(const std::string& scene) {
    const ProgramRun run = boule_run({"info", scene, "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, IsEmpty());
    return json::parse(run.out);
  }
};

TEST_F(Info, JsonTellsEverything) {
  const std::string scene = small_scene();
  const json found = info(scene);
  EXPECT_EQ(found.at("schema"), 1);
  EXPECT_EQ(found.at("file"), scene);
  EXPECT_EQ(found.at("hash").get<std::string>().size(), 16u);
  EXPECT_EQ(found.at("size"), json({32, 18}));
  EXPECT_EQ(found.at("spp"), 1);
  EXPECT_EQ(found.at("method"), "whitted");
  EXPECT_EQ(found.at("max_depth"), 5);
  EXPECT_EQ(found.at("noise"), 0);
  EXPECT_EQ(found.at("min_spp"), 32);
  EXPECT_EQ(found.at("aa"), 0);
  EXPECT_EQ(found.at("least_weight"), 0);
  EXPECT_EQ(found.at("spheres"), 1);
  EXPECT_EQ(found.at("planes"), 1);
  EXPECT_EQ(found.at("capsules"), 0);
  EXPECT_EQ(found.at("groups"), 0);
  EXPECT_EQ(found.at("instances"), 0);
  EXPECT_EQ(found.at("bounds"), json::parse(R"({"min": [-1, 0, -1], "max": [1, 2, 1]})"));
  EXPECT_EQ(found.at("origin"), json({0, 0, 0}));
  EXPECT_EQ(found.at("camera"), json::parse(R"({"type": "pinhole", "eye": [0, 1, 5],
      "look_at": [0, 0.8, 0], "up": [0, 1, 0], "fov": 45, "fov_axis": "x"})"));
  EXPECT_EQ(found.at("background"),
            json::parse(R"({"type": "constant", "color": [0.2, 0.3, 0.5]})"));
  EXPECT_EQ(found.at("ambient"), json({0, 0, 0}));
  EXPECT_EQ(found.at("lights"),
            json::parse(R"([{"type": "point", "position": [3, 5, 4], "intensity": [1, 1, 1],
                             "falloff": "none", "relative_to": "scene"}])"));
  EXPECT_EQ(found.at("materials"), json::parse(R"([
      {"name": "shiny", "type": "phong", "color": [0.8, 0.3, 0.1], "ka": 0, "kd": 0.7, "ks": 0.3,
       "shininess": 20, "transmission": 0.2, "ior": 1.3, "objects": 1},
      {"name": "default plane", "type": "matte", "color": [0.45, 0.45, 0.45], "objects": 1}])"));
  EXPECT_EQ(found.at("filter"), "box");
  EXPECT_EQ(found.at("transparent"), false);
  EXPECT_EQ(found.at("outline"), 0);
  EXPECT_EQ(found.at("overlay"), json::array());
  EXPECT_EQ(found.at("data_files"), json::array());
  EXPECT_EQ(found.at("first_spheres"),
            json::parse(R"([{"center": [0, 1, 0], "radius": 1, "material": "shiny"}])"));
  EXPECT_EQ(found.at("first_planes"), json::parse(R"([{"point": [0, 0, 0], "normal": [0, 1, 0],
                                                       "material": "default plane"}])"));
  EXPECT_EQ(found.at("first_capsules"), json::array());
  EXPECT_EQ(found.at("group_list"), json::array());
  EXPECT_EQ(found.at("first_instances"), json::array());
  EXPECT_EQ(found.at("warnings"), json::array());
  EXPECT_EQ(found.at("notes"), json::array());
  EXPECT_EQ(found.size(), 36u);
}

TEST_F(Info, WhatInstancesShowIsCountedAndFramed) {
  const std::string grouped = write("grouped.toml", R"(schema = 1
[[group.pair.sphere]]
center = [1, 0, 0]
[[group.pair.sphere]]
center = [-1, 0, 0]
[[group.pair.plane]]
[[instance]]
group = "pair"
[[instance]]
group = "pair"
translate = [0, 5, 0]
rotate = [0, 0, 90]
scale = 2
)");
  const std::string flat = write("flat.toml", R"(schema = 1
sphere = [{center = [1, 0, 0]}, {center = [-1, 0, 0]}, {center = [0, 7, 0], radius = 2},
          {center = [0, 3, 0], radius = 2}]
plane = [{}, {point = [0, 5, 0], normal = [-1, 0, 0]}]
)");
  const json found = info(grouped), expected = info(flat);
  EXPECT_EQ(found.at("groups"), 1);
  EXPECT_EQ(found.at("instances"), 2);
  for (const char* key : {"spheres", "planes", "bounds", "hash", "camera"}) {
    EXPECT_EQ(found.at(key), expected.at(key)) << key;
  }
}

const char* const every_kind = R"(schema = 1
[camera]
type = "orthographic"
eye = [0, 0, 5]
look_at = [0, 0, 0]
height = 3
[background]
type = "gradient"
[material.a]
type = "matte"
[material.b]
type = "plastic"
[material.c]
type = "metal"
[material.d]
type = "glass"
[material.e]
type = "emissive"
[[light]]
type = "directional"
direction = [0, -1, 0]
[[light]]
type = "point"
position = [0, 9, 0]
falloff = "inverse_square"
[[light]]
type = "sphere"
radius = 0.5
[render]
method = "path"
)";

TEST_F(Info, EveryKindOfThingIsNamed) {
  const json found = info(write("all.toml", every_kind));
  EXPECT_EQ(found.at("camera").at("type"), "orthographic");
  EXPECT_EQ(found.at("camera").at("height"), 3);
  EXPECT_EQ(found.at("background").at("type"), "gradient");
  EXPECT_EQ(found.at("background").at("top"), json({0.5, 0.7, 1}));
  EXPECT_EQ(found.at("bounds"), nullptr);
  std::vector<std::string> types;
  for (const json& material : found.at("materials")) types.push_back(material.at("type"));
  EXPECT_THAT(types, testing::ElementsAre("matte", "plastic", "metal", "glass", "emissive"));
  EXPECT_EQ(found.at("materials").at(1).at("specular"), 0.04);
  EXPECT_EQ(found.at("materials").at(3).at("ior"), 1.5);
  EXPECT_EQ(found.at("materials").at(4).at("radiance"), json({1, 1, 1}));
  EXPECT_EQ(found.at("lights").at(0),
            json::parse(R"({"type": "directional", "direction": [0, -1, 0],
                            "intensity": [1, 1, 1], "relative_to": "scene"})"));
  EXPECT_EQ(found.at("lights").at(1).at("falloff"), "inverse_square");
  EXPECT_EQ(found.at("lights").at(2),
            json::parse(R"({"type": "sphere", "center": [0, 0, 0], "radius": 0.5,
                            "radiance": [1, 1, 1], "relative_to": "scene"})"));
  EXPECT_EQ(found.at("method"), "path");
}

TEST_F(Info, EveryCameraIsDescribed) {
  const std::string start = "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n";
  EXPECT_EQ(info(write("fisheye.toml", start + "type = \"fisheye\"\n")).at("camera"),
            json::parse(R"({"type": "fisheye", "eye": [0, 0, 5], "look_at": [0, 0, 0],
                            "up": [0, 1, 0], "fov": 180, "fov_axis": "x"})"));
  const std::string lens = start + "type = \"thin_lens\"\naperture = 0.1\n";
  EXPECT_EQ(info(write("lens.toml", lens)).at("camera"),
            json::parse(R"({"type": "thin_lens", "eye": [0, 0, 5], "look_at": [0, 0, 0],
                            "up": [0, 1, 0], "fov": 45, "fov_axis": "x", "aperture": 0.1,
                            "focus": 5})"));
  const std::string real = "type = \"lens\"\nfile = \"" BOULE_SCENES "/double_gauss_50mm.lens\"\n";
  json lens_camera = info(write("real.toml", start + real)).at("camera");
  const json elements = lens_camera.at("elements");
  ASSERT_EQ(elements.size(), 11u);
  EXPECT_EQ(elements.at(0), json::parse(R"({"radius": 42.75, "thickness": 5.8, "index": 1.744,
                                            "aperture": 38})"));
  EXPECT_NEAR(lens_camera.at("f_number").get<double>(), 1.403, 1e-3);
  for (const char* key : {"elements", "f_number"}) lens_camera.erase(key);
  EXPECT_EQ(lens_camera, json::parse(R"({"type": "lens", "eye": [0, 0, 5], "look_at": [0, 0, 0],
                            "up": [0, 1, 0], "surfaces": 11, "focal_length": 50.218456,
                            "film_width": 36, "scale": 0.001, "focus": 5})"));
  const std::string map = "[camera.distortion]\nfile = \"" BOULE_SCENES "/barrel.exr\"\n";
  EXPECT_EQ(info(write("distorted.toml", start + map)).at("camera").at("distortion"),
            json::parse(R"({"size": [64, 36]})"));
  EXPECT_EQ(info(write("focus.toml", lens + "focus = 2.5\n")).at("camera").at("focus"), 2.5);
}

TEST_F(Info, DefaultsAreListedAndNoted) {
  const json found = info(write("bare.toml",
                                "schema = 1\n[[sphere]]\ncenter = [1, 2, 3]\n"
                                "radius = 0.5\n"));
  EXPECT_EQ(found.at("camera").at("look_at"), json({1, 2, 3}));
  ASSERT_EQ(found.at("lights").size(), 2u);
  EXPECT_EQ(found.at("lights").at(0).at("type"), "directional");
  EXPECT_EQ(found.at("lights").at(1).at("position"), found.at("camera").at("eye"));
  ASSERT_EQ(found.at("notes").size(), 2u);
  EXPECT_THAT(found.at("notes").at(0).get<std::string>(), HasSubstr("camera is fitted"));
  EXPECT_THAT(found.at("notes").at(1).get<std::string>(), HasSubstr("no light"));
}

TEST_F(Info, WarningsAreThere) {
  const json found =
      info(write("s.nff",
                 "v\nfrom 0 -5 2\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\n"
                 "resolution 16 9\nf 1 0 0 1 0 0 0 1\np 3\n-1 -1 0\n1 -1 0\n0 1 0\n"));
  ASSERT_EQ(found.at("warnings").size(), 1u);
  EXPECT_THAT(found.at("warnings").at(0).get<std::string>(), HasSubstr("s.nff:9"));
  EXPECT_EQ(found.at("planes"), 1);
}

TEST_F(Info, TextSaysTheSame) {
  const ProgramRun run = boule_run({"info", small_scene()});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, IsEmpty());
  EXPECT_THAT(run.out, StartsWith("file: " + path("scene.toml") + "\n"));
  for (const char* line :
       {"size: 32 18\n", "spheres: 1\n", "planes: 1\n",
        "bounds: min -1.0 0.0 -1.0, max 1.0 2.0 1.0", "camera: type pinhole, eye 0.0 1.0 5.0, ",
        "lights: 1\n  type point, position 3.0 5.0 4.0",
        "materials: 2\n  name shiny, type phong, color 0.8 0.3 0.1, "}) {
    EXPECT_THAT(run.out, HasSubstr(line));
  }
  EXPECT_THAT(run.out, Not(HasSubstr("warnings")));
}

/// Points are told as the file counts them, so that a camera of another origin can be typed again.
TEST_F(Info, PointsAreThoseOfTheFile) {
  const std::string far = write("far.toml", R"(
schema = 1
origin = [1000000.0, -2.0, 0.0]
[camera]
eye = [1000000.25, 0.0, 4.0]
look_at = [1000000.1, 0.0, 0.0]
[[sphere]]
center = [1000000.25, 0.0, 0.0]
radius = 0.5
[[plane]]
point = [1000001.0, 0.0, 0.0]
[[light]]
position = [1000000.0, 3.0, 0.0]
[[light]]
relative_to = "camera"
position = [1.0, 2.0, 3.0]
[[group.pair.sphere]]
center = [0.5, 0.0, 0.0]
[[instance]]
group = "pair"
translate = [1000004.0, 0.0, 0.0]
)");
  const json found = info(far);
  const auto numbers = [](const char* text) { return json::parse(text); };
  EXPECT_EQ(found.at("origin"), numbers("[1000000.0, -2.0, 0.0]"));
  EXPECT_EQ(found.at("camera").at("eye"), numbers("[1000000.25, 0.0, 4.0]"));
  EXPECT_EQ(found.at("camera").at("look_at"), numbers("[1000000.1, 0.0, 0.0]"));
  EXPECT_EQ(found.at("bounds").at("min"), numbers("[999999.75, -1.0, -1.0]"));
  EXPECT_EQ(found.at("first_spheres").at(0).at("center"), numbers("[1000000.25, 0.0, 0.0]"));
  EXPECT_EQ(found.at("first_planes").at(0).at("point"), numbers("[1000001.0, 0.0, 0.0]"));
  EXPECT_EQ(found.at("lights").at(0).at("position"), numbers("[1000000.0, 3.0, 0.0]"));
  EXPECT_EQ(found.at("lights").at(1).at("position"), numbers("[1.0, 2.0, 3.0]"));
  EXPECT_EQ(found.at("first_instances").at(0).at("translate"), numbers("[1000004.0, 0.0, 0.0]"));
  const json& in_group = found.at("group_list").at(0).at("first_spheres").at(0);
  EXPECT_EQ(in_group.at("center"), numbers("[0.5, 0.0, 0.0]"));
}

TEST_F(Info, ABadSceneIsInvalidInput) {
  const ProgramRun run = boule_run({"info", write("bad.toml", "schema = 2\n"), "--json"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, HasSubstr("bad.toml:1:"));
  EXPECT_EQ(boule_run({"info", path("none.toml")}).exit_code, 3);
  EXPECT_EQ(boule_run({"info"}).exit_code, 2);
}

}  // namespace
}  // namespace boule::test
