#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "simd/abi/capsules.h"
#include "simd/geometry/large_array.h"

namespace boule {

/// Capsules laid out for the kernels: blocks of sixteen, and a tree over their boxes. Immutable
/// once built. Takes any floats: rays miss a capsule that has NaN or infinity, and a negative
/// radius counts by its absolute value.
class CapsuleTree {
 public:
  /// The capsules get the ids first_id and higher. Precondition: all ids are at most
  /// max_primitives. Throws std::bad_alloc, and the exceptions of `parallel_for`.
  CapsuleTree(const std::vector<Capsule>& capsules, std::int32_t first_id,
              const ParallelFor& parallel_for = serial_for);

  /// Valid as long as this object lives.
  [[nodiscard]] CapsuleView view() const;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t slots() const { return ids_.size(); }
  /// The capsule in a slot, in the default material. Precondition: there is one.
  [[nodiscard]] Capsule capsule(std::uint32_t slot) const;

 private:
  std::size_t size_, scanned_ = 0;
  std::int32_t first_id_;
  LargeArray<CapsuleBlock> blocks_;
  LargeArray<std::int32_t> ids_;  ///< by slot; empty_slot where there is none
  LargeArray<BvhNode> nodes_;
  float extent_ = 0;
};

}  // namespace boule
