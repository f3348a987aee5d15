#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "bench/textbook/book_solvers.h"
#include "bench/textbook/vectors.h"
#include "core/base/platform.h"
#include "simd/abi/bvh.h"

/// How all solvers of textbooks traverse a tree: tests of boxes against as many rays as a register
/// has floats, and a stack. Solvers in double use float boxes as well: with boxes in double they
/// are a third slower. Choosing faces by the signs of a packet's directions would gain 3 to 10 %.
namespace boule::bench::BOULE_KERNEL_ISA {

/// The greatest coordinate of any box, without its sign.
inline float extent_of(const BvhNode& root) {
  float extent = 0;
  const auto grow = [&](float x) { extent = extent < x ? x : extent; };
  for (int k = 0; k < root.size; ++k) {
    for (const float* row : {root.min_x, root.min_y, root.min_z}) grow(-row[k]);
    for (const float* row : {root.max_x, root.max_y, root.max_z}) grow(row[k]);
  }
  return extent;
}

/// Rays between the planes of an axis: t of the lower plane x is x / d - (o + m) / d, of the upper
/// one x / d - (o - m) / d. The margin m = 16 u (|o| + extent), u = 2^-24, covers the 5 u of this
/// computation's rounding and the rounding of t. A ray along the plane gets a very small d instead
/// of 0, so that nothing is infinite or NaN.
struct Slab {
  Floats inverse, low, high;

  BOULE_INLINE Slab(Floats org, Floats dir, float extent) {
    const Floats zero = all<Floats>(0.0F), tiny = all<Floats>(1e-20F);
    const Floats size = most(org, -org);
    const Floats margin = all<Floats>(16 * 0x1p-24F) * (size + all<Floats>(extent));
    const Floats upward = most(dir, tiny), downward = least(dir, -tiny);
    inverse = all<Floats>(1.0F) / pick(dir < zero, downward, upward);
    low = -(org + margin) * inverse;
    high = -(org - margin) * inverse;
  }

  BOULE_INLINE void cut(float min, float max, Floats& near, Floats& far) const {
    const Floats a = multiply_add(all<Floats>(min), inverse, low);
    const Floats b = multiply_add(all<Floats>(max), inverse, high);
    near = most(near, least(a, b));
    far = least(far, most(a, b));
  }
};

/// A child to visit: where the first ray enters it.
struct Visit {
  float near;
  std::uint32_t child, leaf_size;
};

/// Children to visit; of each node's the nearest on top.
struct VisitStack {
  Visit visits[bvh_max_depth * (bvh_width - 1) + 1];
  int count = 0;

  BOULE_INLINE void push(const Visit& visit, int base) {
    int place = count++;
    for (; place > base && visits[place - 1].near < visit.near; --place)
      visits[place] = visits[place - 1];
    visits[place] = visit;
  }
};

struct BoxRays {
  Slab x, y, z;

  BOULE_INLINE BoxRays(const BookData& data, std::size_t ray, float extent)
      : x(get<Floats>(data.org_x + ray), get<Floats>(data.dir_x + ray), extent),
        y(get<Floats>(data.org_y + ray), get<Floats>(data.dir_y + ray), extent),
        z(get<Floats>(data.org_z + ray), get<Floats>(data.dir_z + ray), extent) {}

  /// The children that some ray enters before its limit.
  BOULE_INLINE void push_children(const BvhNode& node, Floats limit, VisitStack& stack) const {
    const int base = stack.count;
    for (int k = 0; k < node.size; ++k) {
      Floats near = all<Floats>(0.0F), far = limit;
      x.cut(node.min_x[k], node.max_x[k], near, far);
      y.cut(node.min_y[k], node.max_y[k], near, far);
      z.cut(node.min_z[k], node.max_z[k], near, far);
      const auto in = near <= far;
      if (none(in)) continue;
      const Floats never = all<Floats>(std::numeric_limits<float>::infinity());
      stack.push({least_lane(pick(in, near, never)), node.child[k], node.leaf_size[k]}, base);
    }
  }
};

}  // namespace boule::bench::BOULE_KERNEL_ISA
