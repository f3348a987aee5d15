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
  /// The same in memory of others, which must live longer.
  explicit SlotMaterials(const MaterialRef* by_slot) : by_slot_(by_slot) {}

  /// Precondition: the slot holds a sphere.
  [[nodiscard]] MaterialRef operator[](std::uint32_t slot) const {
    return by_slot_ == nullptr ? all_ : by_slot_[slot];
  }
  /// One for each slot, or null where all are the same.
  [[nodiscard]] const MaterialRef* by_slot() const { return by_slot_; }

 private:
  MaterialRef all_;
  LargeArray<MaterialRef> own_;
  const MaterialRef* by_slot_ = nullptr;
};

}  // namespace boule
