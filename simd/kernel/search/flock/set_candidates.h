#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/tuning.h"
#include "simd/lanes/lanes.h"

/// Spheres that may be the nearest hit of a ray of a set. The double solver decides after the
/// traversal, when most of them are known to lie behind another hit.
namespace boule::BOULE_KERNEL_ISA {

class SetCandidates {
 public:
  /// Adds a ray with W spheres: those `chosen` among the slots from `slot` on; `low` are lower
  /// bounds of their hits.
  BOULE_INLINE void add(std::uint32_t ray, std::uint32_t slot, const Real& low, unsigned chosen) {
    store_chosen(low_ + size_, low, chosen);
    store_chosen(slot_ + size_, count_from(slot), chosen);
    store_anywhere(ray_ + size_, Bits(ray));
    size_ += static_cast<std::size_t>(std::popcount(chosen));
  }
  /// Whether the candidates must be solved now; those of one more leaf still find room.
  [[nodiscard]] BOULE_INLINE bool is_full() const { return size_ > most; }
  void clear() { size_ = 0; }

  [[nodiscard]] BOULE_INLINE std::size_t size() const { return size_; }
  [[nodiscard]] BOULE_INLINE float low(std::size_t k) const { return low_[k]; }
  [[nodiscard]] BOULE_INLINE std::uint32_t slot(std::size_t k) const { return slot_[k]; }
  [[nodiscard]] BOULE_INLINE std::uint32_t ray(std::size_t k) const { return ray_[k]; }

 private:
  static constexpr std::size_t most = tuning::most_candidates * tuning::set_size;
  static constexpr std::size_t capacity = most + bvh_leaf_size * tuning::set_size + width;

  std::size_t size_ = 0;
  float low_[capacity];
  std::uint32_t slot_[capacity], ray_[capacity];
};

/// For any hit: undecided pairs are solved soon, without a list.
struct NoCandidates {};

}  // namespace boule::BOULE_KERNEL_ISA
