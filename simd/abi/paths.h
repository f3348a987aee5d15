#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/color.h"
#include "simd/abi/shading.h"

namespace boule {

/// The inputs and outputs of the kernels of path tracing and of light. All streams are views: they
/// own nothing and check nothing. Arrays are as in RayStream unless a comment says otherwise.

/// Colours as a structure of arrays.
struct ColorStream {
  float* r;
  float* g;
  float* b;
};
inline ColorStream part(const ColorStream& colors, std::size_t first) {
  return {colors.r + first, colors.g + first, colors.b + first};
}

/// A sum of colours: red, green, blue, and a number that light leaves as it is.
struct alignas(16) ColorSum {
  float rgb0[4];
};

/// The light that rays have found, with the throughput by which it counts and the sample to which
/// it belongs. By ray.
struct WeightedLight {
  ColorStream throughput;
  ColorStream radiance;
  const std::uint32_t* sample;
  std::size_t size;
};

/// Any material as the coefficients of one formula (Whitted 1980). A hit sends back
///       constant + sum over lights of (diffuse (n.l) I + highlight (r.l)^shininess I)
///       + mirror trace(reflected) + transmission trace(refracted).
/// Coefficients that a material lacks are 0. Kernels read four numbers of a colour and use three.
struct FlatMaterial {
  Color constant;                 ///< emission + C (ka + ambient)
  Color diffuse;                  ///< C Kd
  double highlight = 0;           ///< Ks of the white highlight; 0 if shininess is 0
  double shininess = 0;           ///< Phong's exponent
  Color mirror;                   ///< weight of the reflected ray (times F if `fresnel`)
  Color transmission;             ///< weight of the refracted ray (times 1 - F if `fresnel`)
  double ior = 1;                 ///< index of refraction, inside over outside
  bool cosine_highlight = false;  ///< the highlight is multiplied by n.l, like a reflectance
  bool fresnel = false;           ///< a dielectric: reflection and refraction share the light
};

/// An emitting sphere: a sphere light, or an emissive sphere. Light sampling picks it by random
/// numbers in [before, before + share).
struct LightSphere {
  double center[3];
  double radius;
  double share;
  double before;
  float radiance[3];
};

/// The rays of a block and their hits, from which paths continue.
struct PathRays {
  RayStream rays;
  HitStream hits;
  const std::uint32_t* kind;  ///< LobeKind (core/optics/lobes.h); valid up to padded(size)
  ColorStream throughput;
  const std::uint32_t* sample;
};

/// The bits of LobePoints::side.
inline constexpr std::uint32_t side_inside =
    1;  ///< rays leave to the viewer's side within a sphere
inline constexpr std::uint32_t side_beyond = 2;  ///< rays pass through, into a sphere
inline constexpr std::uint32_t side_inner = 4;   ///< as Surface::inner

/// Points of one LobeKind, packed in the order of their rays. Arrays have room for padded(size) +
/// max_width. The first `size` entries are valid; a kernel may write beyond them.
struct LobePoints {
  VectorStream normal;
  VectorStream org;    ///< origin of rays that leave to the viewer's side
  VectorStream point;  ///< unused for matte points
  double* reach;       ///< unused for matte points; as Surface::reach
  ColorStream dir;     ///< unused for matte points; x, y and z of the ray's direction
  std::uint32_t* side;
  std::int32_t* id;    ///< id of the primitive that was hit
  std::uint32_t* ray;  ///< index of the ray in the block
  ColorStream throughput;
  std::uint32_t* sample;
  std::size_t size;
};

/// Pairs of random numbers in [0, 1), by point.
struct UnitPairs {
  const double* u;
  const double* v;
};

/// Light that was sampled outside the kernels, by point. All pointers are null where there is none.
struct GivenLight {
  const std::uint8_t* given;  ///< 1: the other arrays are valid
  VectorStream direction;
  const double* density;
  ColorStream radiance;
};

/// The way in which the paths of a block continue. Materials are by ray of the block.
struct PathStep {
  const FlatMaterial* const* material;
  std::uint32_t first_ray;  ///< index of the block's first ray in its stream
  bool samples_lights;
  bool goes_on;  ///< paths get another direction
  bool weighs;   ///< sampled light is weighted against the path's own directions
  const LightSphere* lights;
  std::size_t light_count;
  double environment_share;  ///< probability of choosing a GivenLight
  UnitPairs light, bounce;
  const double* survival;  ///< by point, for Russian roulette; null: every path survives
  GivenLight given;
};

/// Shadow rays to sampled lights, packed. Each has the index of the ray that receives the light if
/// the shadow ray is unoccluded, and that light. Arrays have room for the added rays and max_width
/// more; rays.size is ignored. The rays share no numbers.
struct SampledLights {
  RayStream rays;
  std::uint32_t* ray;
  ColorStream radiance;
  std::size_t size;
};

/// Rays that continue paths, packed, with room as in SampledLights.
struct GoingOn {
  RayStream rays;
  ColorStream throughput;
  std::uint32_t* sample;
  float* density;
  std::size_t size;
};

/// The weight of light that a path found by its direction and that light sampling could have found
/// as well: by the power heuristic, full, or zero.
enum class HitWeight { heuristic, full, none };

/// The light of the background, for rays that miss everything.
struct SeenBackground {
  enum class Kind { constant, gradient, other } kind;  ///< other: black here
  float bottom[3], top[3];                             ///< constant: `bottom`
  double up[3];                                        ///< unit length
};

/// Light that rays find by their direction alone: that of the background, and that of sphere lights
/// on their way, which are not primitives.
struct SeenLight {
  SeenBackground background;
  const LightSphere* lights;
  std::size_t light_count;
  double sphere_share;  ///< probability that light sampling picks a sphere
  HitWeight weight;
};

/// Rays and the light that they find.
struct SeeingRays {
  RayStream rays;
  HitStream hits;
  const float* density;  ///< of each ray's direction; 0: sphere lights are left out
  ColorStream radiance;  ///< written
};

}  // namespace boule
