#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/primitive.h"

namespace boule {

struct Bvh;  // of simd/geometry, which defines it

/// The spheres of one tree among several. Their ids follow those of the trees before it.
struct PackedTree {
  std::shared_ptr<const Bvh> tree{};
  std::uint64_t count = 0;  ///< number of ids
};

/// Spheres that exist only in the leaves of trees, because they were packed into a file. The totals
/// that a scene needs are stored beside the trees, so that reading them takes no pass over the
/// spheres.
struct PackedSpheres {
  std::uint64_t count = 0;               ///< their ids are 0 .. count - 1
  std::uint64_t digest = 0;              ///< SphereDigest of them in the order of their ids
  bool has_own_colors = false;           ///< some spheres have a colour of their own
  Vec3d low{}, high{};                   ///< the box around them, if there are any
  std::vector<std::uint64_t> made_of{};  ///< number of spheres for each of the scene's first
                                         ///< materials
  std::vector<Sphere> emissive{};        ///< those with an emissive material, in order
  std::vector<Sphere> first{};           ///< the first few, for `boule info`
  std::vector<Sphere> extremes{};        ///< AxisExtremes of all
  std::string file{};                    ///< the file that holds them
  std::vector<PackedTree> trees{};       ///< at least one if there are spheres
};

}  // namespace boule
