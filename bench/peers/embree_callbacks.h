#pragma once

#include <embree3/rtcore.h>

namespace boule::bench {

/// What the callbacks read: 16 bytes a sphere.
struct alignas(16) PackedSphere {
  float x, y, z, radius_squared;
};

/// User geometry's answers for N rays at a time, its user data the PackedSpheres. Closest approach
/// in float, the directions taken to be of unit length: no division. Only t and the ids are
/// written, no normal: nobody asks for it.
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
