#pragma once

#include <cstddef>
#include <cstdint>

#include "core/optics/camera_view.h"
#include "simd/abi/geometry.h"
#include "simd/abi/isa.h"
#include "simd/abi/paths.h"
#include "simd/abi/shading.h"
#include "simd/abi/stream.h"
#include "simd/abi/whitted.h"

namespace boule {

/// The exported functions of the kernel object of one instruction set. Every function is
/// thread-safe, allocates nothing and cannot fail. any_hit needs 1.5 MiB of the caller's stack.
///
/// Rays may hold any numbers, and streams may be empty. A ray with NaN, with an infinite origin or
/// direction, or without a direction misses everything and leaves the other rays alone. The same
/// holds for an interval with NaN or without extent. Preconditions, which the kernels leave
/// unchecked: the CPU runs `isa` (select_kernels()); arrays are as long, aligned and padded as the
/// streams say, and output arrays are as long as input arrays; the geometry comes from Geometry or
/// an equivalent builder; ids of hits belong to that geometry.
///
/// The thread must round to nearest, keep denormals and mask all floating-point exceptions, because
/// kernels divide by 0 and meet NaN in normal operation. Put a FloatEnvironment (core/base) around
/// the calls to ensure this whatever the caller has set. Without one, the raised flags stay raised.
struct KernelTable {
  Isa isa;
  int width;  ///< float lanes of a packet

  /// rays[k] = the camera's ray through samples[k], with tmin 0, tmax inf and no source; undefined
  /// where the weight is 0. The rays may share the numbers that all rays of such a camera have in
  /// common.
  void (*primary_rays)(const CameraView& camera, const SampleStream& samples,
                       const RayStream& rays);

  /// hits[k] = the nearest hit of rays[k] with tmin < t <= tmax; at equal t, the lower id.
  /// hits.size is ignored.
  void (*closest_hit)(const GeometryView& geometry, const RayStream& rays, const Query& query,
                      const HitStream& hits);

  /// occluded[k] = 1 if rays[k] hits a primitive with tmin < t <= tmax, otherwise 0.
  void (*any_hit)(const GeometryView& geometry, const RayStream& rays, const Query& query,
                  std::uint8_t* occluded);

  /// Sets `hit` to the nearest hit of one ray, or `met` to whether it has any, by the solver
  /// robust: without the work that a stream of one takes. The ends of the ray are compared in
  /// double. Returns false, with the answer undefined, if it takes a stream: where there is no
  /// tree, where there are parts or capsules, and for rays that float cannot judge or that may have
  /// hits behind their origin.
  bool (*closest_of_ray)(const GeometryView& geometry, const Ray& ray, Hit& hit);
  bool (*any_of_ray)(const GeometryView& geometry, const Ray& ray, bool& met);

  /// Lists the chords of rays from ray `first` on, in any order within a ray, by the solver robust:
  /// those of spheres that have a part between tmin and tmax, at most the largest float, and those
  /// of planes that the ray crosses there. Sets ends[k] to the number of chords up to the end of
  /// rays[k]. Stops at a ray whose chords exceed the capacity. Returns that ray, or rays.size.
  std::size_t (*find_chords)(const GeometryView& geometry, const RayStream& rays, std::size_t first,
                             const ChordStream& chords, std::size_t* ends);

  /// surfaces[k] = the surface at hits[k] of rays[k]; undefined where the ray misses.
  void (*find_surfaces)(const GeometryView& geometry, const RayStream& rays, const HitStream& hits,
                        const SurfaceStream& surfaces);

  /// Makes the shadow rays of all lit points that face the light, in the order of the points.
  /// Returns their number.
  std::size_t (*make_shadow_rays)(const ShadowTarget& light, const LitStream& points,
                                  const ShadowRayStream& shadows);

  /// Computes Sobol points: see SobolStream.
  void (*sobol_points)(const SobolStream& points);

  /// Adds light to the sums of samples, ray by ray: light_product() of throughput and radiance.
  void (*add_weighted_light)(const WeightedLight& light, ColorSum* sums);

  // Path tracing, one block of rays at a time. The streams describe the arguments.

  /// Computes the light that rays see by their direction alone.
  void (*see_light)(const SeenLight& seen, const SeeingRays& rays);

  /// Appends the points that rays hit to the points of their kind.
  void (*find_points)(const GeometryView& geometry, const PathRays& paths, LobePoints& matte,
                      LobePoints& glossy, LobePoints& clear);

  /// Appends, for the points of one kind, the rays to sampled lights and the rays that continue the
  /// paths.
  void (*continue_matte)(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                         GoingOn& spawned);
  void (*continue_glossy)(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                          GoingOn& spawned);
  void (*continue_clear)(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                         GoingOn& spawned);

  /// Whitted's method: appends the mirrored and the refracted rays of these hits whose throughput
  /// is above black, hit by hit, the mirrored one first. Their density is 0.
  void (*scatter_rays)(const ScatteringHits& hits, GoingOn& spawned);

  /// Adds the reflected light of points to the radiance of their rays, for those shadow rays that
  /// are unoccluded: reflected_light() of core/optics/reflectance.h. The radiance of other rays is
  /// neither read nor written.
  void (*add_direct_light)(const LightIntensity& light, const ShadowedPoints& shadows,
                           const ColorStream& radiance);
};

}  // namespace boule
