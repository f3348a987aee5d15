#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/scene/material_ref.h"
#include "simd/geometry/large_array.h"

namespace boule {

/// What the spheres in the slots of a Geometry are made of. Where all are made of the same, that is
/// kept once; else four bytes a slot. A view of others' memory, or the owner of its own.
class SlotMaterials {
 public:
  /// All are made of this.
  explicit SlotMaterials(MaterialRef all = {}) : all_(all) {}
  /// One for each slot, those that hold no sphere among them.
  explicit SlotMaterials(LargeArray<MaterialRef> by_slot)
      : own_(std::move(by_slot)), by_slot_(own_.data()) {}
  /// The same in memory of others, which must live longer and which nobody has checked: what is not
  /// among the first `count` materials, at least one, counts as the first of them.
  SlotMaterials(const MaterialRef* by_slot, std::uint32_t count)
      : by_slot_(by_slot), count_(count) {}

  /// Precondition: the slot holds a sphere.
  [[nodiscard]] MaterialRef operator[](std::uint32_t slot) const {
    if (by_slot_ == nullptr) return all_;
    const MaterialRef ref = by_slot_[slot];
    return ref.index() < count_ ? ref : MaterialRef();
  }
  /// One for each slot, or null where all are the same. Those of a view may be unknown materials.
  [[nodiscard]] const MaterialRef* by_slot() const { return by_slot_; }
  /// A view of the same, which must live longer.
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
