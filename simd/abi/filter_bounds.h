#pragma once

namespace boule::filter {

/// The constants of the conservative float reject, in units of u = 2^-24. The reject is a filter:
/// it may let a miss through, it never drops a hit. With f = c - o, F = |f| and h = dir / |dir|
/// times 1 + slack u / 2, rounded to float, it drops a pair where
///
///   b*b - f.f < -r2p,   b = f.h,   r2p = r^2 (1 + slack u) + squared_floor, rounded outward.
///
/// A hit has (f.h0)^2 >= f.f - r^2 for the exact unit direction h0, so in exact arithmetic
///   b^2 - f.f + r2p >= slack u ((f.h0)^2 + r^2) >= slack u F^2
/// up to terms in u^2. Float takes away from that at most:
///
///   f          each component rounded once: u F, in b and in f.f        4 u F^2
///   h          each component rounded once: u F in b, |b| <= F          2 u F^2
///   b          three roundings of the dot product, u F each             6 u F^2
///   b*b        one rounding (none where it is fused)                    1 u F^2
///   f.f        its products (without FMA) u F^2 together; they are
///              taken off one after the other, u F^2 each time           4 u F^2
///                                                               sum    17 u F^2
///
/// 24 is shipped. Of 2.1 million hits in the hard cases a slack of 7 and more drops none, 6 drops
/// 2, 4 drops 1662: with 4 the equivalence tests must fail.
inline constexpr double u = 0x1p-24;
inline constexpr double slack = 24;

/// What may be lost to underflow, products of numbers below 1e-19; `floor` is for lengths.
inline constexpr double squared_floor = 1e-36;
inline constexpr double floor = 1e-18;

/// At and beyond this size of a coordinate or radius float products may overflow: the filter then
/// lets everything through.
inline constexpr float limit = 1e18f;

/// Float bounds of the two roots of a survivor, as distances along the unit direction (interval.h).
/// With h0 rounded to `unit`, F = |f|, E the origin's rounding error and l = f - b unit:
///
///   b          f, unit and the dot product, as above: 5 u F + E
///   l          f: u F, b: 5 u F + E, unit: u F, the product: u F, the difference: u F
///                                                               |error of l| <= 9 u F + E
///
/// spread = 12 u (F1 + r) + E, F1 = |fx| + |fy| + |fz|, bounds both, and the 3 u (F + r) that is
/// lost when the ends of the intervals are added up. A hit has |l| <= r, so its discriminant r^2 -
/// l.l is wrong by at most 2 r spread + spread^2 (from l) + 8 u (r + spread)^2 (from squares and
/// sums):
///   doubt = spread (2 r + 3 spread) + 12 u r^2.
inline constexpr double spread = 12;

}  // namespace boule::filter
