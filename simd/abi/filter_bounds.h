#pragma once

namespace boule::filter {

/// The constants of the conservative float reject, in units of u = 2^-24. The reject is a filter:
/// it may let a miss through, it never drops a hit. With f = c - o, F = |f| and h = dir / |dir|
/// times 1 + slack u / 2, rounded to float, it drops a pair where
///
///   b*b + (r2p - f.f) < 0,   b = f.h,   r2p = r^2 (1 + slack u) + squared_floor, rounded outward.
///
/// A hit has (f.h0)^2 >= F^2 - r^2 for the exact unit direction h0, so in exact arithmetic
///   b^2 + r2p - f.f >= slack u ((f.h0)^2 + r^2) >= slack u M,   M = max(F^2, r^2),
/// up to terms in u^2. Float takes away from that at most:
///
///   f          each component rounded once: u F, in b and in f.f        4 u M
///   h          each component rounded once: u F in b, |b| <= F          2 u M
///   b          three roundings of the dot product, u F each             6 u M
///   b*b        one rounding (none where it is fused)                    1 u M
///   f.f        its products (without FMA) u F^2 together; they are
///              taken off r2p one after the other, u M each time         4 u M
///   the sum    its rounding cannot change its sign                      0
///                                                               sum    17 u M
///
/// 24 is shipped. Of 666,000 hits in the hard cases a slack of 7 and more drops none; 6, 4, 2 and 0
/// drop 1, 80, 6647 and 91,698 (with FMA; reject_sweep_test.cpp). With 2 that test must fail.
///
/// The origin, where it is no float, is wrong by at most E = |x - fl(x)| + |y - fl(y)| + |z -
/// fl(z)|: the sphere grows to r (1 + slack u) + floor + E. Of 200,000 such hits a growth by 0.8 E
/// drops 361, by E none. At and beyond `limit` r2p is inf and no bound follows from an infinite
/// number.
inline constexpr double u = 0x1p-24;
inline constexpr double slack = 24;
/// Where r2p is found in float, on the spot, by three roundings more.
inline constexpr double slack_on_the_spot = slack + 4;

/// What may be lost to underflow, products of numbers below 1e-19; `floor` is for lengths.
inline constexpr double squared_floor = 1e-36;
inline constexpr double floor = 1e-18;

/// At and beyond this size of a coordinate or radius float products may overflow: the filter then
/// lets everything through.
inline constexpr float limit = 1e18f;

/// Float bounds of the two roots of a survivor, as distances along the unit direction
/// (root_bounds.h). With h0 rounded to `unit`, F = |f|, E the origin's rounding error and l = f - b
/// unit:
///
///   b          f, unit and the dot product, as above: 5 u F + E
///   l          f: u F, b: 5 u F + E, unit: u F, the product: u F, the difference: u F
///                                                               |error of l| <= 9 u F + E
///
/// spread = 12 u (F + r) + E bounds both, the 2 u (F + r) that is lost when the ends of the
/// intervals are added up, and the u (F + r) by which a t |dir| that they are compared with, itself
/// no more than F + r where that matters, is rounded. A hit has |l| <= r, so its discriminant r^2 -
/// l.l is wrong by at most 2 r spread + spread^2 (from l) + 8 u (r + spread)^2 (from squares and
/// sums):
///   doubt = spread (2 r + 3 spread) + 14 u r^2.
/// F is not known, but a hit, and what is no hit but could be taken for one, has |l| <= r + 9 u F +
/// E, so that F <= |b| + 5 u F + E + |l| is at most (|b| + r + 2 E) (1 + 14 u). Needed is then 12 u
/// (|b| + 2 r) + E (1 + 24 u); spread = 14 u (|b| + 2 r) + E (1 + 48 u) is shipped. What lies
/// farther from the line has a greater F and so a greater error, but misses by far more than that.
inline constexpr double spread = 14;

/// Boxes of a tree. Against a bundle's sides, of the corner's distance: x - O, n and three sums,
/// 1.25 (1 + 1 + 3) u; a v that it is compared with may be 16 u off (below). Where an origin is no
/// float, it is u |o| <= u |x| + u |x - o| off: a box has 3 u |x| for that (below), and what is
/// left is 1.25 u of the distance.
inline constexpr double box = 24;

/// Against a ray a plane x is met at t = x i + c, i = 1 / d, c = -(o i), d one component of the
/// unit direction; c comes from the exact origin by way of double. Along the axis, t d, this is u
/// |o| off for c and, where the product is not fused, u |x|: 2 u |x| + u |t d|, of the 3 u |x| that
/// a box has (below). And it is u of t off for d, i and the sum each: 4 u together, and u of the t
/// that it is compared with. All 2 box u are on one side of that comparison. Components below
/// slab_least are taken for slab_least, that nothing becomes infinite: within the tree t is at most
/// sqrt(3) times the sum of |o| and the tree's extent, `farthest`; the ray is 2 slab_least farthest
/// aside at most, and boxes are as good as 4 wider. A ray that floats cannot judge (`limit`) enters
/// every box.
inline constexpr float slab_least = 0x1p-60F;

/// Against a beam, all rays of a packet: i is the least, or the greatest, of theirs, and c comes
/// from the origin that is the last, or the first, rounded to float, which is one u |o| more: 2 u
/// |o| + u |x| <= 3 u |x| + 2 u |t d|, as above. A sphere's box is x = c -/+ r, r grown by beam u r
/// and by beam u times the tree's extent, of which the difference may lose u, and 3 u are needed.
inline constexpr double beam = 16;

/// A box holds its sphere grown to r (1 + box_step), whatever was rounded, and is at least one
/// float step wider on each side: x = c - r (1 + box_step) is rounded in double, by far less than
/// what follows. A float of the size of x has steps of at most 2^-23 |x|: box_step |x| outward are
/// two steps or more, and rounding to float takes away half a step, or, where that crosses into
/// longer steps, one of at least four: 3 u |x| are left in any case. Below 2^-126, where steps are
/// 2^-149, half a step may be lost: whatever meets a box has `floor` for it.
inline constexpr double box_step = 0x1p-22;

/// Bundles (simd/kernel/bundle*.h): rays that share an origin O, or a direction, in the orthonormal
/// frame (U, V, W) of a ray d0 amid them, W along d0; all three in double, 2^-50 off.
///
/// A ray is the line through O along h = (a, b, 1), a = d.U / d.W, b = d.V / d.W; or, with one
/// direction, the line along W through (a, b). A sphere is (X, Y, Z) = (c - O).(U, V, W), computed
/// in double and rounded to float once. The sides of the bundle have normals n = U - a W, at most
/// sqrt(1 + bundle_width^2) = 1.031 long: a sphere is outside if it is r + 2 delta, times
/// bundle_side (or bundle_side_parallel for n = U), beyond one. With e1 = X - aZ, e2 = Y - bZ (or X
/// - a, Y - b) and f the vector from O to the centre
///   |f x h|^2 = e1^2 + e2^2 + (b e1 - a e2)^2,
/// so that with rho^2 the greatest a^2 + b^2 (or 0) a line that meets the sphere has
///   e1^2 + e2^2 <= r^2 (1 + rho^2), and one that has e1^2 + e2^2 <= r^2 meets it.
///
/// Errors, with D the greatest |d - d0|_1 / d.W, at most 1 (or the greatest |o - O|_1):
///   d - d0  rounded: u, U rounded to float: u, the dot product: 3 u            5 u D d.W
///   d.W     = |d0| + (d - d0).W, |d0| <= 2 d.W, and rounded likewise            9 u d.W
///   a, b    both, the quotient (a product with 1 / d.W): 2 u                   16 u D
///   e1, e2  X: u |X|, a: 16 u D Z, Z: u |a| Z, the product: u |a| Z, the sum: u |e1|; where it
///           matters |X| <= |a| Z + |e1|, |a| <= D and |e1| <= 1.07 r
///                                                19 u D Z + 2.2 u r  (or 7 u D + 2.2 u r)
///           and bundle_double F1 for what double has lost, F1 = |X| + |Y| + |Z|.
///   delta   = bundle_axis u D Z + bundle_double F1 + floor is shipped.
///   R2      = r^2 + G, G = r^2 (rho^2 + bundle_square u) + 4 delta (r + delta), is then more than
///             e1^2 + e2^2 of any line that meets the sphere: sqrt(1 + rho^2) <= 1.07, so that e
///             costs 2 sqrt(2) 1.07 19 u D Z r = 58 u D Z r, and rho^2, with its a and b, 2 (0.25 +
///             0.25) 16 u D r^2, at most 8 u D Z r, of the 96 u D Z r that are there.
///             bundle_square pays for the 2.2 u r above, 2 sqrt(2) 1.07 2.2 = 6.7, for 4 u in Q and
///             5.5 u in R2, rho^2 included: 16.2.
///   Q       = R2 - e1^2 - e2^2 < 0: the line misses.
///   D2      = 2 G + 4 delta (r + delta): Q >= D2, and the line meets it; the discriminant lies
///             between Q - D2 and Q. Needed is G as shipped and G as needed, 40.2 u r^2 of 48 (and
///             164 u D Z r of 288): the difference pays for D2's own roundings and its root's.
///   extent  A ray that meets the sphere has |a - X / Z| <= (sqrt(R2) + 2 delta) / Z. With 1 / Z
///             the same on either side of a difference that is at most D, this takes 16 u D for a
///             and 5 u D for X, the quotient, 1 / Z and the difference, of 48 u D; and 2.2 u r for
///             X and the quotient, 7 u r for the root, the sums and the product, of the 10.6 u r
///             that bundle_square has added to the root.
///   v       = t |d|^2 / d.W (or t |d|): in this unit the first root is X a + Y b + Z - sqrt(disc),
///             (or Z - c - sqrt(disc)). Its float value is wrong by Z: u, the sums 4 u, a and b:
///             17 u (|X| + |Y|), the root u r: 20 u F1 together. |d|^2 / d.W is good to 14 u, and
///             a v that comes from a t is rounded twice more, 16 u F1; E1 = bundle_depth u F1 pays
///             for both, so that v of a t, rounded as it is, may be compared with these bounds.
///             From the lower bound to the upper it is 2 E1 + sqrt(D2). Only Z - E1 is kept: of it
///             E1 comes back u |Z| off, and bundle_twice pays for that and for the sum's rounding.
///             No point of the sphere has a v below Z - r: E1 pays for the two roundings there.
///             With one direction c is 6 u D off, and v may be D more than F1: bundle_depth u D
///             comes on top.
///
/// Rays with a common end, O, are seen from there, backwards: with d, not d - d0, so that D is
/// |d|_1 / d.W, at most 2: a and b are then 7 u D off. Their lines miss O by what rounding d to
/// float has cost, at most `shift`, and by bundle_end of |O|_1 + |d|: lost when the end was found
/// in double, and by the double solver itself, which sees the sphere from the ray's origin. That
/// times |h|_1 <= 1.5 is what delta, E1, the sides that boxes are tested with, and the ray's own
/// end in v grow by.
///
/// A box in (a, b), for the grid of a bundle's rays, is two quotients, 2 u, and moved by
/// bundle_axis u D, rounded: 3 u D that matter, and 16 u D for a ray's a, of 24 u D.
inline constexpr double bundle_axis = 24;
inline constexpr double bundle_square = 24;
inline constexpr double bundle_depth = 40;
inline constexpr double bundle_double = 0x1p-44;
inline constexpr float bundle_twice = 2.5F;
inline constexpr float bundle_side = 1.05F;
inline constexpr float bundle_side_parallel = 1.001F;
inline constexpr double bundle_shift_slope = 1.5;
inline constexpr double bundle_end = 0x1p-50;

/// Bundles wider than this (|a| or |b|) are split, and those whose D is greater (with a common
/// end: twice as great): rays much shorter than d0.
inline constexpr float bundle_width = 0.25F;
inline constexpr float bundle_across = 1;

/// A sphere is simple for a bundle if it lies in front of it, Z >= 2 r (or 2 r beyond every
/// origin; any hit of parallel rays takes spheres from everywhere), F1 and r are below bundle_far
/// and Z is not below `floor`; the others go to the double solver. What underflows in products is
/// paid for by `floor` in delta.
inline constexpr float bundle_far = 1e15F;

/// Seen: with these values the equivalence tests fail (tests/equivalence/mutations.sh, and by hand
/// on AVX2), with those in brackets they do not: slack 4 (7), slack_on_the_spot 0 (4),
/// squared_floor 0 (1e-44), floor 1e-24 (1e-21), limit 3e38, slab_least 0, spread 0 (1), box 0
/// (2), beam 0, box_step 2^-24 (2^-23), bundle_axis 0 (3), bundle_square 3 (6), bundle_depth 0 (5),
/// bundle_double 0 (2^-50), bundle_twice 0, bundle_side 1, bundle_side_parallel 0.9,
/// bundle_shift_slope 0, bundle_end 0, bundle_width 100, bundle_across 1e9, bundle_far 1e38.

}  // namespace boule::filter
