#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/bundle_any.h"
#include "simd/kernel/search/bundle_closest.h"
#include "simd/kernel/search/bundle_discs.h"
#include "simd/kernel/search/bundle_grid.h"
#include "simd/kernel/search/bundle_rays.h"
#include "simd/kernel/search/traverse.h"

/// Bundles against all spheres: up to 1024 rays walk the tree together, front to back, by the four
/// sides of their extent.
namespace boule::BOULE_KERNEL_ISA {

/// A bundle as boxes see it.
template <Common common>
class BundleSides {
 public:
  explicit BundleSides(const BundleRays& rays) : org_(narrow_all(rays.frame.org)) {
    const BundleFrame& frame = rays.frame;
    // a and b are this far off.
    const double off = double{filter::bundle_axis} * filter::u * double{rays.across};
    const Extent& e = rays.extent;
    if constexpr (common == Common::direction) {
      const float c_off = static_cast<float>(filter::bundle_depth * filter::u) * rays.across;
      c_low_ = rays.c_low - c_off;
      c_high_ = rays.c_high + c_off;
    }
    set_side(sides_[0], frame.u, frame.w, double{e.a_low} - off, 1);
    set_side(sides_[1], frame.u, frame.w, double{e.a_high} + off, -1);
    set_side(sides_[2], frame.v, frame.w, double{e.b_low} - off, 1);
    set_side(sides_[3], frame.v, frame.w, double{e.b_high} + off, -1);
    set_side(depth_, frame.w, frame.w, 0, 1);
    set_side(across_[0], frame.u, frame.w, 0, 1);
    set_side(across_[1], frame.v, frame.w, 0, 1);
    off_ = static_cast<float>(off);
    shift_ = rays.shift + static_cast<float>(filter::floor);
  }

  /// Bits of the boxes among those entered, from v = near on, that the grid has rays for.
  BOULE_NOINLINE unsigned meet_rays(const BvhNode& node, const RayGrid& grid, const float* near,
                                    unsigned entered) const {
    alignas(64) float a_low[Discs::size], a_high[Discs::size], b_low[Discs::size],
        b_high[Discs::size];
    for (std::size_t part = 0; part * width < bvh_width; ++part) {
      const Boxes boxes = boxes_of(node, part);
      const Range depth = distances(depth_, boxes);
      const Range a = slopes(across_[0], boxes, depth), b = slopes(across_[1], boxes, depth);
      const RayGrid::Cells cells = grid.cells(a.low, a.high, b.low, b.high);
      store(a_low + part * width, cells.a_low);
      store(a_high + part * width, cells.a_high);
      store(b_low + part * width, cells.b_low);
      store(b_high + part * width, cells.b_high);
    }
    unsigned result = 0;
    for (unsigned left = entered; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (grid.any_in(a_low[k], a_high[k], b_low[k], b_high[k], near[k])) result |= 1U << k;
    }
    return result;
  }

  /// Of all boxes: where the bundle may enter them, in v, and bits of those it misses.
  BOULE_INLINE unsigned enter(const BvhNode& node, float limit, float* near) const {
    unsigned out = 0;
    for (std::size_t part = 0; part * width < bvh_width; ++part)
      out |= enter_part(node, part, limit, near) << (part * width);
    return out;
  }

 private:
  /// Inside: n.(p - O) >= offset. `far` and `near`: the rows of a node's boxes that reach farthest
  /// inside, and least.
  struct Side {
    float x, y, z, offset;
    int far[3], near[3];
  };

  static void set_side(Side& side, const Vec3d& axis, const Vec3d& w, double at, double sign) {
    const bool one_origin = common != Common::direction;
    const Vec3d n = (one_origin ? axis - w * at : axis) * sign;
    side.x = static_cast<float>(n.x);
    side.y = static_cast<float>(n.y);
    side.z = static_cast<float>(n.z);
    side.offset = one_origin ? 0.0F : static_cast<float>(at * sign);
    const double along[3] = {n.x, n.y, n.z};
    for (int k = 0; k < 3; ++k) {
      side.far[k] = along[k] > 0 ? k + 3 : k;
      side.near[k] = along[k] > 0 ? k : k + 3;
    }
  }

  /// W boxes as seen from O, and how far off a distance of their corners may be
  /// (filter_bounds.h).
  struct Boxes {
    Real rows[6];
    Real slack;
  };
  BOULE_INLINE Boxes boxes_of(const BvhNode& node, std::size_t part) const {
    const std::size_t at = part * width;
    Boxes boxes = {{load(node.min_x + at) - org_.x, load(node.min_y + at) - org_.y,
                    load(node.min_z + at) - org_.z, load(node.max_x + at) - org_.x,
                    load(node.max_y + at) - org_.y, load(node.max_z + at) - org_.z},
                   Real(0.0F)};
    const Real(&rows)[6] = boxes.rows;
    const Real size = filter_max(abs(rows[0]), abs(rows[3])) +
                      filter_max(abs(rows[1]), abs(rows[4])) +
                      filter_max(abs(rows[2]), abs(rows[5]));
    boxes.slack = filter_fma(size, Real(static_cast<float>(filter::box * filter::u)), shift_);
    return boxes;
  }

  struct Range {
    Real low, high;
  };
  /// Of the corners along an axis.
  BOULE_INLINE static Range distances(const Side& axis, const Boxes& boxes) {
    return {reach(axis, axis.near, boxes.rows) - boxes.slack,
            reach(axis, axis.far, boxes.rows) + boxes.slack};
  }
  /// Of a, or b, of the rays that may meet boxes; of no use, or NaN, for those around O.
  BOULE_INLINE Range slopes(const Side& axis, const Boxes& boxes, const Range& depth) const {
    const auto [low, high] = distances(axis, boxes);
    if constexpr (common == Common::direction) {
      return {low - off_, high + off_};
    } else {
      const Real zero(0.0F), one(1.0F);
      const Real least = low * (one / select(low < zero, depth.low, depth.high));
      const Real most = high * (one / select(high < zero, depth.high, depth.low));
      const Real none(static_cast<float>(no_hit));
      const RealMask behind = depth.low <= zero;
      return {select(behind, zero - none, least - off_), select(behind, none, most + off_)};
    }
  }

  /// Rounded as filter_bounds.h says of boxes.
  BOULE_INLINE unsigned enter_part(const BvhNode& node, std::size_t part, float limit,
                                   float* near) const {
    const Boxes boxes = boxes_of(node, part);
    RealMask out = Real(0.0F) < Real(0.0F);
    for (const Side& side : sides_) {
      const Real most = reach(side, side.far, boxes.rows) + boxes.slack;
      out =
          out | (most < Real(side.offset) - abs(Real(side.offset)) *
                                                Real(static_cast<float>(filter::box * filter::u)));
    }
    const Range depth = distances(depth_, boxes);
    const Real begin = depth.low - c_high_;
    out = out | (depth.high < c_low_) | (Real(limit) < begin);
    store(near + part * width, begin);
    return bits(out);
  }

  BOULE_INLINE static Real reach(const Side& side, const int (&corner)[3], const Real (&rows)[6]) {
    return filter_fma(Real(side.z), rows[corner[2]],
                      filter_fma(Real(side.y), rows[corner[1]], Real(side.x) * rows[corner[0]]));
  }

  Vec3<Real> org_;
  Real c_low_{0.0F}, c_high_{0.0F};
  Real shift_{0.0F};
  Side sides_[4], depth_;
  Side across_[2];  ///< along U and V
  Real off_;        ///< of a and b
};

/// Some spheres against the bundle.
template <Common common, class Hits>
BOULE_INLINE void meet_spheres(const BundleRays& rays, const DiscFactors& factors,
                               const BlockSpheres& spheres, Hits& hits) {
  Discs discs;
  place_discs<common, Hits::seek>(rays, factors, spheres, hits.limit(), discs);
  for (unsigned left = discs.awkward; left != 0; left &= left - 1)
    hits.meet_awkward(spheres.slot(std::countr_zero(left)));
  if (discs.simple == 0) return;
  bound_discs<common, Hits::seek>(factors, spheres.parts(), discs);
  if constexpr (Hits::seek == Seek::any) {
    if (hits.meet_few(discs, spheres)) return;
  }
  // All of them are compared before any is met: a branch for each, which no CPU foresees, would
  // keep the comparisons apart.
  unsigned groups_of[Discs::size], wanted = 0;
  for (unsigned left = discs.simple; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    groups_of[k] = groups_near(rays.groups, hits.limits(), discs, k);
    wanted |= (groups_of[k] != 0 ? 1U : 0U) << k;
  }
  bool changed = false;
  for (; wanted != 0; wanted &= wanted - 1) {
    const int k = std::countr_zero(wanted);
    const DiscLanes disc = DiscLanes::same(discs, k);
    const std::uint32_t slot = spheres.slot(k);
    for (unsigned groups = groups_of[k]; groups != 0; groups &= groups - 1)
      changed |= hits.meet(std::countr_zero(groups), disc, slot);
  }
  if (changed) hits.update();
}

/// The spheres that are in no leaf.
template <Common common, class Hits>
BOULE_INLINE void meet_scanned(const BundleRays& rays, const DiscFactors& factors,
                               const SphereView& spheres, Hits& hits) {
  const auto count_from = [&](std::size_t first) {
    const std::size_t rest = spheres.scanned - first;
    return static_cast<unsigned>(rest < bvh_leaf_size ? rest : bvh_leaf_size);
  };
  for (std::size_t first = 0; first < spheres.scanned && !hits.done(); first += bvh_leaf_size) {
    const BlockSpheres block(spheres, first, count_from(first));
    meet_spheres<common>(rays, factors, block, hits);
  }
}

/// What a bundle may cost: leaves that it visits.
struct Effort {
  std::size_t most_leaves = ~std::size_t{0};
  std::size_t leaves = 0;
};

/// False if that is given up, for the effort.
template <Common common, class Hits>
BOULE_INLINE bool meet_tree(const BundleRays& rays, const DiscFactors& factors,
                            const GeometryView& geometry, Effort& effort, Hits& hits) {
  if (geometry.bvh.size == 0) return true;
  const BundleSides<common> sides(rays);
  const SphereView& spheres = geometry.spheres;
  const TreeBlocks blocks(geometry);
  VisitStack stack;
  stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
  RayGrid grid;
  std::size_t fill_at = static_cast<std::size_t>(rays.packets * width) / 8;
  while (!stack.empty() && !hits.done()) {
    const Visit visit = stack.pop();
    if (hits.limit() < visit.near) continue;
    if (visit.leaf_size != 0) {
      if (effort.leaves++ >= effort.most_leaves || hits.too_close()) return false;
      const std::size_t first =
          spheres.scanned + std::size_t{index_of(visit.child)} * bvh_leaf_size;
      const BlockSpheres leaf(spheres, first, visit.leaf_size);
      meet_spheres<common>(rays, factors, leaf, hits);
      continue;
    }
    const BvhNode& node = geometry.bvh.nodes[visit.child];
    alignas(64) float near[Discs::size];
    unsigned in = ~sides.enter(node, hits.limit(), near) & ((1U << node.size) - 1);
    if constexpr (Hits::seek == Seek::any) {
      if (effort.leaves >= fill_at) {
        hits.fill(grid);
        fill_at += effort.leaves;
      }
      if (grid.known()) in = sides.meet_rays(node, grid, near, in);
    }
    const int base = stack.count();
    for (; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      stack.push({near[k], node.child[k], node.leaf_size[k]}, base);
      blocks.fetch(node.child[k]);
    }
  }
  return true;
}

/// How a bundle went: there is an answer, its rays are no bundle, or too much lies in their way.
enum class Outcome { traced, no_bundle, crowded };

/// The nearest hits of a bundle of rays.
template <Common common>
BOULE_NOINLINE Outcome trace_bundle(const GeometryView& geometry, const RaysInPlace<common>& source,
                                    Effort& effort, const HitStream& hits) {
  BundleRays rays;
  if (!load_bundle<common, Seek::nearest>(source, rays)) return Outcome::no_bundle;
  const DiscFactors factors(rays, common);
  BundleHits<common> nearest(source, geometry.spheres, rays);
  meet_scanned<common>(rays, factors, geometry.spheres, nearest);
  if (!meet_tree<common>(rays, factors, geometry, effort, nearest)) return Outcome::crowded;
  nearest.finish(geometry.planes, hits);
  return Outcome::traced;
}

/// Whether a bundle of rays meet anything.
template <Common common, class Source>
BOULE_NOINLINE Outcome trace_bundle(const GeometryView& geometry, const Source& source,
                                    Effort& effort, std::uint8_t* occluded) {
  BundleRays rays;
  if (!load_bundle<common, Seek::any>(source, rays)) return Outcome::no_bundle;
  const DiscFactors factors(rays, common);
  BundleAny<common, Source> any(source, geometry.spheres, rays);
  meet_scanned<common>(rays, factors, geometry.spheres, any);
  if (!meet_tree<common>(rays, factors, geometry, effort, any)) return Outcome::crowded;
  any.finish(geometry.planes, occluded);
  return Outcome::traced;
}

}  // namespace boule::BOULE_KERNEL_ISA
