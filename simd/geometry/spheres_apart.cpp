#include "simd/geometry/spheres_apart.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <new>
#include <type_traits>
#include <utility>

#include "simd/geometry/binary_tree.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

/// Calls body(chunk, first, end) for all chunks of `count` elements.
void for_chunks(const ParallelFor& parallel_for, std::size_t count, const auto& body) {
  constexpr std::size_t size = tuning::chunk_size;
  parallel_for((count + size - 1) / size, [&](std::size_t chunk) {
    body(chunk, chunk * size, std::min((chunk + 1) * size, count));
  });
}

/// Spheres of three kinds.
struct Sorted {
  std::vector<std::int32_t> unfit;   ///< ids, in order, of spheres that no filter can judge
  std::vector<std::int32_t> giants;  ///< ids, in order, of spheres whose box is too large
  BuildBox rest;                     ///< the box of all others
};

void sort(const std::vector<Sphere>& spheres, std::size_t first, std::size_t end, double giant_area,
          Sorted& sorted) {
  BuildBox rest;
  for (std::size_t i = first; i < end; ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (!in_filter_range(spheres[i])) {
      sorted.unfit.push_back(id);
      continue;
    }
    // Read directly, without a BuildSphere in memory: one load after the four stores would wait for
    // them.
    const Sphere& s = spheres[i];
    const BuildBox box = rough_box(Float4{s.center.x, s.center.y, s.center.z, std::fabs(s.radius)});
    if (box.area() > giant_area) {
      sorted.giants.push_back(id);
    } else {
      rest.add(box);
    }
  }
  sorted.rest = rest;
}

Sorted sort(const std::vector<Sphere>& spheres, double giant_area,
            const ParallelFor& parallel_for) {
  std::vector<Sorted> chunks(spheres.size() / tuning::chunk_size + 1);
  for_chunks(parallel_for, spheres.size(), [&](auto chunk, std::size_t first, std::size_t end) {
    sort(spheres, first, end, giant_area, chunks[chunk]);
  });
  Sorted all;
  for (const Sorted& some : chunks) {
    all.unfit.insert(all.unfit.end(), some.unfit.begin(), some.unfit.end());
    all.giants.insert(all.giants.end(), some.giants.begin(), some.giants.end());
    all.rest.add(some.rest);
  }
  return all;
}

/// Keeps the largest `most` of `ids`, in order; among equal ones the first.
void keep_largest(std::vector<std::int32_t>& ids, std::size_t most,
                  const std::vector<Sphere>& spheres) {
  if (ids.size() <= most) return;
  const auto end = ids.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(ids.begin(), end, ids.end(), [&](std::int32_t a, std::int32_t b) {
    const float ra = std::fabs(spheres[static_cast<std::size_t>(a)].radius);
    const float rb = std::fabs(spheres[static_cast<std::size_t>(b)].radius);
    return ra != rb ? ra > rb : a < b;
  });
  ids.erase(end, ids.end());
  std::sort(ids.begin(), ids.end());
}

/// The bits of a sphere's centre and radius, which can be sorted for any floats.
std::array<std::uint32_t, 4> bits_of(const Sphere& s) {
  return {std::bit_cast<std::uint32_t>(s.center.x), std::bit_cast<std::uint32_t>(s.center.y),
          std::bit_cast<std::uint32_t>(s.center.z), std::bit_cast<std::uint32_t>(s.radius)};
}

}  // namespace

std::vector<std::int32_t> find_spheres_apart(const std::vector<Sphere>& spheres,
                                             const ParallelFor& parallel_for) {
  Sorted sorted = sort(spheres, BuildBox::inf, parallel_for);
  // The box of the rest shrinks from pass to pass, and with it the bound: each pass finds the
  // giants of the passes before again.
  while (sorted.giants.size() < tuning::most_giants) {
    Sorted next = sort(spheres, tuning::giant_share * sorted.rest.area(), parallel_for);
    if (next.giants.size() <= sorted.giants.size()) break;  // fewer: the rest was empty
    sorted = std::move(next);
  }
  // Of too many the largest are kept: each saves a box that nearly every ray would meet.
  keep_largest(sorted.giants, tuning::most_giants, spheres);
  std::vector<std::int32_t> apart;
  std::merge(sorted.unfit.begin(), sorted.unfit.end(), sorted.giants.begin(), sorted.giants.end(),
             std::back_inserter(apart));
  return apart;
}

std::vector<std::int32_t> without_copies(std::vector<std::int32_t> ids,
                                         const std::vector<Sphere>& spheres,
                                         std::vector<SphereCopy>& copies) {
  const auto bits = [&](std::int32_t id) { return bits_of(spheres[static_cast<std::size_t>(id)]); };
  std::sort(ids.begin(), ids.end(), [&](std::int32_t a, std::int32_t b) {
    return std::pair(bits(a), a) < std::pair(bits(b), b);
  });
  std::size_t kept = 0;
  for (const std::int32_t id : ids) {
    const bool one_too_many = kept >= kept_copies && bits(ids[kept - kept_copies]) == bits(id);
    if (one_too_many) {
      copies.push_back({ids[kept - kept_copies], ids[kept - 1], id});
    } else {
      ids[kept++] = id;
    }
  }
  ids.resize(kept);
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::span<BuildSphere> take_others(std::vector<Sphere>& spheres,
                                   const std::vector<std::int32_t>& apart, MaterialRef* materials,
                                   const ParallelFor& parallel_for) {
  static_assert(sizeof(BuildSphere) == sizeof(Sphere) && alignof(BuildSphere) <= alignof(Sphere));
  static_assert(std::is_trivially_destructible_v<Sphere>);
  auto* const others = reinterpret_cast<BuildSphere*>(spheres.data());
  for_chunks(parallel_for, spheres.size(), [&](auto, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Sphere s = spheres[i];
      if (materials != nullptr) materials[i] = s.material;
      new (others + i)
          BuildSphere{{s.center.x, s.center.y, s.center.z, s.radius}, static_cast<std::int32_t>(i)};
    }
  });
  std::size_t size = spheres.size();
  for (auto id = apart.rbegin(); id != apart.rend(); ++id)
    others[static_cast<std::size_t>(*id)] = others[--size];
  return {others, size};
}

}  // namespace boule
