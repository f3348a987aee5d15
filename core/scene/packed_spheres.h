#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/primitive.h"

namespace boule {

struct Bvh;  // of simd/geometry, which knows what is in it

/// The spheres of one tree of several. Their ids follow those of the trees before it.
struct PackedTree {
  std::shared_ptr<const Bvh> tree{};
  std::uint64_t count = 0;  ///< ids
};

/// Spheres that lie in the leaves of trees and nowhere else, because they were packed into a file.
/// What a scene asks of all of them stands here beside the trees, so that nobody goes through them.
struct PackedSpheres {
  std::uint64_t count = 0;      ///< their ids are 0 .. count - 1
  std::uint64_t digest = 0;     ///< SphereDigest of them in the order of their ids
  bool has_own_colors = false;  ///< some have a colour of their own
  Vec3d low{}, high{};          ///< the box around them, if there are any
  /// How many are made of each of the scene's first materials.
  std::vector<std::uint64_t> made_of{};
  std::vector<Sphere> emissive{};   ///< those whose material gives light, in order
  std::vector<Sphere> first{};      ///< the first few, to be shown
  std::vector<Sphere> extremes{};   ///< AxisExtremes of all
  std::string file{};               ///< that they were packed into
  std::vector<PackedTree> trees{};  ///< one at least, if there are spheres
};

}  // namespace boule
