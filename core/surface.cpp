#include "core/surface.h"

#include "core/optics/incidence.h"

namespace boule {
namespace {

ArrivalOf<double> arrive(const Ray& ray, const Hit& hit) {
  const Vec3d dir = vec_cast<double>(ray.dir);
  return {ray.org, dir, ray.org + dir * hit.t, hit.id == ray.source, ray.tmin == 0};
}

ContactOf<double> meet(const Sphere& sphere, const ArrivalOf<double>& ray) {
  return meet_sphere(ray, vec_cast<double>(sphere.center), double{sphere.radius});
}
ContactOf<double> meet(const Plane& plane, const ArrivalOf<double>& ray) {
  return meet_plane(ray, vec_cast<double>(plane.point), vec_cast<double>(plane.normal));
}
ContactOf<double> meet(const Capsule& capsule, const ArrivalOf<double>& ray) {
  const Vec3d a = vec_cast<double>(capsule.a);
  return meet_capsule(ray, a, vec_cast<double>(capsule.b) - a, double{capsule.radius});
}

/// facing_normal(), which seldom needs the view.
template <class Primitive>
Vec3d normal_of(const Primitive& primitive, const Ray& ray, const Hit& hit) {
  const auto arrival = arrive(ray, hit);
  const auto contact = meet(primitive, arrival);
  if (all_finite(contact.outward)) return turned_normal(contact);
  return facing_normal(contact, normalize(arrival.dir));
}

Surface surface_of(const ArrivalOf<double>& ray, const ContactOf<double>& contact, const Hit& hit,
                   bool solid) {
  const Vec3d view = normalize(ray.dir), normal = facing_normal(contact, view);
  const double cosine = facing_cosine(normal, view);
  return {.point = ray.point,
          .normal = normal,
          .view = view,
          .mirrored = mirror(view, normal, cosine),
          .cosine = cosine,
          .reach = contact.reach,
          .id = hit.id,
          .inner = contact.inner,
          .solid = solid};
}

}  // namespace

Surface find_surface(const Sphere& sphere, const Ray& ray, const Hit& hit) {
  const auto arrival = arrive(ray, hit);
  return surface_of(arrival, meet(sphere, arrival), hit, true);
}

Surface find_surface(const Plane& plane, const Ray& ray, const Hit& hit) {
  const auto arrival = arrive(ray, hit);
  return surface_of(arrival, meet(plane, arrival), hit, false);
}

Surface find_surface(const Capsule& capsule, const Ray& ray, const Hit& hit) {
  const auto arrival = arrive(ray, hit);
  return surface_of(arrival, meet(capsule, arrival), hit, true);
}

Vec3d find_normal(const Sphere& sphere, const Ray& ray, const Hit& hit) {
  return normal_of(sphere, ray, hit);
}
Vec3d find_normal(const Plane& plane, const Ray& ray, const Hit& hit) {
  return normal_of(plane, ray, hit);
}
Vec3d find_normal(const Capsule& capsule, const Ray& ray, const Hit& hit) {
  return normal_of(capsule, ray, hit);
}

Surface find_surface(std::span<const Sphere> spheres, std::span<const Plane> planes, const Ray& ray,
                     const Hit& hit) {
  const auto i = static_cast<std::uint32_t>(hit.id);
  if (i < spheres.size()) return find_surface(spheres[i], ray, hit);
  return find_surface(planes[i - spheres.size()], ray, hit);
}

Departure depart(const Surface& surface, Side side) {
  const Vec3d& normal = surface.normal;
  // The ray continues within a solid if it came from within and returns, or comes in from outside.
  return {move_off(surface.point, side == Side::viewer ? normal : -normal, surface.reach),
          surface.id, surface.solid && surface.inner == (side == Side::viewer)};
}

Ray leave(const Surface& surface, Side side, const Vec3d& direction) {
  const Departure departure = depart(surface, side);
  return from_surface({departure.org, vec_cast<float>(direction)}, departure);
}

Vec3f float_point(const Ray& ray, const Hit& hit) {
  return vec_cast<float>(ray.org) + ray.dir * static_cast<float>(hit.t);
}

Ray start_by_epsilon(Ray shadow_ray, const Vec3f& point, float epsilon) {
  const double size = length(vec_cast<double>(shadow_ray.dir));
  shadow_ray.org = vec_cast<double>(point);
  shadow_ray.tmin = static_cast<float>(double{epsilon} / size);
  shadow_ray.source = no_primitive;
  shadow_ray.inside = false;
  return shadow_ray;
}

Ray shadow_ray_to(const Surface& surface, const Vec3d& light) {
  const Departure departure = depart(surface, Side::viewer);
  return from_surface(segment(departure.org, light), departure);
}

}  // namespace boule
