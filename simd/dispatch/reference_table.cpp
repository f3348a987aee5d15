#include <limits>
#include <vector>

#include "core/light_cone.h"
#include "core/math/geometry.h"
#include "core/math/sobol.h"
#include "core/math/warp.h"
#include "core/reference.h"
#include "core/scene/lens_optics.h"
#include "core/surface.h"
#include "simd/dispatch/dispatch.h"

namespace boule {
namespace {

Plane get_plane(const PlaneView& p, std::size_t i) {
  return {
      {p.point_x[i], p.point_y[i], p.point_z[i]}, {p.normal_x[i], p.normal_y[i], p.normal_z[i]}, 0};
}

/// The geometry back as plain primitives in the order of their ids: what the reference path reads.
/// Copies of a sphere that the tree's builder left out have no radius: nothing hits them.
struct Primitives {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;

  explicit Primitives(const GeometryView& view) {
    const SphereView& s = view.spheres;
    const Sphere nowhere{{0, 0, 0}, std::numeric_limits<float>::quiet_NaN(), 0};
    spheres.resize(static_cast<std::size_t>(view.planes.first_id), nowhere);
    for (std::size_t slot = 0; slot < s.block_count * bvh_leaf_size; ++slot) {
      if (s.id[slot] < 0) continue;
      const SphereBlock& block = s.blocks[slot / bvh_leaf_size];
      const std::size_t k = slot % bvh_leaf_size;
      spheres[static_cast<std::size_t>(s.id[slot])] = {
          {block.center_x[k], block.center_y[k], block.center_z[k]}, block.radius[k], 0};
    }
    const PlaneView& p = view.planes;
    for (std::size_t i = 0; i < p.size; ++i) planes.push_back(get_plane(p, i));
  }
};

Ray get_ray(const RayStream& rays, std::size_t i) {
  Ray ray{{rays.org_x[i], rays.org_y[i], rays.org_z[i]},
          {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]}};
  ray.tmin = rays.tmin[i];
  ray.tmax = rays.tmax[i];
  ray.source = rays.source[i];
  ray.inside = rays.inside[i] != 0;
  return ray;
}

void set_ray(const RayStream& rays, std::size_t i, const Ray& ray) {
  rays.org_x[i] = ray.org.x;
  rays.org_y[i] = ray.org.y;
  rays.org_z[i] = ray.org.z;
  rays.dir_x[i] = ray.dir.x;
  rays.dir_y[i] = ray.dir.y;
  rays.dir_z[i] = ray.dir.z;
  rays.tmin[i] = ray.tmin;
  rays.tmax[i] = ray.tmax;
  rays.source[i] = ray.source;
  rays.inside[i] = ray.inside ? 1 : 0;
}

CameraBasis basis_of(const CameraView& view) {
  const auto vec = [](const double(&v)[3]) { return Vec3d{v[0], v[1], v[2]}; };
  return {vec(view.eye),
          vec(view.forward),
          vec(view.right),
          vec(view.up),
          view.kind,
          {view.scale_x, view.offset_x, view.extent_x},
          {view.scale_y, view.offset_y, view.extent_y},
          vec(view.lens_right),
          vec(view.lens_up),
          view.inverse_focus,
          {view.map, view.map_width, view.map_height},
          nullptr};
}

LensOptics optics_of(const LensView& view) {
  LensOptics optics{{},
                    view.rear,
                    view.film,
                    view.half_width,
                    view.half_height,
                    view.scale,
                    {},
                    view.rings_per_length,
                    view.exposure};
  for (int i = 0; i < view.element_count; ++i) {
    const LensElementView& e = view.elements[i];
    optics.elements.push_back({e.radius, e.place, e.aperture2, e.eta});
  }
  for (int i = 0; i < view.ring_count; ++i) {
    const auto& [inner, outer] = view.pupil[i];
    optics.pupil.push_back({{inner.x0, inner.x1, inner.y}, {outer.x0, outer.x1, outer.y}});
  }
  return optics;
}

void primary_rays(const CameraView& camera, const SampleStream& samples, const RayStream& rays) {
  CameraBasis basis = basis_of(camera);
  const LensOptics optics = optics_of(camera.lens);
  basis.optics = &optics;
  for (std::size_t i = 0; i < samples.size; ++i) {
    reference::CameraSample sample{samples.raster_x[i], samples.raster_y[i]};
    if (has_lens(camera.kind)) {
      sample.lens_x = samples.lens_x[i];
      sample.lens_y = samples.lens_y[i];
    }
    const reference::CameraRay made = reference::camera_ray(basis, sample);
    set_ray(rays, i, made.ray);
    if (camera.weighs) samples.weight[i] = made.weight;
  }
}

void closest_hit(const GeometryView& geometry, const RayStream& rays, const Query&,
                 const HitStream& hits) {
  const Primitives all(geometry);
  for (std::size_t i = 0; i < rays.size; ++i) {
    const Hit hit = reference::closest_hit(get_ray(rays, i), all.spheres, all.planes);
    hits.t[i] = hit.t;
    hits.id[i] = hit.id;
  }
}

void any_hit(const GeometryView& geometry, const RayStream& rays, const Query&,
             std::uint8_t* occluded) {
  const Primitives all(geometry);
  for (std::size_t i = 0; i < rays.size; ++i) {
    occluded[i] = reference::any_hit(get_ray(rays, i), all.spheres, all.planes) ? 1 : 0;
  }
}

void set(const VectorStream& vectors, std::size_t i, const Vec3d& v) {
  vectors.x[i] = v.x;
  vectors.y[i] = v.y;
  vectors.z[i] = v.z;
}

Vec3d get(const VectorStream& vectors, std::size_t i) {
  return {vectors.x[i], vectors.y[i], vectors.z[i]};
}

Surface find_surface(const GeometryView& geometry, const SphereRows& spheres, const Ray& ray,
                     const Hit& hit) {
  const PlaneView& planes = geometry.planes;
  if (hit.id >= planes.first_id) {
    return find_surface(get_plane(planes, static_cast<std::size_t>(hit.id - planes.first_id)), ray,
                        hit);
  }
  const float* row = spheres.first + static_cast<std::size_t>(hit.id) * spheres.stride;
  return find_surface(Sphere{{row[0], row[1], row[2]}, row[3], 0}, ray, hit);
}

void find_surfaces(const GeometryView& geometry, const SphereRows& spheres, const RayStream& rays,
                   const HitStream& hits, const SurfaceStream& surfaces) {
  for (std::size_t i = 0; i < rays.size; ++i) {
    if (hits.id[i] == no_primitive) continue;
    const Surface surface =
        find_surface(geometry, spheres, get_ray(rays, i), {hits.t[i], hits.id[i]});
    const Departure departure = depart(surface, Side::viewer);
    set(surfaces.point, i, surface.point);
    set(surfaces.normal, i, surface.normal);
    set(surfaces.view, i, surface.view);
    set(surfaces.mirrored, i, surface.mirrored);
    set(surfaces.org, i, departure.org);
    surfaces.cosine[i] = surface.cosine;
    surfaces.reach[i] = surface.reach;
    surfaces.inner[i] = surface.inner ? 1 : 0;
    surfaces.inside[i] = departure.inside ? 1 : 0;
  }
}

std::size_t aim(const LightPlace& light, const LitStream& points, const AimedStream& aimed) {
  const Vec3d place{light.place[0], light.place[1], light.place[2]};
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size; ++i) {
    const Vec3d to_light = light.directional ? place : normalize(place - get(points.point, i));
    const double cosine = dot(get(points.normal, i), to_light);
    if (points.lit[i] == 0 || !(cosine > 0)) continue;
    const Vec3d org = get(points.org, i);
    Ray ray = light.directional ? Ray{org, {light.way[0], light.way[1], light.way[2]}}
                                : segment(org, place);
    ray.source = points.id[i];
    ray.inside = points.inside[i] != 0;
    set_ray(aimed.rays, count, ray);
    set(aimed.to_light, count, to_light);
    aimed.cosine[count] = cosine;
    aimed.point[count] = static_cast<std::uint32_t>(i);
    ++count;
  }
  return count;
}

void sobol_points(const SobolStream& points) {
  for (std::size_t i = 0; i < points.size; ++i) {
    const SobolSeeds seeds{points.shuffle[i], points.seed_u[i], points.seed_v[i]};
    const auto [u, v] = sobol_point(seeds, points.sample[i]);
    points.u[i] = u;
    points.v[i] = v;
  }
}

void turn(const TurnStream& turns) {
  for (std::size_t i = 0; i < turns.size; ++i) {
    const Angle from{turns.cosine[i], turns.sine[i]};
    set(turns.direction, i, direction_about(get(turns.axis, i), from, turns.turns[i]));
  }
}

void seek(const SeekStream& seekers) {
  for (std::size_t i = 0; i < seekers.size; ++i) {
    const LightCone cone(get(seekers.org, i), get(seekers.center, i), seekers.radius[i]);
    const Vec3d direction = cone.direction({seekers.u[i], seekers.v[i]});
    set(seekers.direction, i, direction);
    seekers.density[i] = cone.density();
    seekers.tmax[i] = cone.way(direction).tmax;
  }
}

}  // namespace

const KernelTable& reference_kernels() {
  static const KernelTable table = {Isa::scalar,   1,   primary_rays, closest_hit, any_hit,
                                    find_surfaces, aim, sobol_points, turn,        seek};
  return table;
}

}  // namespace boule
