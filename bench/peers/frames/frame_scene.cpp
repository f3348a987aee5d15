#include "bench/peers/frames/frame_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "core/scene/material.h"

namespace boule::bench {
namespace {

constexpr Color background = {0.078F, 0.361F, 0.753F};
constexpr Vec3f lights[] = {{4, 3, 2}, {1, -4, 4}, {-3, 1, 5}};
constexpr double floor_height = -0.5, floor_reach = 12;
// Color, ka, kd, ks, shininess. The floor has no highlight: SPD's 100000 works on ks = 0.
constexpr Phong ground = {{1, 0.75F, 0.33F}, 0, 0.8F, 0, 100000};
constexpr Phong ball = {{1, 0.9F, 0.7F}, 0, 0.5F, 0.5F, 3.0827F};

/// NFF's: a light without a colour has 1 / sqrt(their number).
double intensity() { return 1 / std::sqrt(static_cast<double>(std::size(lights))); }

std::string text(const Vec3d& v, const char* separator = " ") {
  return fmt::format("{:.9g}{}{:.9g}{}{:.9g}", v.x, separator, v.y, separator, v.z);
}
std::string text(const Vec3f& v, const char* separator = " ") {
  return text(vec_cast<double>(v), separator);
}
std::string text(const Color& c, const char* separator = " ") {
  return text(Vec3f{c.r, c.g, c.b}, separator);
}

std::string nff_material(const Phong& m) {
  return fmt::format("f {} {} {} {} 0 1\n", text(m.color), m.kd, m.ks, m.shininess);
}

template <class Vec>
Vec mirrored(const Vec& v) {
  return {-v.x, v.y, v.z};
}

/// The point that Tachyon looks at so that its samples, half a pixel off, are ours.
Vec3d tachyon_view(const PinholeCamera& camera, int side) {
  const CameraView view = build_camera(camera, side, side);
  return view.forward - (view.right + view.up) * (1.0 / side);
}

std::string tachyon_texture(const char* name, const Phong& m) {
  const std::string highlight =
      m.ks > 0 ? fmt::format("PHONG PLASTIC {} PHONG_SIZE {} ", m.ks, m.shininess) : "";
  return fmt::format("TEXDEF {} AMBIENT 0 DIFFUSE {} SPECULAR {} OPACITY 1 {}COLOR {} TEXFUNC 0\n",
                     name, m.kd, m.ks, highlight, text(m.color));
}

std::string tachyon_floor(Floor floor) {
  if (floor == Floor::plane) {
    return fmt::format("PLANE CENTER 0 0 {} NORMAL 0 0 1 ground\n", floor_height);
  }
  const double a = floor_reach, z = floor_height;
  const Vec3d corners[] = {{a, a, z}, {-a, a, z}, {-a, -a, z}, {a, -a, z}};
  const auto triangle = [&corners](int second) {
    return fmt::format("TRI V0 {} V1 {} V2 {} ground\n", text(corners[0]), text(corners[second]),
                       text(corners[second + 1]));
  };
  return triangle(1) + triangle(2);
}

std::string pov_finish(const Phong& m) {
  const std::string mirror =
      m.ks > 0 ? fmt::format(" phong {} phong_size {} reflection {}", m.ks, m.shininess, m.ks) : "";
  return fmt::format(
      "texture {{ pigment {{ color rgb <{}> }} finish {{ ambient 0 diffuse {}{} }} }}",
      text(m.color, ","), m.kd, mirror);
}

}  // namespace

Result<BenchScene> make_flake(const std::string& name) {
  if (name.starts_with("flake")) return make_scene(name);
  return Diagnostic::of("no whole frames of " + quote(name) + ", expected flakeD, D from 0 to 6");
}

std::string as_nff(const BenchScene& flake) {
  const CameraPose& pose = flake.camera.pose;
  std::string scene = fmt::format(
      "b {}\nv\nfrom {}\nat {}\nup {}\nangle {}\nhither 0.01\nresolution 512 512\n",
      text(background), text(pose.eye), text(pose.look_at), text(pose.up), flake.camera.fov);
  for (const Vec3f& light : lights) scene += "l " + text(light) + "\n";
  scene += nff_material(ground) + "p 4\n";
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    scene += text(Vec3d{x * floor_reach, y * floor_reach, floor_height}) + "\n";
  }
  scene += nff_material(ball);
  for (const Sphere& sphere : flake.spheres) {
    scene += fmt::format("s {} {:.9g}\n", text(sphere.center), sphere.radius);
  }
  return scene;
}

std::string as_tachyon(const BenchScene& flake, Floor floor, int side, int ray_depth) {
  const CameraPose& pose = flake.camera.pose;
  const double zoom = 0.5 / std::tan(static_cast<double>(flake.camera.fov) * std::acos(-1) / 360);
  std::string scene = fmt::format(
      "BEGIN_SCENE\nRESOLUTION {} {}\nCAMERA\nZOOM {:.17g}\nASPECTRATIO 1\nANTIALIASING 0\n"
      "RAYDEPTH {}\nCENTER {}\nVIEWDIR {}\nUPDIR {}\nEND_CAMERA\nBACKGROUND {}\n",
      side, side, zoom, ray_depth, text(mirrored(pose.eye)),
      text(mirrored(tachyon_view(flake.camera, side))), text(mirrored(pose.up)), text(background));
  for (const Vec3f& light : lights) {  // so small that no mirror shows them
    scene += fmt::format("LIGHT CENTER {} RAD 0.0001 COLOR {}\n", text(mirrored(light)),
                         text(gray(static_cast<float>(intensity()))));
  }
  scene += tachyon_texture("ground", ground) + tachyon_texture("ball", ball) + tachyon_floor(floor);
  for (const Sphere& sphere : flake.spheres) {
    scene += fmt::format("SPHERE CENTER {} RAD {:.9g} ball\n", text(mirrored(sphere.center)),
                         sphere.radius);
  }
  return scene + "END_SCENE\n";
}

std::string as_pov(const BenchScene& flake, int trace_level) {
  const CameraPose& pose = flake.camera.pose;
  // POV-Ray's world is left-handed as well: there it is the camera that is mirrored.
  std::string scene = fmt::format(
      "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} }}\n"
      "camera {{ location <{}> up y right -x sky <{}> angle {} look_at <{}> }}\n"
      "background {{ color rgb <{}> }}\n",
      trace_level, text(pose.eye, ","), text(pose.up, ","), flake.camera.fov,
      text(pose.look_at, ","), text(background, ","));
  for (const Vec3f& light : lights) {
    scene +=
        fmt::format("light_source {{ <{}> color rgb {:.9g} }}\n", text(light, ","), intensity());
  }
  scene += fmt::format("plane {{ z, {} {} }}\nunion {{\n", floor_height, pov_finish(ground));
  for (const Sphere& sphere : flake.spheres) {
    scene += fmt::format("sphere {{ <{}>, {:.9g} }}\n", text(sphere.center, ","), sphere.radius);
  }
  return scene + pov_finish(ball) + "\n}\n";
}

Color beyond_tachyons_last_mirror() { return background * ball.ks; }

}  // namespace boule::bench
