#pragma once

#include <span>

#include "core/math/vec.h"
#include "core/scene/scene.h"

namespace boule::bench {

/// A lecture's or a textbook's remedy against false shadows. Lengths are in units of the scene,
/// because the shadow ray's direction has unit length; an unused one is 0. Only the experiment uses
/// these: the renderer needs no epsilon.
struct FloatRemedy {
  const char* name;
  float least_t = 0;        ///< the shadow ray begins here (the lecture's small_num)
  float along_normal = 0;   ///< its origin is moved this far along N
  float towards_light = 0;  ///< its origin is moved this far along L
};

/// None, t > 1e-6 and t > 1e-3, along N and towards the light by 1e-4 and 1e-3.
std::span<const FloatRemedy> float_remedies();

/// A point of a surface as a float renderer has it.
struct FloatPoint {
  Vec3f point;   ///< fl(o + t d)
  Vec3f normal;  ///< unit length, towards the viewer
};

/// Whether something is between the point and the light: the shadow ray and all solvers in float,
/// spheres by their closest approach with the stable root (Ray Tracing Gems, ch. 7).
bool is_shadowed(const FloatRemedy& remedy, const Scene& scene, const FloatPoint& from,
                 const Vec3f& light);

}  // namespace boule::bench
