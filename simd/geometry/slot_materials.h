#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/scene/material_ref.h"
#include "simd/geometry/large_array.h"

namespace boule {

/// The materials of the spheres in the slots of a Geometry. If all are the same, one is kept;
/// otherwise four bytes a slot. A view of foreign memory, or the owner of its own.
class SlotMaterials {
 public:
  /// All spheres have this material.
  explicit SlotMaterials(MaterialRef all = {}) : all_(all) {}
  /// One material for each slot, empty slots included.
  explicit SlotMaterials(LargeArray<MaterialRef> by_slot)
      : own_(std::move(by_slot)), by_slot_(own_.data()) {}
  /// A view of unchecked foreign memory, which must outlive it. A material outside the first
  /// `count` materials, at least one, counts as the first.
  SlotMaterials(const MaterialRef* by_slot, std::uint32_t count)
      : by_slot_(by_slot), count_(count) {}

  /// Precondition: the slot holds a sphere.
  [[nodiscard]] MaterialRef operator[](std::uint32_t slot) const {
    if (by_slot_ == nullptr) return all_;
    const MaterialRef ref = by_slot_[slot];
    return ref.index() < count_ ? ref : MaterialRef();
  }
  /// One material for each slot, or null if all are the same. A view may hold unknown materials.
  [[nodiscard]] const MaterialRef* by_slot() const { return by_slot_; }
  /// A view of the same materials, which must outlive it.
  [[nodiscard]] SlotMaterials borrowed() const {
    return by_slot_ == nullptr ? SlotMaterials(all_) : SlotMaterials(by_slot_, count_);
  }

 private:
  MaterialRef all_;
  LargeArray<MaterialRef> own_;
  const MaterialRef* by_slot_ = nullptr;
  std::uint32_t count_ = 0x80000000;
};

}  // namespace boule
