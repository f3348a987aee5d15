#pragma once

#include <cstddef>

#include "core/math/elementary.h"
#include "simd/abi/shading.h"
#include "simd/kernel/vectors.h"

/// Directions by numbers, W at a time: core/math/warp.h and core/light_cone.cpp in lanes, bit for
/// bit.
namespace boule::BOULE_KERNEL_ISA {

/// Cosine and sine of an angle.
struct AngleLanes {
  Wide cosine, sine;
};

/// The angle of so many turns, 0 <= turns <= 1.
BOULE_INLINE AngleLanes full_turns(const Wide& turns) {
  const Wide quarters = turns * Wide(4.0) + Wide(0.5);
  Wide quarter(0.0);  // rounded down
  for (double k = 1; k <= 4; ++k) quarter = select(Wide(k) <= quarters, Wide(k), quarter);
  const Wide a = (turns - quarter * Wide(0.25)) * Wide(2 * elementary::pi), z = a * a;
  constexpr double sines[] = {-1.0 / 6,        1.0 / 120,         -1.0 / 5040,         1.0 / 362880,
                              -1.0 / 39916800, 1.0 / 6227020800., -1.0 / 1307674368000};
  constexpr double cosines[] = {
      -1.0 / 2,       1.0 / 24,        -1.0 / 720,         1.0 / 40320,
      -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  Wide s(0.0), c(0.0);
  for (int k = 6; k >= 0; --k) s = Wide(sines[k]) + z * s;
  for (int k = 7; k >= 0; --k) c = Wide(cosines[k]) + z * c;
  const Wide sine = a + a * (z * s), cosine = Wide(1.0) + z * c;
  const WideMask odd = (quarter == Wide(1.0)) | (quarter == Wide(3.0));
  const Wide sign = select((quarter == Wide(2.0)) | (quarter == Wide(3.0)), Wide(-1.0), Wide(1.0));
  return {select(odd, sine * Wide(-1.0), cosine) * sign, select(odd, cosine, sine) * sign};
}

/// The direction at an angle `from` the axis and `turns` around it.
BOULE_INLINE Vec3<Wide> direction_about(const Vec3<Wide>& axis, const AngleLanes& from,
                                        const Wide& turns) {
  const Wide sign = copysign(Wide(1.0), axis.z), minus = sign * Wide(-1.0);
  const Wide a = Wide(-1.0) / (sign + axis.z), b = axis.x * axis.y * a;
  const Vec3<Wide> x{Wide(1.0) + sign * axis.x * axis.x * a, sign * b, minus * axis.x};
  const Vec3<Wide> y{b, sign + axis.y * axis.y * a, axis.y * Wide(-1.0)};
  const AngleLanes around = full_turns(turns);
  return x * (from.sine * around.cosine) + y * (from.sine * around.sine) + axis * from.cosine;
}

BOULE_INLINE void turn(const TurnStream& turns) {
  for (std::size_t first = 0; first < turns.size; first += width) {
    const AngleLanes from{load(turns.cosine + first), load(turns.sine + first)};
    store(turns.direction, first,
          direction_about(load(turns.axis, first), from, load(turns.turns + first)));
  }
}

/// The larger of a number and 0; 0 for NaN.
BOULE_INLINE Wide positive(const Wide& a) { return select(Wide(0.0) < a, a, Wide(0.0)); }

BOULE_INLINE void seek_packet(const SeekStream& seekers, std::size_t first) {
  const Vec3<Wide> way = load(seekers.center, first) - load(seekers.org, first);
  const Wide radius = load(seekers.radius + first), distance = sqrt(dot(way, way));
  const Vec3<Wide> axis = way * (Wide(1.0) / distance);
  const Wide ratio = radius / distance;
  const Wide height = ratio * ratio / (Wide(1.0) + sqrt(Wide(1.0) - ratio * ratio));
  const WideMask outside = (radius < distance) & (Wide(0.0) < height);
  const Wide density = Wide(1.0) / (Wide(2 * elementary::pi) * height);
  const Wide h = load(seekers.u + first) * height;
  const Vec3<Wide> direction =
      direction_about(axis, {Wide(1.0) - h, sqrt(h * (Wide(2.0) - h))}, load(seekers.v + first));
  const Vec3<Wide> aside = cross(direction, axis) * distance;
  const Wide nearest = positive(sqrt(dot(aside, aside)) - Wide(2 * 0x1p-24) * distance);
  const Wide passed = nearest * nearest;
  const Wide end =
      sqrt(positive(distance * distance - passed)) - sqrt(positive(radius * radius - passed));
  store(seekers.direction, first, direction);
  store(seekers.density + first, select(outside, density, Wide(0.0)));
  store(seekers.tmax + first, narrow(end * Wide(1 - 4 * 0x1p-24)));
}

BOULE_INLINE void seek(const SeekStream& seekers) {
  for (std::size_t first = 0; first < seekers.size; first += width) seek_packet(seekers, first);
}

}  // namespace boule::BOULE_KERNEL_ISA
