#pragma once

#include <cstddef>
#include <span>

#include "simd/abi/bvh.h"
#include "simd/abi/isa.h"

namespace boule::bench {

/// What the solvers of textbooks read: spheres and rays as structures of arrays of float, padded to
/// 16 and aligned to 64 bytes. Radii are positive; padding spheres have the radius NaN.
struct BookData {
  const float *center_x, *center_y, *center_z, *radius;
  std::size_t spheres;
  const float *org_x, *org_y, *org_z, *dir_x, *dir_y, *dir_z;
  std::size_t rays;
  float* t;  ///< out: nearest t > 0, or infinity

  /// A tree over spheres, for `traverse` alone; leaf k is block apart + k.
  const BvhNode* nodes;  ///< the root first; or nullptr
  const SphereBlock* blocks;
  std::size_t apart;  ///< blocks in front that are in no leaf: to be scanned
};

/// A way of solving |o + t d - c| = r from books and programs, for W rays at a time and as fast as
/// the kernels' kind of loop allows: W rays against one sphere, four spheres per branch, roots
/// outside the hot loop. book_solvers.cpp shows what each computes.
struct BookSolver {
  const char* name;
  void (*nearest)(const BookData&);   ///< every ray against all spheres
  void (*pairs)(const BookData&);     ///< ray i against sphere i
  void (*traverse)(const BookData&);  ///< every ray against the spheres of the tree
};

/// The solvers of an ISA; none where this program or this CPU lacks it. Every ISA has the same
/// solvers in the same order; those with fused operations have Kahan's as well, at the end.
std::span<const BookSolver> book_solvers(Isa isa);

}  // namespace boule::bench
