#include "tests/render/renderer/noise_scenes.h"

namespace boule::test {
namespace {

constexpr const char* in_a_room = R"(
schema = 1
[render]
method = "path"
max_depth = 12
[camera]
eye = [0.0, 1.5, 6.0]
look_at = [0.0, 1.0, 0.0]
fov = 45.0
[background]
color = [0.02, 0.02, 0.03]
[material.floor]
color = [0.7, 0.65, 0.6]
[material.wall]
color = [0.4, 0.5, 0.6]
[material.glass]
type = "glass"
color = [1.0, 1.0, 1.0]
ior = 1.5
[material.mirror]
type = "metal"
color = [0.95, 0.95, 0.95]
[material.lamp]
type = "emissive"
radiance = [400.0, 300.0, 200.0]
[[plane]]
material = "floor"
[[plane]]
point = [0.0, 0.0, -3.0]
normal = [0.0, 0.0, 1.0]
material = "wall"
)";

/// The lamp is inside of a ball of glass: paths find its light by chance only.
constexpr const char* lamp_in_glass = R"(
[[sphere]]
center = [0.0, 1.0, 0.0]
radius = 1.0
material = "glass"
[[sphere]]
center = [0.0, 1.0, 0.0]
radius = 0.15
material = "lamp"
)";

/// The lamp stands behind balls of glass, which throw its light onto the floor in bright spots.
constexpr const char* lamp_through_glass = R"(
[[sphere]]
center = [-2.5, 3.0, 1.0]
radius = 0.12
material = "lamp"
[[sphere]]
center = [-0.8, 0.7, 0.4]
radius = 0.7
material = "glass"
[[sphere]]
center = [1.0, 0.8, -0.3]
radius = 0.8
material = "glass"
)";

/// A small lamp before a large mirror, and another one behind the eye.
constexpr const char* lamp_in_mirror = R"(
[[sphere]]
center = [0.0, 1.2, -0.5]
radius = 1.2
material = "mirror"
[[sphere]]
center = [1.6, 0.4, 1.2]
radius = 0.08
material = "lamp"
[[sphere]]
center = [-2.0, 2.5, 7.0]
radius = 0.1
material = "lamp"
)";

/// A sky whose sun is one bright pixel: the file is written by the test.
constexpr const char* sun_in_sky = R"(
schema = 1
[render]
method = "path"
max_depth = 8
[camera]
eye = [0.0, 2.0, 9.5]
look_at = [0.0, 0.95, 0.0]
fov = 46.0
[background]
type = "environment"
file = "sun.exr"
[material.sand]
color = [0.6, 0.55, 0.47]
[material.chrome]
type = "metal"
color = [0.88, 0.89, 0.9]
[material.glass]
type = "glass"
color = [0.99, 1.0, 0.99]
ior = 1.5
[[plane]]
material = "sand"
[[sphere]]
center = [-1.5, 1.2, 0.0]
radius = 1.2
material = "chrome"
[[sphere]]
center = [1.5, 1.2, 0.0]
radius = 1.2
material = "glass"
)";

/// Spheres like those of a particle figure: light from everywhere, a soft one, a white backdrop.
constexpr const char* figure = R"(
schema = 1
[render]
method = "path"
max_depth = 3
[camera]
eye = [0.0, 0.0, 9.0]
look_at = [0.0, 0.0, 0.0]
fov = 40.0
[background]
color = [0.45, 0.45, 0.45]
backdrop = "#ffffff"
[[light]]
type = "sphere"
center = [-6.0, 7.0, 9.0]
radius = 2.2
radiance = [20.0, 20.0, 20.0]
[material.red]
color = [0.7, 0.1, 0.1]
[material.white]
color = [0.9, 0.9, 0.9]
)";

std::string figure_text() {
  std::string text = figure;
  for (int i = 0; i < 60; ++i) {
    const int x = i % 5 - 2, y = i / 5 % 4 - 2, z = i / 20 - 1;
    text += "[[sphere]]\ncenter = [" + std::to_string(1.1 * x) + ", " + std::to_string(1.1 * y) +
            ", " + std::to_string(1.1 * z) + "]\nradius = 0.7\nmaterial = \"" +
            (i % 3 == 0 ? "red" : "white") + "\"\n";
  }
  return text;
}

}  // namespace

std::vector<NoiseScene> noise_scenes() {
  std::vector<NoiseScene> scenes;
  for (const char* name :
       {"daylight", "soft_light", "first_light", "depth_of_field", "distorted", "double_gauss",
        "far_away", "fisheye", "grazing_ground", "inside_sphere", "lecture", "metal_glass_plastic",
        "orthographic", "shadows", "sphereflake", "spheres_on_plane"})
    scenes.push_back({name, "", false});
  for (const char* name : {"first_light", "metal_glass_plastic", "sphereflake"})
    scenes.push_back({name, "", true});
  const std::string room = in_a_room;
  scenes.push_back({"figure", figure_text(), false});
  scenes.push_back({"lamp in glass", room + lamp_in_glass, false, true});
  scenes.push_back({"lamp through glass", room + lamp_through_glass, false});
  scenes.push_back({"lamp in mirror", room + lamp_in_mirror, false, true});
  scenes.push_back({"sun in sky", sun_in_sky, false});
  return scenes;
}

}  // namespace boule::test
