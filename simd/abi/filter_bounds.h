#pragma once

#include "core/math/ray.h"

/// The bounds of every float filter: rejects, boxes, beams, bounds of roots, bundles. A filter may
/// let a miss through; it never drops a hit. That holds because each constant here is at least what
/// rounding can do, in units of u. docs/numerics.md derives them ("The float filter", "Bundles")
/// and lists the values at which tests were seen to fail; tests/equivalence/mutations.sh takes them
/// away one by one, by their names.
///
/// Letters: o origin, d direction, c centre, r radius of a sphere; f = c - o and F = |f|; E what
/// the rounding of an origin to float has lost, |x - fl(x)| + |y - fl(y)| + |z - fl(z)|.
namespace boule::filter {

inline constexpr double u = unit_roundoff;

// ---- Reject: simd/kernel/search/sphere.h, simd/geometry/geometry.cpp --------------------------

/// A pair is rejected where b*b + (r2p - f.f) < 0 with b = f.h, h = d / |d| (1 + slack u / 2)
/// rounded to float, and r2p = r^2 (1 + slack u) + squared_floor rounded outward. Rounding costs 17
/// u max(F^2, r^2). Where the origin is no float, the sphere grows to r (1 + slack u) + floor + E.
inline constexpr double slack = 24;
/// The same where r2p is computed in float, by three more roundings, when it is needed.
inline constexpr double slack_on_the_spot = slack + 4;

/// What underflow may cost: of squares, because products of numbers below 1e-19 vanish, and of
/// lengths.
inline constexpr double squared_floor = 1e-36;
inline constexpr double floor = 1e-18;

/// From this size of a coordinate or radius on float products may overflow, and nothing follows
/// from an infinite number: filters let everything through.
inline constexpr float limit = 1e18f;

// ---- Bounds of roots: simd/kernel/search/root_bounds.h ----------------------------------------

/// b and l = f - b unit are wrong by no more than spread u (|b| + 2 r) + E (1 + 48 u); needed is 12
/// instead of 14. The discriminant is wrong by no more than spread' (2 r + 3 spread') + spread u
/// r^2, where spread' is that error.
inline constexpr double spread = 14;

// ---- Boxes: simd/kernel/search/slabs.h, bundle_sides.h, simd/geometry/build_box.h -------------

/// Against a bundle's side the distance of a box' corner is wrong by 1.25 (1 + 1 + 3) u of itself,
/// and the v that it is compared with by 16 u. Against a ray both ends of the interval together are
/// wrong by 5 u of t, for which there are 2 box u.
inline constexpr double box = 24;

/// Components of a unit direction below this are taken for this, so that no t becomes infinite.
/// Boxes count as wider by 4 slab_least times the distance within which the tree ends; 2 are
/// needed.
inline constexpr float slab_least = 0x1p-60F;

/// A box around a sphere for a beam has r (1 + beam u) and beam u times BvhView::extent besides,
/// of which rounding takes 3 u.
inline constexpr double beam = 16;

/// The box around what rays reach grows on each side by reach u (|o| + far), far being the distance
/// within which hits are of interest, of which rounding takes 4 u.
inline constexpr double reach = 16;

/// A box of the tree holds its sphere grown to r (1 + box_step) and is moved outward by box_step
/// |x| on each side: two float steps or more, of which rounding to float takes half a one. What
/// remains, 3 u |x|, pays for the rounding of origins and plane tests.
inline constexpr double box_step = 0x1p-22;

// ---- Parts: simd/kernel/search/parts.h, simd/geometry/parts.cpp -------------------------------

/// A box of a part's tree is moved by its centre and by half its size, in float, and grows on each
/// side by moved_box u (|shift| + scale |R| m), m being the greatest coordinates of the box, of
/// which rounding, that of the spheres among it, takes 21 u. Half sizes grow by moved_least
/// besides: below 2^-126 roundings lose up to 2^-150, which scales of 1e38 make something of.
inline constexpr double moved_box = 32;
inline constexpr float moved_least = 0x1p-145F;

// ---- Bundles: simd/kernel/search/bundle_*.h ---------------------------------------------------

/// Rays that share an origin O, or a direction, in the orthonormal frame (U, V, W) of a ray d0 amid
/// them, W along d0. A ray is the line through O along (a, b, 1), a = d.U / d.W, b = d.V / d.W; or,
/// with a common direction, the line along W through (a, b). A sphere is (X, Y, Z) = (c - O).(U, V,
/// W), and F1 = |X| + |Y| + |Z|. D is the greatest |d - d0|_1 / d.W (or |o - O|_1), rho^2 the
/// greatest a^2 + b^2 (or 0). v = t |d|^2 / d.W (or t |d|) measures lengths along rays.
///
///   delta = bundle_axis u D Z + bundle_double F1 + floor: the error of e1 = X - aZ and e2 = Y - bZ
///   R2 = r^2 + G,  G = r^2 (rho^2 + bundle_square u) + 4 delta (r + delta)
///   Q = R2 - e1^2 - e2^2: where Q < 0 the line misses
///   D2 = 2 G + 4 delta (r + delta): where Q >= D2 it hits
///   E1 = bundle_depth u F1: the error of the first root, v = X a + Y b + Z - sqrt(discriminant)
///
/// From the lower bound of v to the upper it is 2 E1 + sqrt(D2); bundle_twice instead of 2 pays
/// for the rounding of that sum and of Z - E1. With a common direction E1 has bundle_depth u D
/// besides. bundle_axis u D is also what boxes in (a, b) grow by, for the sides and for the grid: 3
/// u D that matter and 16 u D for a ray's a.
inline constexpr double bundle_axis = 24;
inline constexpr double bundle_square = 24;
inline constexpr double bundle_depth = 40;
inline constexpr double bundle_double = 0x1p-44;
inline constexpr float bundle_twice = 2.5F;

/// A sphere is outside where it lies (r + 2 delta) bundle_side beyond a side: the normals U - a W
/// are at most sqrt(1 + bundle_width^2) = 1.031 long. With a common direction they are unit
/// vectors.
inline constexpr float bundle_side = 1.05F;
inline constexpr float bundle_side_parallel = 1.001F;

/// With a common end rays are seen from there, backwards, with d instead of d - d0. Their lines
/// miss O by what the rounding of d to float has cost and by bundle_end of |O|_1 + |d|, which
/// double has lost. That times bundle_shift_slope is added to delta, to E1, to what boxes grow by
/// and to the rays' ends.
inline constexpr double bundle_shift_slope = 1.5;
inline constexpr double bundle_end = 0x1p-50;

/// Rays that spread wider than this, in a or b, are no bundle, nor are those whose D is greater
/// (with a common end: twice as great): rays much shorter than d0.
inline constexpr float bundle_width = 0.25F;
inline constexpr float bundle_across = 1;

/// A sphere is simple for a bundle if it lies in front of it, Z >= 2 r (or 2 r beyond every
/// origin), Z is not below `floor`, and F1 and r are below bundle_far. The others go to the double
/// solver.
inline constexpr float bundle_far = 1e15F;

}  // namespace boule::filter
