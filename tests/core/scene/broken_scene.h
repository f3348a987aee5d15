#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "core/scene/scene.h"

namespace boule::test {

inline constexpr float inf = std::numeric_limits<float>::infinity();
inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// One of everything, all of it valid.
inline Scene full_scene() {
  Scene scene;
  scene.camera = PinholeCamera{{{0, 1, 6}, {0, 1, 0}, {0, 1, 0}}, 40, FovAxis::x};
  scene.background = GradientBackground{};
  scene.materials = {{"matte", Matte{}}, {"plastic", Plastic{}},   {"metal", Metal{}},
                     {"glass", Glass{}}, {"emissive", Emissive{}}, {"phong", Phong{}},
                     {"ghost", Ghost{}}};
  scene.lights = {PointLight{{4, 6, 4}, {1, 1, 1}, Falloff::none}, DirectionalLight{},
                  SphereLight{}};
  scene.spheres = {{{0, 1, 0}, 1, 0}, {{2, 1, 0}, 0.5f, 5}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 1}};
  return scene;
}

inline PinholeCamera& pinhole(Scene& scene) { return std::get<PinholeCamera>(*scene.camera); }
inline OrthographicCamera& orthographic(Scene& scene) {
  scene.camera = OrthographicCamera{pinhole(scene).pose, 2};
  return std::get<OrthographicCamera>(*scene.camera);
}
/// A way to break a scene, the key that must be named and a part of the message.
struct Breakage {
  const char* name;
  const char* key;
  const char* message;
  std::function<void(Scene&)> apply;
};

inline std::ostream& operator<<(std::ostream& out, const Breakage& b) { return out << b.name; }

class ValidateRefuses : public testing::TestWithParam<Breakage> {};

inline std::string name_of(const testing::TestParamInfo<Breakage>& info) { return info.param.name; }

inline constexpr char not_negative[] = "must be finite and 0 or above";
inline constexpr char positive[] = "must be finite and above 0";
inline constexpr char finite[] = "must be finite";

}  // namespace boule::test
