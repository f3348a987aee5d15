#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/shading.h"

namespace boule {

/// What the kernels of path tracing and of light read and write. All streams are views: they own
/// nothing and check nothing. Arrays are as in RayStream unless something else is said.

/// Colours as a structure of arrays.
struct ColorStream {
  float* r;
  float* g;
  float* b;
};
inline ColorStream part(const ColorStream& colors, std::size_t first) {
  return {colors.r + first, colors.g + first, colors.b + first};
}

/// A sum of colours: red, green, blue, and 0.
struct alignas(16) ColorSum {
  float rgb0[4];
};

/// The light that rays have found, and what of it counts in which sample. By ray.
struct WeightedLight {
  ColorStream throughput;
  ColorStream radiance;
  const std::uint32_t* sample;
  std::size_t size;
};

/// A material of flatten() or flatten_for_paths() (render/prepare/flat_material.h), whose meanings
/// it has; the fourth number of a colour is 0.
struct LobeMaterial {
  float diffuse[4], mirror[4], transmission[4];
  double highlight, shininess, ior;
  bool fresnel;
  bool cosine_highlight;
};

/// A sphere that gives light, as AreaLight (render/prepare/area_lights.h). It is picked by a number
/// from `before` on, below `before` + `share`.
struct LightSphere {
  double center[3];
  double radius;
  double share;
  double before;
  float radiance[3];
};

/// The rays of a block, with what they have met, from which paths go on.
struct PathRays {
  RayStream rays;
  HitStream hits;
  const std::uint32_t* kind;  ///< LobeKind (core/optics/lobes.h); also those up to padded(size)
  ColorStream throughput;
  const std::uint32_t* sample;
};

/// What LobePoints::side says.
inline constexpr std::uint32_t side_inside =
    1;  ///< rays leave to the viewer's side within a sphere
inline constexpr std::uint32_t side_beyond = 2;  ///< rays go through, into a sphere
inline constexpr std::uint32_t side_inner = 4;   ///< as Surface::inner

/// Points of one LobeKind, one after the other, in the order of their rays. Arrays have room for
/// padded(size) and max_width more. The first `size` are there; more may be written behind them.
struct LobePoints {
  VectorStream normal;
  VectorStream org;    ///< where rays leave to the viewer's side
  VectorStream point;  ///< not of matte points
  double* reach;       ///< likewise, as Surface::reach
  ColorStream dir;     ///< likewise: x, y and z of the ray's direction
  std::uint32_t* side;
  std::int32_t* id;    ///< of what was hit
  std::uint32_t* ray;  ///< of the block
  ColorStream throughput;
  std::uint32_t* sample;
  std::size_t size;
};

/// Random numbers by point, in pairs.
struct UnitPairs {
  const double* u;
  const double* v;
};

/// Light that was sampled without a kernel, by point; all null where there is none.
struct GivenLight {
  const std::uint8_t* given;  ///< 1: the rest holds
  VectorStream direction;
  const double* density;
  ColorStream radiance;
};

/// How the paths of a block go on; by ray of the block what is met.
struct PathStep {
  const LobeMaterial* const* material;
  std::uint32_t first_ray;  ///< of the block in its stream
  bool samples_lights;
  bool goes_on;  ///< paths get another direction
  bool weighs;   ///< sampled light is weighted against the path's own directions
  const LightSphere* lights;
  std::size_t light_count;
  double environment_share;  ///< probability of a GivenLight
  UnitPairs light, bounce;
  const double* survival;  ///< by point, for Russian roulette; null: every path survives
  GivenLight given;
};

/// Shadow rays to sampled lights, one after the other: each with the ray of the stream to which
/// it brings light unless it is blocked, and that light. Arrays have room for what is added and
/// max_width more; rays.size is not read. The rays share nothing.
struct SampledLights {
  RayStream rays;
  std::uint32_t* ray;
  ColorStream radiance;
  std::size_t size;
};

/// Rays with which paths go on, likewise.
struct GoingOn {
  RayStream rays;
  ColorStream throughput;
  std::uint32_t* sample;
  float* density;
  std::size_t size;
};

/// How light counts that a path found by its direction, and that light sampling could have found:
/// by the power heuristic, in full, or not at all.
enum class HitWeight { heuristic, full, none };

/// What rays see that meet nothing.
struct SeenBackground {
  enum class Kind { constant, gradient, other } kind;  ///< other: they see nothing here
  float bottom[3], top[3];                             ///< constant: `bottom`
  double up[3];                                        ///< unit length
};

/// Light that rays find by their direction alone: of the background, and of sphere lights on their
/// way, which are no objects.
struct SeenLight {
  SeenBackground background;
  const LightSphere* lights;
  std::size_t light_count;
  double sphere_share;  ///< probability that light sampling picks a sphere
  HitWeight weight;
};

/// Rays, and the light that they find.
struct SeeingRays {
  RayStream rays;
  HitStream hits;
  const float* density;  ///< of each ray's direction; 0: sphere lights do not count
  ColorStream radiance;  ///< written
};

}  // namespace boule
