// The kernels of one instruction set and the table that exports them. This file and the files
// beside it, one per way through search/, are compiled once per instruction set (simd/isa.cmake),
// each time into a namespace of its own. This file decides the way of each stream, except for the
// trials in scattered.cpp and shadow_stream.h:
//   bundles    the caller promises a common origin, direction or end and leaves the form open
//   scattered  without a promise, where there is a tree and the solver is robust: as sets, as
//              packets or in flight, whichever a trial finds fastest
//   packets    everything else: a scan, the fast solver, a form that was asked for, or several
//   parts
// Capsules come last, in a pass of their own (capsules.cpp).
#include "simd/abi/kernel_table.h"
#include "simd/kernel/camera/primary_rays.h"
#include "simd/kernel/search/bundle/bundled.h"
#include "simd/kernel/search/flock/scattered_stream.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/packet/capsule_stream.h"
#include "simd/kernel/search/packet/chord_list.h"
#include "simd/kernel/search/packet/packet_stream.h"
#include "simd/kernel/shading/direct_light.h"
#include "simd/kernel/shading/lobe_points.h"
#include "simd/kernel/shading/path_step.h"
#include "simd/kernel/shading/scatter.h"
#include "simd/kernel/shading/seen_light.h"
#include "simd/kernel/shading/shadow_rays.h"
#include "simd/kernel/shading/sobol_points.h"
#include "simd/kernel/shading/surfaces.h"
#include "simd/kernel/shading/weighted_light.h"

namespace boule::BOULE_KERNEL_ISA {
namespace {

bool may_bundle(const GeometryView& geometry, const Query& query) {
  return query.form == Form::automatic && geometry.spheres.block_count <= no_slot / bvh_leaf_size;
}
bool may_bundle(const PartsGeometry& /*geometry*/, const Query& query) {
  return query.form == Form::automatic;
}

bool may_scatter(const GeometryView& geometry, const Query& query) {
  const bool asked =
      query.form == Form::automatic || query.form == Form::flight || query.form == Form::set;
  return asked && query.solver == Solver::robust && geometry.bvh.size > 0;
}

/// Traces rays without a promise of coherence. Answers: HitStream, or std::uint8_t*.
template <class Answers>
void trace_any(const GeometryView& geometry, const PaddedStream& stream, const Query& query,
               const Answers& answers) {
  if (may_scatter(geometry, query)) {
    trace_scattered(geometry, stream, 0, stream.rays().size, query.form, query.experience, answers);
  } else {
    trace_groups(geometry, stream, 0, stream.rays().size, query.solver, query.form, answers);
  }
}
template <class Answers>
void trace_any(const PartsGeometry& geometry, const PaddedStream& stream, const Query& query,
               const Answers& answers) {
  trace_groups(geometry, stream, 0, stream.rays().size, query.solver, query.form, answers);
}

template <class Geometry>
void closest_hit_in(const Geometry& geometry, const RayStream& rays, const Query& query,
                    const HitStream& hits) {
  if (query.form == Form::single) return trace_alone(geometry, rays, query.solver, hits);
  const PaddedStream stream(rays);
  if (query.coherence == Coherence::none || query.coherence == Coherence::common_end ||
      !may_bundle(geometry, query)) {
    trace_any(geometry, stream, query, hits);
  } else {
    closest_hit_bundled(geometry, stream, query.coherence, hits);
  }
}

template <class Geometry>
void any_hit_in(const Geometry& geometry, const RayStream& rays, const Query& query,
                std::uint8_t* occluded) {
  if (query.form == Form::single) return trace_alone(geometry, rays, query.solver, occluded);
  const PaddedStream stream(rays);
  if (query.coherence == Coherence::none || !may_bundle(geometry, query)) {
    trace_any(geometry, stream, query, occluded);
  } else {
    any_hit_bundled(geometry, stream, query.coherence, query.experience, occluded);
  }
}

void closest_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
                 const HitStream& hits) {
  if (geometry.parts.size != 0) {
    closest_hit_in(PartsGeometry(geometry), rays, query, hits);
  } else {
    closest_hit_in(geometry, rays, query, hits);
  }
  if (geometry.capsules.slots != 0) trace_capsules(geometry.capsules, rays, query, hits);
}

void any_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
             std::uint8_t* occluded) {
  if (geometry.parts.size != 0) {
    any_hit_in(PartsGeometry(geometry), rays, query, occluded);
  } else {
    any_hit_in(geometry, rays, query, occluded);
  }
  if (geometry.capsules.slots != 0) trace_capsules(geometry.capsules, rays, query, occluded);
}

/// Whether the rays of a geometry may go without a stream.
bool has_one_part(const GeometryView& geometry) {
  return geometry.parts.size == 0 && geometry.capsules.slots == 0;
}
bool hit_of_ray(const GeometryView& geometry, const Ray& ray, Hit& hit) {
  return has_one_part(geometry) && trace_ray(geometry, ray, hit);
}
bool ray_hits(const GeometryView& geometry, const Ray& ray, bool& met) {
  return has_one_part(geometry) && trace_ray(geometry, ray, met);
}

// The functions of the table. The functions that these call are always inlined and have no address.

void camera_rays(const CameraView& camera, const SampleStream& samples, const RayStream& rays) {
  primary_rays(camera, samples, rays);
}

std::size_t chords_of_rays(const GeometryView& geometry, const RayStream& rays, std::size_t first,
                           const ChordStream& chords, std::size_t* ends) {
  if (geometry.parts.size != 0) {
    return list_chords(PartsGeometry(geometry), geometry.capsules, rays, first, chords, ends);
  }
  return list_chords(geometry, geometry.capsules, rays, first, chords, ends);
}

void surfaces_of_hits(const GeometryView& geometry, const RayStream& rays, const HitStream& hits,
                      const SurfaceStream& surfaces) {
  if (geometry.parts.size != 0) {
    find_surfaces(PartsGeometry(geometry), geometry.capsules, rays, hits, surfaces);
  } else {
    find_surfaces(geometry, geometry.capsules, rays, hits, surfaces);
  }
}

std::size_t shadow_rays(const ShadowTarget& light, const LitStream& points,
                        const ShadowRayStream& shadows) {
  return make_shadow_rays(light, points, shadows);
}

void numbers(const SobolStream& points) { sobol_points(points); }
void light_by_direction(const SeenLight& seen, const SeeingRays& rays) { see_light(seen, rays); }

void weighted_light(const WeightedLight& light, ColorSum* sums) { add_weighted_light(light, sums); }

void points_by_kind(const GeometryView& geometry, const PathRays& paths, LobePoints& matte,
                    LobePoints& glossy, LobePoints& clear) {
  if (geometry.parts.size != 0) {
    find_points(PartsGeometry(geometry), geometry.capsules, paths, matte, glossy, clear);
  } else {
    find_points(geometry, geometry.capsules, paths, matte, glossy, clear);
  }
}

void matte_paths(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                 GoingOn& spawned) {
  continue_points<LobeKind::matte>(points, step, shadows, spawned);
}
void glossy_paths(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                  GoingOn& spawned) {
  continue_points<LobeKind::glossy>(points, step, shadows, spawned);
}
void clear_paths(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                 GoingOn& spawned) {
  continue_points<LobeKind::clear>(points, step, shadows, spawned);
}

void scattered(const ScatteringHits& hits, GoingOn& spawned) { scatter_rays(hits, spawned); }
void direct_light(const LightIntensity& light, const ShadowedPoints& shadows,
                  const ColorStream& radiance) {
  add_direct_light(light, shadows, radiance);
}

}  // namespace

extern const KernelTable kernel_table;
const KernelTable kernel_table = {Isa::BOULE_KERNEL_ISA,
                                  width,
                                  camera_rays,
                                  closest_hit,
                                  any_hit,
                                  hit_of_ray,
                                  ray_hits,
                                  chords_of_rays,
                                  surfaces_of_hits,
                                  shadow_rays,
                                  numbers,
                                  weighted_light,
                                  light_by_direction,
                                  points_by_kind,
                                  matte_paths,
                                  glossy_paths,
                                  clear_paths,
                                  scattered,
                                  direct_light};

}  // namespace boule::BOULE_KERNEL_ISA
