#pragma once

#include "bench/peers/embree/embree_version.h"

namespace boule::bench {

/// What the callbacks read: 16 bytes a sphere.
struct alignas(16) PackedSphere {
  float x, y, z, radius_squared;
};

/// Intersection and occlusion callbacks for N rays at a time; their user data are the
/// PackedSpheres. They solve by the closest approach in float and take directions to have unit
/// length, so that they need no division. They write t and the ids, but no normal, which no
/// benchmark reads.
struct EmbreeCallbacks {
  RTCIntersectFunctionN intersect;
  RTCOccludedFunctionN occluded;
};

namespace avx2 {
extern const EmbreeCallbacks embree_callbacks;
}
namespace avx512 {
extern const EmbreeCallbacks embree_callbacks;
}

}  // namespace boule::bench
