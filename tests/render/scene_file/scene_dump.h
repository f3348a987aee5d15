#pragma once

#include <cstdio>
#include <string>

#include "core/scene/scene.h"

namespace boule::test {

/// A Scene as text with every field and every bit of its numbers: two scenes are the same where
/// their texts are, and a difference is readable.
class SceneDump {
 public:
  explicit SceneDump(const Scene& scene) {
    add("image", scene.image.width, scene.image.height, scene.image.spp,
        static_cast<int>(scene.image.filter));
    add("render", scene.render.max_depth, static_cast<int>(scene.render.method));
    if (scene.camera) std::visit([this](const auto& any) { dump(any); }, *scene.camera);
    if (scene.distortion) {
      add("distortion", scene.distortion->width, scene.distortion->height);
      for (const float x : scene.distortion->st) add("st", x);
    }
    std::visit([this](const auto& any) { dump(any); }, scene.background);
    add("ambient", scene.ambient);
    for (const NamedMaterial& named : scene.materials) {
      add("material " + named.name);
      std::visit([this](const auto& any) { dump(any); }, named.material);
    }
    for (const Light& light : scene.lights) {
      std::visit([this](const auto& any) { dump(any); }, light);
    }
    for (const Sphere& s : scene.spheres) add("sphere", s.center, s.radius, s.material);
    for (const Plane& p : scene.planes) add("plane", p.point, p.normal, p.material);
    for (const Group& g : scene.groups) {
      add("group " + g.name);
      for (const Sphere& s : g.spheres) add("sphere", s.center, s.radius, s.material);
      for (const Plane& p : g.planes) add("plane", p.point, p.normal, p.material);
      for (const Instance& i : g.instances) dump(i);
    }
    for (const Instance& i : scene.instances) dump(i);
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void dump(const Instance& i) {
    add("instance", i.group, i.translate, i.rotate, i.scale);
    if (i.material) add("material", *i.material);
  }
  void dump(const PinholeCamera& c) {
    add("pinhole", c.pose.eye, c.pose.look_at, c.pose.up, c.fov, static_cast<int>(c.fov_axis));
  }
  void dump(const OrthographicCamera& c) {
    add("orthographic", c.pose.eye, c.pose.look_at, c.pose.up, c.height);
  }
  void dump(const FisheyeCamera& c) {
    add("fisheye", c.pose.eye, c.pose.look_at, c.pose.up, c.fov, static_cast<int>(c.fov_axis));
  }
  void dump(const ThinLensCamera& c) {
    add("thin_lens", c.pose.eye, c.pose.look_at, c.pose.up, c.fov, static_cast<int>(c.fov_axis),
        c.aperture, c.focus.value_or(0.0f));
  }
  void dump(const LensCamera& c) {
    add("lens", c.pose.eye, c.pose.look_at, c.pose.up, c.film_width, c.scale,
        c.focus.value_or(0.0f));
    for (const LensSurface& s : c.surfaces) {
      add("surface", s.radius, s.thickness, s.index, s.aperture);
    }
  }
  void dump(const ConstantBackground& b) { add("constant", b.color); }
  void dump(const GradientBackground& b) { add("gradient", b.bottom, b.top, b.up); }
  void dump(const EnvironmentBackground& b) {
    add("environment", b.width, b.height, b.rotation);
    for (const Color& c : b.pixels) add("pixel", c);
  }
  void dump(const Matte& m) { add("matte", m.color); }
  void dump(const Plastic& m) { add("plastic", m.color, m.specular, m.shininess, m.reflect); }
  void dump(const Metal& m) { add("metal", m.color); }
  void dump(const Glass& m) { add("glass", m.color, m.ior); }
  void dump(const Emissive& m) { add("emissive", m.radiance); }
  void dump(const Phong& m) {
    add("phong", m.color, m.ka, m.kd, m.ks, m.shininess, m.transmission, m.ior);
  }
  void dump(const PointLight& l) {
    add("point", l.position, l.intensity, static_cast<int>(l.falloff));
  }
  void dump(const SphereLight& l) { add("sphere light", l.center, l.radius, l.radiance); }
  void dump(const DirectionalLight& l) { add("directional", l.direction, l.intensity); }

  template <class... Values>
  void add(const std::string& name, const Values&... values) {
    text_ += name;
    (put(values), ...);
    text_ += "\n";
  }
  void put(int value) { text_ += " " + std::to_string(value); }
  void put(std::uint32_t value) { text_ += " " + std::to_string(value); }
  void put(float value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, " %a", static_cast<double>(value));
    text_ += buffer;
  }
  void put(const Vec3f& v) { put(v.x), put(v.y), put(v.z); }
  void put(const Color& c) { put(c.r), put(c.g), put(c.b); }

  std::string text_;
};

inline std::string dump(const Scene& scene) { return SceneDump(scene).text(); }

}  // namespace boule::test
