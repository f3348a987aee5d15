#include "render/files/scene_file/loaded/scene_data.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/chunks.h"
#include "render/files/file/float32.h"
#include "render/files/file/sphere_room.h"

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

}  // namespace

SphereExtent SphereArrays::extent(const ParallelFor& parallel_for) const {
  return extent_of(spheres.size(), parallel_for, [&](std::size_t i, SphereExtent& extent) {
    const Sphere& sphere = spheres[i];
    extent.add(centers.empty() ? vec_cast<double>(sphere.center) + base : centers[i],
               static_cast<double>(sphere.radius));
  });
}

Status SphereArrays::append_to(std::vector<Sphere>& target, const Vec3d& origin,
                               const ParallelFor& parallel_for) const {
  const std::size_t before = target.size(), count = spheres.size();
  make_room(target, count);
  target.insert(target.end(), spheres.begin(), spheres.end());
  if (centers.empty() && base == origin) return {};
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::atomic<std::size_t> bad{none};
  const Vec3d shift = base - origin;
  parallel_for(chunks_of(count), [&](std::size_t chunk) {
    const std::size_t end = std::min(count, (chunk + 1) * chunk_size);
    for (std::size_t i = chunk * chunk_size; i < end; ++i) {
      Sphere& sphere = target[before + i];
      sphere.center = centers.empty() ? rounded(vec_cast<double>(sphere.center) + shift)
                                      : rounded(centers[i] - origin);
      if (!is_valid(sphere)) report(bad, i);
    }
  });
  if (bad == none) return {};
  target.resize(before);
  return Diagnostic::of("row " + std::to_string(bad) + ": center is too large for a 32-bit float");
}

}  // namespace boule
