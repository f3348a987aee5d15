#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/abi/bvh.h"
#include "simd/kernel/tuning.h"
#include "simd/lanes/lanes.h"

/// The nodes and leaves that a ray in flight has yet to visit.
namespace boule::BOULE_KERNEL_ISA {

/// A queue in which the child that is entered first comes first. The children are unsorted; pop()
/// looks for the nearest. Of each entry distance, 16 bits are kept, rounded down: eight of exponent
/// and eight of mantissa. Comparisons with them let a little more through.
class PendingChildren {
 public:
  PendingChildren() {
    size_ = most_sorted;  // so that clear() clears all that pop() reads
    clear();
  }

  BOULE_INLINE void clear() {
    std::size_t at = 0;
    do {  // once, for nearly every ray
      __builtin_memset(near_ + at, 0xff, step * sizeof near_[0]);
      at += step;
    } while (at < size_);
    size_ = 0;
  }
  /// Adds the children of the lanes `chosen`; `near`: lower bounds of their entry distances, at
  /// least 0.
  BOULE_INLINE void push(const Real& near, const Bits& child, RealMask chosen) {
    const unsigned in = bits(chosen);
    store_chosen_halves(near_ + size_, near, chosen);
    store_chosen(child_ + size_, child, in);
    size_ += static_cast<std::size_t>(std::popcount(in));
  }

  /// Takes the nearest child. Returns false if every one is entered beyond `reach`; `child` is then
  /// undefined. There is no branch on either, because both are unpredictable.
  BOULE_INLINE bool pop(float reach, std::uint32_t& child) {
    const unsigned end = half_of(reach);
    while (size_ > most_sorted && end < near_[size_ - 1]) --size_;
    const std::size_t index = size_ <= most_sorted ? nearest() : size_ - 1;
    const bool left = near_[index] <= end;
    child = child_[index];
    size_ -= static_cast<std::size_t>(left);
    near_[index] = near_[size_];
    child_[index] = child_[size_];
    near_[size_] = none;
    return left;
  }

 private:
  /// Number of children that are compared at once.
  static constexpr std::size_t step = 16;
  /// Greater than the 16 bits of infinity, 0xff00.
  static constexpr std::uint16_t none = 0xffff;

  /// The upper 16 bits behind the sign, as store_chosen_halves() has them.
  BOULE_INLINE static std::uint16_t half_of(float near) {
    return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(near) << 1 >> 16);
  }
  BOULE_INLINE std::size_t nearest() const {
    std::size_t index = index_of_least(near_);
    for (std::size_t first = step; first < size_; first += step) {
      const std::size_t other = first + index_of_least(near_ + first);
      index = near_[other] < near_[index] ? other : index;
    }
    return index;
  }

  /// Above this number the last child is taken, whatever its distance. The ray then goes down the
  /// tree depth first, which bounds the number of children.
  static constexpr std::size_t most_sorted = tuning::most_sorted_children;
  static constexpr std::size_t most = most_sorted + bvh_max_depth * (bvh_width - 1) + 1;
  /// A push writes W children, however few it adds.
  static constexpr std::size_t capacity = (most + width + step - 1) / step * step;

  alignas(64) std::uint16_t near_[capacity];  ///< behind the last one `none`, as far as pop() reads
  alignas(64) std::uint32_t child_[capacity];
  std::size_t size_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
