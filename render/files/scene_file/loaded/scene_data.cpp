#include "render/files/scene_file/loaded/scene_data.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "core/base/chunks.h"
#include "render/files/file/float32.h"
#include "render/files/file/sphere_room.h"
#include "render/files/scene_file/loaded/primitive_points.h"

namespace boule {
namespace {

Vec3f rounded(const Vec3d& v) {
  return {float32_or_inf(v.x), float32_or_inf(v.y), float32_or_inf(v.z)};
}

/// Keeps the least of the indices that threads report.
void report(std::atomic<std::size_t>& least, std::size_t index) {
  std::size_t known = least;
  while (index < known && !least.compare_exchange_weak(known, index)) {
  }
}

template <class Primitive>
SphereExtent extent_in(const std::vector<Primitive>& all, const std::vector<Vec3d>& exact,
                       const Vec3d& base, const ParallelFor& parallel_for) {
  return extent_of(all.size(), parallel_for, [&](std::size_t i, SphereExtent& extent) {
    std::size_t at = i * point_count<Primitive>;
    for (const Vec3f* const point : points_of(all[i])) {
      extent.add(exact.empty() ? vec_cast<double>(*point) + base : exact[at++],
                 static_cast<double>(all[i].radius));
    }
  });
}

/// Appends primitives whose points are counted from `base`, or are the exact ones.
template <class Primitive>
Status append(const std::vector<Primitive>& all, const std::vector<Vec3d>& exact, const Vec3d& base,
              std::vector<Primitive>& target, const Vec3d& origin,
              const ParallelFor& parallel_for) {
  const std::size_t before = target.size(), count = all.size();
  make_room(target, count);
  target.insert(target.end(), all.begin(), all.end());
  if (exact.empty() && base == origin) return {};
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::atomic<std::size_t> bad{none};
  const Vec3d shift = base - origin;
  parallel_for(chunks_of(count), [&](std::size_t chunk) {
    const std::size_t end = std::min(count, (chunk + 1) * chunk_size);
    for (std::size_t i = chunk * chunk_size; i < end; ++i) {
      Primitive& one = target[before + i];
      std::size_t at = i * point_count<Primitive>;
      for (Vec3f* const point : points_of(one)) {
        *point = exact.empty() ? rounded(vec_cast<double>(*point) + shift)
                               : rounded(exact[at++] - origin);
      }
      if (!is_valid(one)) report(bad, i);
    }
  });
  if (bad == none) return {};
  target.resize(before);
  const char* const what = std::is_same_v<Primitive, Sphere> ? "center" : "an end";
  return Diagnostic::of("row " + std::to_string(bad) + ": " + what +
                        " is too large for a 32-bit float");
}

}  // namespace

SphereExtent SphereArrays::extent(const ParallelFor& parallel_for) const {
  return extent_in(spheres, centers, base, parallel_for);
}

SphereExtent CapsuleArrays::extent(const ParallelFor& parallel_for) const {
  return extent_in(capsules, ends, base, parallel_for);
}

Status SphereArrays::append_to(std::vector<Sphere>& target, const Vec3d& origin,
                               const ParallelFor& parallel_for) const {
  return append(spheres, centers, base, target, origin, parallel_for);
}

Status CapsuleArrays::append_to(std::vector<Capsule>& target, const Vec3d& origin,
                                const ParallelFor& parallel_for) const {
  return append(capsules, ends, base, target, origin, parallel_for);
}

}  // namespace boule
