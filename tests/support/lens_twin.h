#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/math/vec.h"
#include "core/scene/lens.h"

/// A lens traced a second time: in long double, by other formulas, with nothing of core's but the
/// prescription.
namespace boule::test {

using Vec3l = Vec3<long double>;

inline long double dot_of(const Vec3l& a, const Vec3l& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The middle of each surface on the axis, the first at 0.
inline std::vector<long double> vertices_of(const LensCamera& camera) {
  std::vector<long double> z;
  long double place = 0;
  for (const LensSurface& surface : camera.surfaces) {
    z.push_back(place);
    place += static_cast<long double>(surface.thickness);
  }
  return z;
}

/// A ray of the twin in the lens' space; not `there` once it is stopped.
struct TwinRay {
  Vec3l org, dir;
  bool there = true;
};

/// Through surface i, between media of these indices: the textbook's quadratic, the root nearer to
/// the vertex, and the tangential part of the direction stretched by Snell's law.
inline void pass(TwinRay& ray, const LensSurface& surface, long double vertex, long double from,
                 long double to) {
  const long double radius = surface.radius;
  long double t = (vertex - ray.org.z) / ray.dir.z;
  Vec3l normal{0, 0, 1};
  if (radius != 0) {
    const Vec3l o = ray.org - Vec3l{0, 0, vertex + radius};
    const long double b = 2 * dot_of(o, ray.dir), c = dot_of(o, o) - radius * radius;
    const long double discriminant = b * b - 4 * c;
    ray.there = ray.there && discriminant >= 0;
    const long double root = std::sqrt(discriminant);
    const long double first = (-b - root) / 2, second = (-b + root) / 2;
    const auto off = [&](long double at) { return std::fabs(ray.org.z + at * ray.dir.z - vertex); };
    t = off(first) < off(second) ? first : second;
    normal = (o + ray.dir * t) * (1 / radius);
  }
  ray.org = ray.org + ray.dir * t;
  const long double half = static_cast<long double>(surface.aperture) / 2;
  ray.there = ray.there && ray.org.x * ray.org.x + ray.org.y * ray.org.y <= half * half;
  const long double along = dot_of(ray.dir, normal);
  const Vec3l aside = (ray.dir - normal * along) * (from / to);
  const long double left = 1 - dot_of(aside, aside);
  ray.there = ray.there && left >= 0;
  ray.dir = aside + normal * std::copysign(std::sqrt(left), along);
}

inline void to_scene(TwinRay& ray, const LensCamera& camera) {
  const auto z = vertices_of(camera);
  for (std::size_t i = z.size(); i-- > 0;) {
    const auto index = [&](std::size_t k) {
      return static_cast<long double>(camera.surfaces[k].index);
    };
    pass(ray, camera.surfaces[i], z[i], index(i), i == 0 ? 1.0L : index(i - 1));
  }
}

inline void to_film(TwinRay& ray, const LensCamera& camera) {
  const auto z = vertices_of(camera);
  long double index = 1;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto next = static_cast<long double>(camera.surfaces[i].index);
    pass(ray, camera.surfaces[i], z[i], index, next);
    index = next;
  }
}

/// The film's position on the axis for an object in focus at this distance before the first
/// surface: the point where a ray that leaves the object's point on the axis, at a slope of a
/// millionth, crosses the axis again.
inline long double film_place(const LensCamera& camera, long double distance) {
  TwinRay ray{{0, 0, -distance}, {1e-6L, 0, std::sqrt(1 - 1e-12L)}};
  to_film(ray, camera);
  return ray.org.z - ray.org.x * ray.dir.z / ray.dir.x;
}

/// Whether a ray passes that leaves the film at (r, 0) towards the lens; u and v are its
/// direction's cosines with x and y.
inline bool passes(const LensCamera& camera, long double film, long double r, long double u,
                   long double v) {
  const long double along2 = 1 - u * u - v * v;
  if (!(along2 > 0)) return false;
  TwinRay ray{{r, 0, film}, {u, v, -std::sqrt(along2)}};
  to_scene(ray, camera);
  return ray.there;
}

/// The light of a white world on the film at (r, 0): the integral of cos over the directions that
/// pass. That is the area which these directions fill in the plane of direction cosines. Times the
/// squared distance of the film from the last surface it equals the integral of cos^4 over the exit
/// pupil. The area is found along `lines` lines from the direction of the rear vertex, around which
/// the pupil lies: each line's edges are searched in `steps` steps and then bisected to the last
/// digit.
inline long double gathered_on(const LensCamera& camera, long double film, long double r, int lines,
                               int steps) {
  constexpr long double pi = 3.14159265358979323846264338L;
  const long double distance = film - vertices_of(camera).back();
  const long double middle = -r / std::hypot(r, distance);
  const long double half = static_cast<long double>(camera.surfaces.back().aperture) / 2;
  const long double farthest = std::fmin(1.5L * half / distance, 1 - std::fabs(middle));
  long double area = 0;
  for (int line = 0; line < lines; ++line) {
    const long double angle = 2 * pi * (line + 0.5L) / lines;
    const auto there = [&](long double s) {
      return passes(camera, film, r, middle + s * std::cos(angle), s * std::sin(angle));
    };
    bool within = there(0);
    // Steps grow with the distance: narrow pupils have edges too.
    const auto step = [&](int i) { return farthest * std::pow(1e-5L, 1 - 1.0L * i / steps); };
    for (int i = 1; i <= steps; ++i) {
      if (there(step(i)) == within) continue;
      long double low = step(i - 1), high = step(i);
      for (int k = 0; k < 64; ++k) {
        const long double at = (low + high) / 2;
        (there(at) == within ? low : high) = at;
      }
      area += (within ? 1 : -1) * high * high / 2 * (2 * pi / lines);
      within = !within;
    }
  }
  return area * distance * distance;
}

}  // namespace boule::test
