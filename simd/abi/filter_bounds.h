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
