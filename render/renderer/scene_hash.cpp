#include "render/renderer/scene_hash.h"

#include <bit>
#include <functional>
#include <type_traits>
#include <variant>

#include "core/base/float_environment.h"
#include "core/math/random.h"
#include "core/scene/instances.h"

namespace boule {
namespace {

/// Takes values one after the other, each in 64 bits.
class Hasher {
 public:
  void add(std::uint64_t word) { state_ = mix64(state_ + word) + golden_step; }
  void add(float x) { add(std::uint64_t{std::bit_cast<std::uint32_t>(x)}); }
  void add(const Vec3f& v) { add_all(v.x, v.y, v.z); }
  void add(const Color& c) { add_all(c.r, c.g, c.b); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Enum value) { add(static_cast<std::uint64_t>(value)); }

  void add(const ConstantBackground& b) { add(b.color); }
  void add(const GradientBackground& b) { add_all(b.bottom, b.top, b.up); }
  void add(const EnvironmentBackground& b) {
    add_all(std::uint64_t(b.width), std::uint64_t(b.height), b.pixels, b.rotation);
  }
  void add(const CameraPose& p) { add_all(p.eye, p.look_at, p.up); }
  void add(const PinholeCamera& c) { add_all(c.pose, c.fov, c.fov_axis); }
  void add(const OrthographicCamera& c) { add_all(c.pose, c.height); }
  void add(const FisheyeCamera& c) { add_all(c.pose, c.fov, c.fov_axis); }
  void add(const ThinLensCamera& c) {
    add_all(c.pose, c.fov, c.fov_axis, c.aperture, std::uint64_t{c.focus.has_value()});
    if (c.focus) add(*c.focus);
  }
  void add(const LensSurface& s) { add_all(s.radius, s.thickness, s.index, s.aperture); }
  void add(const LensCamera& c) {
    add_all(c.pose, c.surfaces, c.film_width, c.scale, std::uint64_t{c.focus.has_value()});
    if (c.focus) add(*c.focus);
  }
  void add(const DistortionMap& d) {
    add_all(std::uint64_t(d.width), std::uint64_t(d.height), d.st);
  }
  void add(const PointLight& l) { add_all(l.position, l.intensity, l.falloff); }
  void add(const DirectionalLight& l) { add_all(l.direction, l.intensity); }
  void add(const SphereLight& l) { add_all(l.center, l.radius, l.radiance); }
  void add(const Matte& m) { add(m.color); }
  void add(const Plastic& m) { add_all(m.color, m.specular, m.shininess, m.reflect); }
  void add(const Metal& m) { add(m.color); }
  void add(const Glass& m) { add_all(m.color, m.ior); }
  void add(const Emissive& m) { add(m.radiance); }
  void add(const Phong& m) {
    add_all(m.color, m.ka, m.kd, m.ks, m.shininess, m.transmission, m.ior);
  }
  void add(const NamedMaterial& m) { add(m.material); }
  void add(const Sphere& s) { add_all(s.center, s.radius, std::uint64_t{s.material}); }
  void add(const Plane& p) { add_all(p.point, p.normal, std::uint64_t{p.material}); }

  template <class... Kinds>
  void add(const std::variant<Kinds...>& one_of) {
    add(std::uint64_t{one_of.index()});
    std::visit([this](const auto& value) { this->add(value); }, one_of);
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(std::uint64_t{list.size()});
    for (const T& one : list) add(one);
  }

  template <class... Values>
  void add_all(const Values&... values) {
    (add(values), ...);
  }

  [[nodiscard]] std::uint64_t value() const { return mix64(state_); }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace

std::uint64_t scene_hash(const Scene& scene) {
  const FloatEnvironment environment;
  Hasher hash;
  hash.add(std::uint64_t{scene.camera.has_value()});
  if (scene.camera) hash.add(*scene.camera);
  if (scene.distortion) hash.add(*scene.distortion);
  hash.add_all(scene.background, scene.ambient, scene.materials, scene.lights);
  const PrimitiveCount count = count_primitives(scene);
  hash.add(count.spheres);
  for (const Sphere& sphere : scene.spheres) hash.add(sphere);
  visit_shown(scene, std::function([&hash](const Sphere& sphere) { hash.add(sphere); }));
  hash.add(count.planes);
  for (const Plane& plane : scene.planes) hash.add(plane);
  visit_shown(scene, std::function([&hash](const Plane& plane) { hash.add(plane); }));
  return hash.value();
}

}  // namespace boule
