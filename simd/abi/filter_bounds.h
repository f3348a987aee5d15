#pragma once

#include "core/math/ray.h"

/// The bounds of every float filter: rejects, boxes, beams, bounds of roots, bundles. A filter may
/// let a miss through, but it never drops a hit, because each constant here is at least as large as
/// the rounding error, in units of u. docs/numerics.md derives the constants ("The float filter",
/// "Bundles") and lists the values at which tests fail. tests/equivalence/mutations.sh removes the
/// constants one by one, by name.
///
/// Letters: o origin, d direction, c centre, r radius of a sphere; f = c - o and F = |f|; E is the
/// error of an origin rounded to float, |x - fl(x)| + |y - fl(y)| + |z - fl(z)|.
namespace boule::filter {

inline constexpr double u = unit_roundoff;

// ---- Reject: simd/kernel/search/leaf/sphere.h, simd/geometry/geometry.cpp
// --------------------------

/// A pair of ray and sphere is rejected where b*b + (r2p - f.f) < 0, with b = f.h, h = d / |d| (1 +
/// slack u / 2) rounded to float, and r2p = r^2 (1 + slack u) + squared_floor rounded outward. The
/// rounding error is 17 u max(F^2, r^2). Where the origin is not a float, the sphere grows to r (1
/// + slack u) + floor + E.
inline constexpr double slack = 24;
/// The slack where r2p is computed in float at the time of the test, with three more roundings.
inline constexpr double slack_on_the_spot = slack + 4;

/// The largest error by underflow: of squares, because products of numbers below 1e-19 vanish, and
/// of lengths.
inline constexpr double squared_floor = 1e-36;
inline constexpr double floor = 1e-18;

/// Coordinates and radii from this size on may overflow in float products. An infinite number
/// decides nothing, so filters let everything through.
inline constexpr float limit = 1e18f;

// ---- Bounds of roots: simd/kernel/search/leaf/root_bounds.h
// ----------------------------------------

/// b and l = f - b unit have an error of at most spread u (|b| + 2 r) + E (1 + 48 u); 12 would be
/// enough instead of 14. The discriminant has an error of at most spread' (2 r + 3 spread') +
/// spread u r^2, where spread' is the error of b and l.
inline constexpr double spread = 14;

// ---- Boxes: simd/kernel/search/leaf/slabs.h, bundle_sides.h, simd/geometry/build_box.h
// -------------

/// Against a side of a bundle, the distance of a box corner has an error of 1.25 (1 + 1 + 3) u of
/// itself, and the v that it is compared with an error of 16 u. Against a ray, both ends of the
/// interval together have an error of 5 u of t; 2 box u cover it.
inline constexpr double box = 24;

/// Components of a unit direction below this count as this, so that every t stays finite. Boxes
/// count as wider by 4 slab_least times the distance within which the tree ends; 2 would be enough.
inline constexpr float slab_least = 0x1p-60F;

/// The box around a sphere for a beam has the half width r (1 + beam u) plus beam u times
/// BvhView::extent. Rounding takes 3 u of it.
inline constexpr double beam = 16;

/// The box around the reach of rays grows on each side by reach u (|o| + far), where far is the
/// distance up to which hits count. Rounding takes 4 u of it.
inline constexpr double reach = 16;

/// A box of the tree holds its sphere grown to r (1 + box_step), and each side moves outward by
/// box_step |x|: two float steps or more, of which rounding to float takes half a step. The
/// remaining 3 u |x| cover the rounding of origins and of plane tests.
inline constexpr double box_step = 0x1p-22;

// ---- Parts: simd/kernel/search/packet/parts.h, simd/geometry/parts.cpp
// -------------------------------

/// A box of a part's tree is moved by its centre and by half its size, in float. It grows on each
/// side by moved_box u (|shift| + scale |R| m), where m is the largest coordinate of the box.
/// Rounding takes 21 u of it, the rounding of the spheres included. Half sizes also grow by
/// moved_least: below 2^-126, roundings lose up to 2^-150, which a scale of 1e38 makes significant.
inline constexpr double moved_box = 32;
inline constexpr float moved_least = 0x1p-145F;

// ---- Bundles: simd/kernel/search/bundle_*.h ---------------------------------------------------

/// Rays with a common origin O or a common direction, in the orthonormal frame (U, V, W) of one of
/// them, d0, with W along d0. A ray is the line through O along (a, b, 1), with a = d.U / d.W and b
/// = d.V / d.W. With a common direction it is the line along W through (a, b). A sphere is (X, Y,
/// Z) = (c - O).(U, V, W), and F1 = |X| + |Y| + |Z|. D is the largest |d - d0|_1 / d.W (or |o -
/// O|_1), rho^2 the largest a^2 + b^2 (or 0). v = t |d|^2 / d.W (or t |d|) measures lengths along
/// rays.
///
///   delta = bundle_axis u D Z + bundle_double F1 + floor: the error of e1 = X - aZ and e2 = Y - bZ
///   R2 = r^2 + G,  G = r^2 (rho^2 + bundle_square u) + 4 delta (r + delta)
///   Q = R2 - e1^2 - e2^2: where Q < 0 the line misses
///   D2 = 2 G + 4 delta (r + delta): where Q >= D2 it hits
///   E1 = bundle_depth u F1: the error of the first root, v = X a + Y b + Z - sqrt(discriminant)
///
/// The upper bound of v exceeds the lower one by 2 E1 + sqrt(D2). The factor bundle_twice instead
/// of 2 covers the rounding of that sum and of Z - E1. With a common direction, E1 also includes
/// bundle_depth u D. Boxes in (a, b) also grow by bundle_axis u D, for the sides and for the grid:
/// 3 u D that matter and 16 u D for a ray's a.
inline constexpr double bundle_axis = 24;
inline constexpr double bundle_square = 24;
inline constexpr double bundle_depth = 40;
inline constexpr double bundle_double = 0x1p-44;
inline constexpr float bundle_twice = 2.5F;

/// A sphere is outside if it lies (r + 2 delta) bundle_side beyond a side. The normals U - a W have
/// a length of at most sqrt(1 + bundle_width^2) = 1.031. With a common direction they are unit
/// vectors.
inline constexpr float bundle_side = 1.05F;
inline constexpr float bundle_side_parallel = 1.001F;

/// Rays with a common end are seen from that end, backwards, with d instead of d - d0. Their lines
/// miss O by the rounding error of d to float and by bundle_end (|O|_1 + |d|), the error in double.
/// That distance times bundle_shift_slope is added to delta, to E1, to the margin of boxes and to
/// the ends of the rays.
inline constexpr double bundle_shift_slope = 1.5;
inline constexpr double bundle_end = 0x1p-50;

/// Rays that spread wider than this, in a or b, form no bundle. The same holds where D is larger
/// (with a common end: twice as large), that is, for rays much shorter than d0.
inline constexpr float bundle_width = 0.25F;
inline constexpr float bundle_across = 1;

/// A sphere is simple for a bundle if it lies in front of the bundle, Z >= 2 r (or 2 r beyond every
/// origin), if Z is at least `floor`, and if F1 and r are below bundle_far. All other spheres go to
/// the double solver.
inline constexpr float bundle_far = 1e15F;

/// The distance of a line from a capsule's segment is wrong by less than this, times u and the sum
/// of the absolute coordinates of A - o and B - A. 21 are needed, and for a bound of roots 28.
inline constexpr double capsule = 32;

/// A plane between a capsule and a group of rays leaves this fraction of all lengths between them,
/// for the roundings of double. 2^-46 would be enough.
inline constexpr double aside = 0x1p-40;

}  // namespace boule::filter
