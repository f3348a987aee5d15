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

/// All that the kernel object of one instruction set exports.
/// Every function is thread-safe, allocates nothing and cannot fail; any_hit needs 1.5 MiB of the
/// caller's stack.
///
/// Any numbers will do, and any number of them, 0 too: a ray with NaN, with an infinite origin or
/// direction, or without a direction is a miss and harms no other, and so is an interval with NaN
/// or without extent. Preconditions, which nobody checks here: a CPU that runs `isa`
/// (select_kernels()); arrays as long, aligned and padded as the streams say, those that are
/// written as long as those that are read; a geometry of Geometry or its like, and ids of hits that
/// are its own.
///
/// The thread must round to nearest, keep denormals and trap no floating-point exception: kernels
/// divide by 0 and meet NaN as a matter of course. A FloatEnvironment (core/base) around the calls
/// sees to that, whatever the caller has set; raised flags are left behind without one.
struct KernelTable {
  Isa isa;
  int width;  ///< float lanes of a packet

  /// rays[k] = the camera's ray through samples[k], tmin 0, tmax inf, no source; anything where
  /// the weight is 0. The rays may share what all rays of such a camera have in common.
  void (*primary_rays)(const CameraView& camera, const SampleStream& samples,
                       const RayStream& rays);

  /// hits[k] = the nearest hit of rays[k] with tmin < t <= tmax; equal t: the lower id. hits.size
  /// is not read.
  void (*closest_hit)(const GeometryView& geometry, const RayStream& rays, const Query& query,
                      const HitStream& hits);

  /// occluded[k] = 1 if rays[k] meets anything with tmin < t <= tmax, else 0.
  void (*any_hit)(const GeometryView& geometry, const RayStream& rays, const Query& query,
                  std::uint8_t* occluded);

  /// surfaces[k] = where rays[k] met hits[k]; anything where that is a miss.
  void (*find_surfaces)(const GeometryView& geometry, const RayStream& rays, const HitStream& hits,
                        const SurfaceStream& surfaces);

  /// Makes the shadow rays of all lit points that face the light, in their order. Returns how many.
  std::size_t (*make_shadow_rays)(const ShadowTarget& light, const LitStream& points,
                                  const ShadowRayStream& shadows);

  /// Random numbers: the stream says how.
  void (*sobol_points)(const SobolStream& points);

  /// Adds light to the sums of samples, ray by ray: light_product() of the throughput and the
  /// radiance (render/integrators/sample_faults.h).
  void (*add_weighted_light)(const WeightedLight& light, ColorSum* sums);

  // Path tracing, a block of rays at a time; what the streams say.

  /// Finds the light that rays see by their direction.
  void (*see_light)(const SeenLight& seen, const SeeingRays& rays);

  /// Adds the points that rays met to those of their kind.
  void (*find_points)(const GeometryView& geometry, const PathRays& paths, LobePoints& matte,
                      LobePoints& glossy, LobePoints& clear);

  /// Adds the rays to sampled lights, and those with which paths go on, of the points of one kind.
  void (*continue_matte)(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                         GoingOn& spawned);
  void (*continue_glossy)(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                          GoingOn& spawned);
  void (*continue_clear)(const LobePoints& points, const PathStep& step, SampledLights& shadows,
                         GoingOn& spawned);

  /// Whitted's method: adds the mirrored and the refracted rays of these hits whose throughput is
  /// not black, hit by hit, the mirrored one first. They have the density 0.
  void (*scatter_rays)(const ScatteringHits& hits, GoingOn& spawned);

  /// Adds to the radiance of rays what their points send back of the light along those shadow rays
  /// that nothing blocks: reflected_light() of core/optics/reflectance.h. Of the radiance no other
  /// rays are read or written.
  void (*add_direct_light)(const LightIntensity& light, const ShadowedPoints& shadows,
                           const ColorStream& radiance);
};

}  // namespace boule
