#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/chunks.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"

namespace boule {

/// The box around the centres of spheres, and the smallest of their radii, before they are rounded.
struct SphereExtent {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Vec3d low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  double radius = infinity;  ///< infinite: there are no spheres
  /// How far rounding moves a centre that is counted from 0, along an axis; infinite: not known.
  double rounding = 0;

  [[nodiscard]] bool is_empty() const { return std::isinf(radius); }
  /// Takes a sphere in, if it is one: the others are refused when they are read.
  void add(const Vec3d& center, double r);
  void add(const SphereExtent& other);
};

/// The extent of many spheres; add(i, extent) adds one. The same for any threads.
template <class Add>
SphereExtent extent_of(std::size_t count, const ParallelFor& parallel_for, const Add& add) {
  SphereExtent all;
  std::mutex mutex;
  in_chunks(parallel_for, count, [&](std::size_t, std::size_t begin, std::size_t end) {
    SphereExtent mine;
    for (std::size_t i = begin; i < end; ++i) add(i, mine);
    const std::lock_guard lock(mutex);
    all.add(mine);
  });
  return all;
}

/// Where the spheres of a scene are, before they are rounded: an extent for each sphere, file or
/// array of them.
using SceneExtents = std::vector<SphereExtent>;

/// The origin that a scene gets where nobody says it, the same for everything that has spheres.
///
/// It is 0, if rounding moves no centre that is counted from there by more than 2^-16 of the radius
/// of its sphere, which a picture of 65535 pixels could show (for many spheres of one part: of the
/// smallest radius). Else it is a point among the spheres, if that makes the rounding eight times
/// less; else 0. Of the points it takes a round one, so that what was moved by a round number is
/// counted as if it had not been: the one with the fewest decimal digits from where rounding is as
/// little as said, or that is within the scene, if hardly any other has so few; else the one with
/// the fewest binary digits that is almost in the middle; else one near it.
Vec3d choose_origin(const SceneExtents& spheres);

/// The same, with a note where it is not 0 or does not serve: where positions, counted from there,
/// are still rounded by a thousandth of the smallest radius. `series` is the origin that a series
/// has chosen already, with its note.
Vec3d choose_origin(const SceneExtents& spheres, const std::optional<Vec3d>& series,
                    std::vector<std::string>& notes);

}  // namespace boule
