#include "core/surface.h"

#include <algorithm>
#include <cmath>

#include "core/math/geometry.h"

namespace boule {
namespace {

/// p64 is known to 2^-49 of the distances that made it, axis by axis.
constexpr double relative_error = 0x1p-49;

void set_normal(Surface& surface, const Vec3d& outward) {
  const Vec3d normal = surface.inner ? -outward : outward;
  // A sphere too small for its place: the point is its centre, any normal is right. Face the ray.
  surface.normal = is_finite(normal) ? normal : -surface.view;
}

void meet_sphere(Surface& surface, const Sphere& sphere, const Ray& ray) {
  const Vec3d center = vec_cast<double>(sphere.center);
  const Vec3d f = center - ray.org;
  const auto r = static_cast<double>(sphere.radius);
  const double ff = dot(f, f);
  surface.sphere = true;
  surface.reach = std::sqrt(ff) + r;
  const Vec3d outward = surface.point - center;
  // From where the ray started, not from the angle: the solver took the second root for the same
  // sign of the same expression, so a grazing ray cannot change sides. A ray that begins elsewhere
  // than at its origin may meet the other root: there the angle tells.
  const bool starts_inside = surface.id == ray.source || ff - r * r <= 0;
  surface.inner = ray.tmin == 0 ? starts_inside : dot(outward, vec_cast<double>(ray.dir)) > 0;
  set_normal(surface, normalize(outward));
}

void meet_plane(Surface& surface, const Plane& plane, const Ray& ray) {
  const Vec3d n = vec_cast<double>(plane.normal);
  const Vec3d to_plane = vec_cast<double>(plane.point) - ray.org;
  surface.sphere = false;
  // The plane's own point may lie near the eye while the hit is far away: both count.
  surface.reach = length(to_plane) + length(surface.point - ray.org);
  surface.inner = dot(vec_cast<double>(ray.dir), n) > 0;
  set_normal(surface, normalize(n));
}

Vec3d moved_point(const Surface& surface, Side side) {
  const Vec3d& n = surface.normal;
  const double distance =
      (std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z)) * relative_error * surface.reach;
  return surface.point + n * (side == Side::viewer ? distance : -distance);
}

/// What the solver found, before the primitive is known; then what follows from its normal.
Surface arrive(const Ray& ray, const Hit& hit) {
  const Vec3d dir = vec_cast<double>(ray.dir);
  Surface surface{};
  surface.id = hit.id;
  surface.point = ray.org + dir * hit.t;
  surface.view = normalize(dir);
  return surface;
}
void mirror(Surface& surface) {
  surface.cosine = std::clamp(-dot(surface.normal, surface.view), 0.0, 1.0);
  surface.mirrored = surface.view + surface.normal * (2 * surface.cosine);
}

}  // namespace

Surface find_surface(const Sphere& sphere, const Ray& ray, const Hit& hit) {
  Surface surface = arrive(ray, hit);
  meet_sphere(surface, sphere, ray);
  mirror(surface);
  return surface;
}

Surface find_surface(const Plane& plane, const Ray& ray, const Hit& hit) {
  Surface surface = arrive(ray, hit);
  meet_plane(surface, plane, ray);
  mirror(surface);
  return surface;
}

Surface find_surface(std::span<const Sphere> spheres, std::span<const Plane> planes, const Ray& ray,
                     const Hit& hit) {
  const auto i = static_cast<std::size_t>(hit.id);
  if (i < spheres.size()) return find_surface(spheres[i], ray, hit);
  return find_surface(planes[i - spheres.size()], ray, hit);
}

Departure depart(const Surface& surface, Side side) {
  return {moved_point(surface, side), surface.id,
          surface.sphere && surface.inner == (side == Side::viewer)};
}

Ray leave(const Surface& surface, Side side, const Vec3d& direction) {
  const Departure departure = depart(surface, side);
  return from_surface({departure.org, vec_cast<float>(direction)}, departure);
}

Ray shadow_ray_to(const Surface& surface, const Vec3d& light) {
  const Departure departure = depart(surface, Side::viewer);
  return from_surface(segment(departure.org, light), departure);
}

}  // namespace boule
