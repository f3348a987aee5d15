#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/flock/flight.h"
#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/search/leaf/primitive_access.h"

/// The double solves of flights and of sets. A ray has one or two candidates; the candidates of
/// several rays together fill the lanes.
namespace boule::BOULE_KERNEL_ISA {

/// Keeps a hit of a ray if it is nearer than the ray's nearest one so far.
BOULE_INLINE void answer(const HitStream& hits, std::size_t ray, const Hit& hit) {
  const bool nearer = hit.t < hits.t[ray] || (hit.t == hits.t[ray] && hit.id < hits.id[ray]);
  if (!nearer) return;
  hits.t[ray] = hit.t;
  hits.id[ray] = hit.id;
  hits.slot[ray] = hit.slot;
}
/// Records that a ray has a hit.
BOULE_INLINE void answer(std::uint8_t* occluded, std::size_t ray, const Hit&) { occluded[ray] = 1; }

/// Pairs of a ray and a sphere that wait for the double solver, which takes W of them at a time.
/// Answers: HitStream for nearest hits, std::uint8_t* for any.
template <class Answers>
class PairQueue {
 public:
  PairQueue(const RayStream& rays, const SphereView& spheres, const Answers& answers)
      : rays_(rays), spheres_(spheres), answers_(answers) {}

  /// Adds a ray's candidates, except those that are hit beyond `reach`.
  BOULE_INLINE void add(std::uint32_t ray, const FlightCandidates& candidates, float reach) {
    unsigned first = 0;
    do {  // once, for nearly every ray
      const unsigned chosen = candidates.before(reach, first);
      store_chosen(slot_ + size_, load_integers(candidates.slot + first), chosen);
      store_anywhere(ray_ + size_, Bits(ray));
      added(chosen);
      first += width;
    } while (first < candidates.size);
  }
  /// Adds a ray with W spheres, those `chosen` among the slots from `slot` on.
  BOULE_INLINE void add(std::uint32_t ray, std::uint32_t slot, unsigned chosen) {
    store_chosen(slot_ + size_, count_from(slot), chosen);
    store_anywhere(ray_ + size_, Bits(ray));
    added(chosen);
  }
  /// Adds a ray with one sphere, if `really`; without a branch, because it is unpredictable.
  BOULE_INLINE void add_if(bool really, std::uint32_t ray, std::uint32_t slot) {
    slot_[size_] = slot;
    ray_[size_] = ray;
    added(really ? 1 : 0);
  }
  /// Solves the pairs that still wait.
  BOULE_INLINE void finish() {
    if (size_ > 0) solve(size_);
    size_ = 0;
  }

 private:
  /// Counts pairs that were stored behind the others, one per bit of `chosen`, and solves W of them
  /// if there are that many.
  BOULE_INLINE void added(unsigned chosen) {
    size_ += static_cast<std::size_t>(std::popcount(chosen));
    if (size_ < width) return;
    solve(width);
    size_ -= width;
    store(slot_, load_integers(slot_ + width));
    store(ray_, load_integers(ray_ + width));
  }
  /// Solves the first `count` pairs, at most W.
  BOULE_NOINLINE void solve(std::size_t count) {
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t from = k < count ? k : 0;
      gathered_.set(k, rays_, ray_[from]);
      slot_[k] = slot_[from];
    }
    const SphereLanes spheres = gather_spheres(spheres_, load_integers(slot_));
    ExactRays rays;
    load_exact(gathered_.view(width), 0, rays);
    const Roots roots = solve_robust(rays, spheres);
    alignas(64) double t[width];
    alignas(64) std::int32_t id[width];
    store(t, roots.t);
    store(id, spheres.id);
    const unsigned hit = bits(roots.hit);
    for (std::size_t k = 0; k < count; ++k) {
      if ((hit >> k & 1U) == 0) continue;
      answer(answers_, ray_[k], {t[k], id[k], slot_[k]});
    }
  }

  const RayStream& rays_;
  const SphereView& spheres_;
  const Answers answers_;
  GatheredRays<width> gathered_;
  alignas(64) std::uint32_t ray_[2 * width], slot_[2 * width];
  std::size_t size_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
