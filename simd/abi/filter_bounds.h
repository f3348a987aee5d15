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
/// 24 is shipped. In the hard cases a slack of 4 and more drops no hit, 2 drops some: a test that
/// sets it to 2 must fail.
inline constexpr double u = 0x1p-24;
inline constexpr double slack = 24;

/// What may be lost to underflow, products of numbers below 1e-19; `floor` is for lengths.
inline constexpr double squared_floor = 1e-36;
inline constexpr double floor = 1e-18;

/// At and beyond this size of a coordinate or radius float products may overflow: the filter then
/// lets everything through.
inline constexpr float limit = 1e18f;

/// Range reject: the hit's t |dir| lies within r of f.h0. The error of b is at most
/// 5u (|fx| + |fy| + |fz|), as above, and its excess slack / 2 u F; 24 is shipped for both.
inline constexpr double range_slack = 24;

}  // namespace boule::filter
