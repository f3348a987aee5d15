#pragma once

namespace boule::filter {

/// The constants of the conservative float reject, in units of u = 2^-24. The reject is a filter:
/// it may let a miss through, it never drops a hit. Derivation, F = |f|, f = c - o, b = f.h:
///
///   value      error of its float form                             bound
///   h          each component rounded once                         u per component
///   f          each component rounded once                         u F
///   b * b      two roundings of f and h, three of the dot, one of
///              the product; |b| <= F, twice for the square          12 u F^2
///   s = f.f    two of f, three of the dot, one of (1 - 24u) s       6 u F^2
///   b*b - s    the difference itself                                1 u F^2
///                                                          sum     19 u F^2
///
/// so that b*b - (1 - slack u) s < -r2p with slack >= 19 implies l.l = s - b^2 > r^2 in exact
/// arithmetic. 24 is shipped. In 3.4 million hard pairs slacks of 0, 1, 2, 3 gave false rejects, 4
/// and more none.
inline constexpr double u = 0x1p-24;
inline constexpr double slack = 24;

/// r^2 and r are stored times 1 + 8u and rounded outward; the absolute terms stand for what may
/// be lost to underflow: products of numbers below 1e-19.
inline constexpr double radius_slack = 8;
inline constexpr double squared_floor = 1e-36;
inline constexpr double floor = 1e-18;

/// At and beyond this size of a coordinate or radius float products may overflow: the filter then
/// lets everything through.
inline constexpr float limit = 1e18f;

/// Range reject: |error of b| <= 6u (|fx| + |fy| + |fz|), as above without the square; 16 shipped.
/// The hit's t |d| lies within r of b.
inline constexpr double range_slack = 16;

}  // namespace boule::filter
