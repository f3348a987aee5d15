#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "core/reference.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"

namespace boule::test {

/// The names every wide test is parameterised by: all ISAs that any build has, so that one which
/// this CPU lacks shows as skipped.
inline std::vector<std::string> all_isa_names() {
  std::vector<std::string> names;
  for (const IsaInfo& info : list_isas()) names.emplace_back(info.name);
  return names;
}

/// The kernels of an ISA, or nullptr where this CPU cannot run them: then the test skips.
inline const KernelTable* kernels_or_null(const std::string& isa) {
  const auto kernels = select_kernels(isa);
  return kernels ? kernels.value() : nullptr;
}

/// A test on the kernels of each ISA: skipped, and shown so, where this CPU cannot run them.
class OnEachIsa : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    kernels = kernels_or_null(GetParam());
    if (kernels == nullptr) GTEST_SKIP() << "this CPU has no " << GetParam();
  }

  const KernelTable* kernels = nullptr;
};
/// The parameters of such a test, and their names.
inline auto each_isa() { return testing::ValuesIn(all_isa_names()); }
inline std::string isa_name(const testing::TestParamInfo<std::string>& tested) {
  return tested.param;
}

inline RayBuffer to_stream(const std::vector<Ray>& rays) {
  RayBuffer buffer(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) buffer.set(i, rays[i]);
  return buffer;
}

/// Whether all rays have the same bits of what rays with this in common share.
inline bool have_in_common(const std::vector<Ray>& rays, CommonPart common) {
  const auto bits = [common](const Ray& ray) {
    const auto part = common == CommonPart::origin ? ray.org : vec_cast<double>(ray.dir);
    return std::tuple(std::bit_cast<std::array<std::uint64_t, 3>>(part),
                      std::bit_cast<std::uint64_t>(ray.tmin), ray.source, ray.inside);
  };
  return !rays.empty() &&
         std::ranges::all_of(rays, [&](const Ray& ray) { return bits(ray) == bits(rays[0]); });
}
/// The rays with what they share once.
inline RayBuffer to_shared_stream(const std::vector<Ray>& rays, CommonPart common) {
  RayBuffer buffer(rays.size(), common);
  buffer.share(rays.at(0));
  for (std::size_t i = 0; i < rays.size(); ++i) buffer.set(i, rays[i]);
  return buffer;
}
/// The streams that rays of this coherence come in: each with numbers of its own and, where they do
/// have that in common, with what they share once.
inline std::vector<RayBuffer> streams_of(const std::vector<Ray>& rays, Coherence coherence) {
  std::vector<RayBuffer> all;
  all.push_back(to_stream(rays));
  for (const CommonPart common : {CommonPart::origin, CommonPart::direction}) {
    if (coherence_of(common) == coherence && have_in_common(rays, common))
      all.push_back(to_shared_stream(rays, common));
  }
  return all;
}

/// Whether a hit of a sphere names the slot where that sphere lies.
inline bool names_its_slot(const GeometryView& geometry, const Hit& hit) {
  const auto id = static_cast<std::uint32_t>(hit.id);
  if (id >= static_cast<std::uint32_t>(geometry.planes.first_id)) return true;
  for (std::size_t i = 0; i < geometry.parts.size; ++i) {
    const PartView& part = geometry.parts.parts[i];
    const std::uint32_t slot = hit.slot - part.first_slot;
    if (slot >= part.slots) continue;
    return static_cast<std::uint32_t>(part.first_id) + static_cast<std::uint32_t>(part.id[slot]) ==
           id;
  }
  return hit.slot < geometry.spheres.block_count * bvh_leaf_size &&
         geometry.spheres.id[hit.slot] == hit.id;
}

/// Same id and the same bits of t.
inline bool same_bits(const Hit& a, const Hit& b) {
  return a.id == b.id && std::bit_cast<std::uint64_t>(a.t) == std::bit_cast<std::uint64_t>(b.t);
}

/// The kernels' nearest hits of these rays, which are the same in all of their streams.
inline std::vector<Hit> run_closest(const KernelTable& kernels, const GeometryView& geometry,
                                    const std::vector<Ray>& rays, const Query& query) {
  std::vector<Hit> result;
  for (RayBuffer& stream : streams_of(rays, query.coherence)) {
    HitBuffer hits(rays.size());
    kernels.closest_hit(geometry, stream.view(), query, hits.view());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit hit = hits.get(i);
      EXPECT_TRUE(names_its_slot(geometry, hit)) << "ray " << i;
      if (result.size() <= i) result.push_back(hit);
      EXPECT_TRUE(same_bits(hit, result[i])) << "ray " << i << ", which shares numbers";
    }
  }
  return result;
}

/// What lets kernels sort all rays by their directions, up to a million: earlier trials are said to
/// have preferred the way `sorted` of simd/kernel/search/flock/scattered_stream.h.
inline Experience experience_of_sorting() {
  constexpr std::uint32_t sorted = 3;
  Experience known;
  known.way = known.last_way = sorted;
  known.rays = known.left = 1U << 20;
  return known;
}
/// The kernels' nearest hits of these rays, all sorted. Precondition: the geometry has a tree.
inline std::vector<Hit> run_sorted(const KernelTable& kernels, const GeometryView& geometry,
                                   const std::vector<Ray>& rays) {
  Experience known = experience_of_sorting();
  auto hits = run_closest(kernels, geometry, rays,
                          {Solver::robust, Form::automatic, Coherence::none, &known});
  EXPECT_EQ(known.left, known.rays - rays.size()) << "some rays went through a trial";
  return hits;
}

/// The kernels' occlusion of these rays, 0 or 1, which is the same in all of their streams.
inline std::vector<int> run_any(const KernelTable& kernels, const GeometryView& geometry,
                                const std::vector<Ray>& rays, const Query& query) {
  std::vector<std::vector<int>> found;
  for (RayBuffer& stream : streams_of(rays, query.coherence)) {
    AlignedArray<std::uint8_t> occluded(rays.size(), 255);
    kernels.any_hit(geometry, stream.view(), query, occluded.data());
    found.emplace_back(occluded.data(), occluded.data() + rays.size());
    EXPECT_EQ(found.back(), found.front());
  }
  return found.front();
}

}  // namespace boule::test
