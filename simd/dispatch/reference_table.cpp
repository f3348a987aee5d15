#include <vector>

#include "core/reference.h"
#include "core/scene/lens_optics.h"
#include "simd/dispatch/dispatch.h"

namespace boule {
namespace {

/// The geometry back as plain primitives in the order of their ids: what the reference path reads.
struct Primitives {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;

  explicit Primitives(const GeometryView& view) {
    const SphereView& s = view.spheres;
    spheres.resize(static_cast<std::size_t>(view.planes.first_id));
    for (std::size_t slot = 0; slot < s.block_count * bvh_leaf_size; ++slot) {
      if (s.id[slot] < 0) continue;
      const SphereBlock& block = s.blocks[slot / bvh_leaf_size];
      const std::size_t k = slot % bvh_leaf_size;
      spheres[static_cast<std::size_t>(s.id[slot])] = {
          {block.center_x[k], block.center_y[k], block.center_z[k]}, block.radius[k], 0};
    }
    const PlaneView& p = view.planes;
    for (std::size_t i = 0; i < p.size; ++i) {
      planes.push_back({{p.point_x[i], p.point_y[i], p.point_z[i]},
                        {p.normal_x[i], p.normal_y[i], p.normal_z[i]},
                        0});
    }
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

Projection projection_of(CameraKind kind) {
  switch (kind) {
    case CameraKind::parallel:
      return Projection::parallel;
    case CameraKind::equidistant:
      return Projection::equidistant;
    case CameraKind::thin_lens:
      return Projection::thin_lens;
    case CameraKind::lens:
      return Projection::lens;
    case CameraKind::perspective:
      break;
  }
  return Projection::perspective;
}

CameraBasis basis_of(const CameraView& view) {
  const auto vec = [](const double(&v)[3]) { return Vec3d{v[0], v[1], v[2]}; };
  return {vec(view.eye),
          vec(view.forward),
          vec(view.right),
          vec(view.up),
          projection_of(view.kind),
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
    optics.pupil.push_back({view.pupil[i].x0, view.pupil[i].x1, view.pupil[i].y});
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

}  // namespace

const KernelTable& reference_kernels() {
  static const KernelTable table = {Isa::scalar, 1, primary_rays, closest_hit, any_hit};
  return table;
}

}  // namespace boule
