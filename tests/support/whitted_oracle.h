#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "core/scene/scene.h"

namespace boule::test {

/// Linear RGB in double.
struct Rgb {
  double r = 0, g = 0, b = 0;

  Rgb() = default;
  Rgb(double red, double green, double blue) : r(red), g(green), b(blue) {}
  explicit Rgb(const Color& c)
      : r(static_cast<double>(c.r)), g(static_cast<double>(c.g)), b(static_cast<double>(c.b)) {}
  explicit Rgb(double value) : Rgb(value, value, value) {}
};
inline Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator*(const Rgb& a, const Rgb& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Rgb operator*(const Rgb& a, double s) { return {a.r * s, a.g * s, a.b * s}; }

/// Whitted shading as the written rules have it: recursive, in double, one ray at a time. Shares
/// nothing with the renderer but core: no streams, no flattened materials, no origin offset (a ray
/// that leaves a primitive only names it).
class WhittedOracle {
 public:
  explicit WhittedOracle(const Scene& scene) : scene_(scene) {}

  /// What arrives along `ray`, with `bounces` more allowed.
  [[nodiscard]] Rgb trace(const Ray& ray, int bounces) const {
    const Hit hit = reference::closest_hit(ray, scene_.spheres, scene_.planes);
    const Vec3d view = normalize(vec_cast<double>(ray.dir));
    if (hit.id == no_primitive) return miss(view);
    const Local local = locate(ray, hit, view);
    return std::visit([&](const auto& m) { return shade(m, local, bounces); },
                      scene_.materials[local.material].material);
  }

 private:
  /// A hit, with everything that the shading rules use.
  struct Local {
    Vec3d p, n, v, r;  ///< point, normal towards the viewer, view direction, its mirror image
    std::int32_t id;
    bool back;  ///< seen from inside a sphere, or from a plane's back
    bool sphere;
    std::size_t material;
  };

  [[nodiscard]] Rgb miss(const Vec3d& view) const {
    if (const auto* constant = std::get_if<ConstantBackground>(&scene_.background)) {
      return Rgb(constant->color);
    }
    if (const auto* around = std::get_if<EnvironmentBackground>(&scene_.background)) {
      return seen_in(*around, view);
    }
    const auto& sky = std::get<GradientBackground>(scene_.background);
    const double s = (1 + dot(view, normalize(vec_cast<double>(sky.up)))) / 2;
    return Rgb(sky.bottom) + (Rgb(sky.top) + Rgb(sky.bottom) * -1) * s;
  }

  /// The environment's picture, bilinear between its pixels' centres. Columns are counted from the
  /// middle to the right and wrap around, rows from straight up downwards and end at the first and
  /// the last.
  static Rgb seen_in(const EnvironmentBackground& image, const Vec3d& view) {
    constexpr double degree = std::numbers::pi / 180;
    const double to_right =
        std::atan2(view.x, -view.z) / degree - static_cast<double>(image.rotation);
    const double down = std::acos(std::clamp(view.y, -1.0, 1.0)) / degree;
    const double x = (to_right + 180) / 360 * image.width - 0.5;
    const double y = std::clamp(down / 180 * image.height - 0.5, 0.0, image.height - 1.0);
    Rgb sum;
    for (int corner = 0; corner < 4; ++corner) {
      const double i = std::floor(x) + corner % 2, j = std::floor(y) + corner / 2;
      const double share = (1 - std::fabs(x - i)) * (1 - std::fabs(y - j));
      if (share == 0) continue;
      const double column = i - image.width * std::floor(i / image.width);
      sum = sum + Rgb(image.pixels.at(static_cast<std::size_t>(j * image.width + column))) * share;
    }
    return sum;
  }

  [[nodiscard]] Local locate(const Ray& ray, const Hit& hit, const Vec3d& view) const {
    Local at{};
    at.id = hit.id;
    at.v = view;
    at.p = ray.org + vec_cast<double>(ray.dir) * hit.t;
    const auto i = static_cast<std::size_t>(hit.id);
    at.sphere = i < scene_.spheres.size();
    if (at.sphere) {
      at.n = normalize(at.p - vec_cast<double>(scene_.spheres[i].center));
      at.material = scene_.spheres[i].material.index();
    } else {
      const Plane& plane = scene_.planes[i - scene_.spheres.size()];
      at.n = normalize(vec_cast<double>(plane.normal));
      at.material = plane.material.index();
    }
    at.back = dot(at.n, view) > 0;
    if (at.back) at.n = -at.n;
    at.r = view - at.n * (2 * dot(at.n, view));
    return at;
  }

  /// What the reflected (or refracted) ray brings; 0 when no bounce is left.
  [[nodiscard]] Rgb follow(const Local& at, const Vec3d& direction, bool through,
                           int bounces) const {
    if (bounces == 0) return {};
    Ray ray = leaving(at, through);
    ray.dir = vec_cast<float>(direction);
    return trace(ray, bounces - 1);
  }
  static Ray leaving(const Local& at, bool through) {
    Ray ray;
    ray.org = at.p;
    ray.source = at.id;
    ray.inside = at.sphere && at.back != through;
    return ray;
  }

  [[nodiscard]] bool lit(const Ray& ray) const {
    return !reference::any_hit(ray, scene_.spheres, scene_.planes);
  }

  [[nodiscard]] Rgb direct(const Local& at, const Rgb& color, double kd, double ks,
                           double shininess) const {
    Rgb sum;
    for (const Light& light : scene_.lights) {
      Ray shadow = leaving(at, false);
      Vec3d l;
      Rgb intensity;
      if (const auto* point = std::get_if<PointLight>(&light)) {
        const Vec3d way = vec_cast<double>(point->position) - at.p;
        l = normalize(way);
        intensity = Rgb(point->intensity);
        if (point->falloff == Falloff::inverse_square) intensity = intensity * (1 / dot(way, way));
        shadow.dir = vec_cast<float>(way);
        shadow.tmax = 1 - 0x1p-22f;
      } else if (const auto* sphere = std::get_if<SphereLight>(&light)) {
        const Vec3d way = vec_cast<double>(sphere->center) - at.p;
        const auto r = static_cast<double>(sphere->radius);
        l = normalize(way);
        intensity = Rgb(sphere->radiance) * (r * r / dot(way, way));
        shadow.dir = vec_cast<float>(way);
        shadow.tmax = 1 - 0x1p-22f;
      } else {
        const auto& sun = std::get<DirectionalLight>(light);
        l = normalize(-vec_cast<double>(sun.direction));
        intensity = Rgb(sun.intensity);
        shadow.dir = -sun.direction;
      }
      const double n_l = dot(at.n, l), r_l = dot(at.r, l);
      if (!(n_l > 0) || !lit(shadow)) continue;
      sum = sum + color * intensity * (kd * n_l);
      if (shininess > 0 && r_l > 0) sum = sum + intensity * (ks * std::pow(r_l, shininess));
    }
    return sum;
  }

  /// Cosine of the angle beyond, or a negative number at total internal reflection.
  static double cosine_beyond(double cosine, double eta) {
    const double squared = 1 - eta * eta * (1 - cosine * cosine);
    return squared > 0 ? std::sqrt(squared) : -1;
  }
  [[nodiscard]] Rgb refracted(const Local& at, double eta, double beyond, int bounces) const {
    const double cosine = -dot(at.n, at.v);
    return follow(at, at.v * eta + at.n * (eta * cosine - beyond), true, bounces);
  }

  [[nodiscard]] Rgb shade(const Matte& m, const Local& at, int) const {
    return Rgb(m.color) * Rgb(scene_.ambient) + direct(at, Rgb(m.color), 1, 0, 0);
  }
  [[nodiscard]] Rgb shade(const Plastic& m, const Local& at, int bounces) const {
    Rgb sum = Rgb(m.color) * Rgb(scene_.ambient) + direct(at, Rgb(m.color), 1,
                                                          static_cast<double>(m.specular),
                                                          static_cast<double>(m.shininess));
    if (m.reflect > 0)
      sum = sum + follow(at, at.r, false, bounces) * static_cast<double>(m.reflect);
    return sum;
  }
  [[nodiscard]] Rgb shade(const Metal& m, const Local& at, int bounces) const {
    return Rgb(m.color) * follow(at, at.r, false, bounces);
  }
  [[nodiscard]] Rgb shade(const Glass& m, const Local& at, int bounces) const {
    // Fresnel's equations with the indices on both sides written out.
    const double n1 = at.back ? static_cast<double>(m.ior) : 1.0,
                 n2 = at.back ? 1.0 : static_cast<double>(m.ior);
    const double c1 = -dot(at.n, at.v), c2 = cosine_beyond(c1, n1 / n2);
    if (c2 < 0) return follow(at, at.r, false, bounces);
    const double s = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
    const double p = (n1 * c2 - n2 * c1) / (n1 * c2 + n2 * c1);
    const double f = (s * s + p * p) / 2;
    return follow(at, at.r, false, bounces) * f +
           Rgb(m.color) * refracted(at, n1 / n2, c2, bounces) * (1 - f);
  }
  [[nodiscard]] Rgb shade(const Emissive& m, const Local&, int) const { return Rgb(m.radiance); }
  /// Rays of the oracle meet no ghost.
  [[nodiscard]] Rgb shade(const Ghost&, const Local&, int) const { return {}; }
  [[nodiscard]] Rgb shade(const Phong& m, const Local& at, int bounces) const {
    Rgb sum = Rgb(m.color) * (Rgb(static_cast<double>(m.ka)) + Rgb(scene_.ambient)) +
              direct(at, Rgb(m.color), static_cast<double>(m.kd), static_cast<double>(m.ks),
                     static_cast<double>(m.shininess));
    auto mirror = static_cast<double>(m.ks);
    if (m.transmission > 0) {
      const double eta = at.back ? static_cast<double>(m.ior) : 1 / static_cast<double>(m.ior);
      const double beyond = cosine_beyond(-dot(at.n, at.v), eta);
      if (beyond < 0) {
        mirror += static_cast<double>(m.transmission);
      } else {
        sum = sum + refracted(at, eta, beyond, bounces) * static_cast<double>(m.transmission);
      }
    }
    if (mirror > 0) sum = sum + follow(at, at.r, false, bounces) * mirror;
    return sum;
  }

  const Scene& scene_;
};

}  // namespace boule::test
