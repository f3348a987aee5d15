#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/abi/filter_bounds.h"
#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/tuning.h"

/// Geometries of several parts, which may be one tree shown many times. The kernels move the
/// spheres and leave the rays as they are: a leaf's spheres move to their place in the scene, with
/// the roundings of transformed() (core/scene/group.h), and then meet rays like those of any leaf.
/// So every hit equals, bit for bit, that of the expanded scene. Boxes of nodes are moved outward
/// (filter::moved_box).
namespace boule::BOULE_KERNEL_ISA {

/// Moves spheres from a part's coordinates to their place in the scene.
template <class Number>
struct Placement {
  Vec3<Number> row_x, row_y, row_z;
  Number scale;
  Vec3<Number> shift;

  BOULE_INLINE explicit Placement(const PlacementView& from)
      : row_x(all(from.row_x)),
        row_y(all(from.row_y)),
        row_z(all(from.row_z)),
        scale(from.scale),
        shift(all(from.shift)) {}
  /// Similarity::apply().
  BOULE_INLINE Vec3<Number> apply(const Vec3<Number>& p) const {
    return Vec3<Number>{dot(row_x, p), dot(row_y, p), dot(row_z, p)} * scale + shift;
  }

 private:
  BOULE_INLINE static Vec3<Number> all(const Vec3d& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
  }
};

/// The sphere in a slot of a part, as placed in the scene.
BOULE_INLINE SlotSphere get_slot(const PartView& part, std::size_t slot) {
  const SphereBlock& block = part.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  const SlotSphere own{block.center_x[k], block.center_y[k], block.center_z[k], block.radius[k]};
  if (!part.placement.moves) return own;
  const Placement<double> placement(part.placement);
  const Vec3d center = placement.apply({double{own.x}, double{own.y}, double{own.z}});
  return {static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z),
          static_cast<float>(placement.scale * double{own.radius})};
}

/// The spheres of all parts, by their slots in the scene. The object remembers the part of the last
/// sphere, because the next sphere is mostly in it too. Each search needs its own object.
class PartSpheres {
 public:
  BOULE_INLINE explicit PartSpheres(const PartsView& parts)
      : parts_(parts.parts), size_(parts.size), last_(parts.parts) {}

  [[nodiscard]] BOULE_INLINE const PartView& part(std::size_t index) const { return parts_[index]; }
  /// The part that holds a slot. Precondition: there is one.
  [[nodiscard]] BOULE_INLINE const PartView& part_of(std::uint32_t slot) const {
    if (slot - last_->first_slot >= last_->slots) find(slot);
    return *last_;
  }

 private:
  BOULE_NOINLINE void find(std::uint32_t slot) const {
    const PartView* first = parts_;
    for (std::size_t left = size_; left > 1;) {  // the part is among `left` from `first` on
      const std::size_t half = left / 2;
      const bool upper = first[half].first_slot <= slot;
      first += upper ? half : 0;
      left = upper ? left - half : half;
    }
    last_ = first;
  }

  const PartView* parts_;
  std::size_t size_;
  mutable const PartView* last_;
};

BOULE_INLINE SlotSphere get_slot(const PartSpheres& spheres, std::size_t slot) {
  const PartView& part = spheres.part_of(static_cast<std::uint32_t>(slot));
  return get_slot(part, slot - part.first_slot);
}
BOULE_INLINE std::int32_t id_of(const PartSpheres& spheres, std::size_t slot) {
  const PartView& part = spheres.part_of(static_cast<std::uint32_t>(slot));
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(part.first_id) +
                                   static_cast<std::uint32_t>(part.id[slot - part.first_slot]));
}

/// All primitives in a geometry of parts.
struct PartsGeometry {
  PartSpheres spheres;
  const PlaneView& planes;
  const BvhView& bvh;  ///< the tree over the parts

  BOULE_INLINE explicit PartsGeometry(const GeometryView& geometry)
      : spheres(geometry.parts), planes(geometry.planes), bvh(geometry.bvh) {}
};

/// The type of a geometry's spheres: SphereView, or PartSpheres.
template <class Geometry>
using SpheresOf = std::remove_cvref_t<decltype(Geometry::spheres)>;

/// The tree of one part, as placed in the scene.
class PartTree {
 public:
  BOULE_INLINE explicit PartTree(const PartView& part) : part_(part), placement_(part.placement) {
    const PlacementView& p = part.placement;
    set_row(0, p.row_x * p.scale, p.shift.x);
    set_row(1, p.row_y * p.scale, p.shift.y);
    set_row(2, p.row_z * p.scale, p.shift.z);
  }
  PartTree(const PartTree&) = delete;
  PartTree& operator=(const PartTree&) = delete;

  [[nodiscard]] const PartView& part() const { return part_; }

  /// A node with its boxes as placed in the scene; valid until the next call.
  [[nodiscard]] BOULE_INLINE const BvhNode& node(std::uint32_t child) const {
    const BvhNode& own = part_.nodes[child];
    if (!part_.placement.moves) return own;
    move(own);
    return node_;
  }
  /// The leaf of a child; valid until the next call of this or of block().
  [[nodiscard]] BOULE_INLINE LeafRef leaf(std::uint32_t child) const {
    return block(part_.scanned + index_of(child) * static_cast<std::uint32_t>(bvh_leaf_size));
  }
  /// The block that begins at a slot of the part.
  [[nodiscard]] BOULE_INLINE LeafRef block(std::uint32_t slot) const {
    const SphereBlock& own = part_.blocks[slot / bvh_leaf_size];
    move(part_.id + slot);
    const std::size_t scene_slot = std::size_t{part_.first_slot} + slot;
    if (!part_.placement.moves) return {own, ids_, scene_slot};
    move(own);
    return {block_, ids_, scene_slot};
  }
  /// Prefetches the data of a visit of the child.
  BOULE_INLINE void fetch(std::uint32_t child) const {
    if (part_.slots <= tuning::most_near_blocks * bvh_leaf_size) return;
    const std::size_t index = index_of(child);
    const bool is_leaf = (child & leaf_bit) != 0;
    const char* const begin =
        is_leaf
            ? reinterpret_cast<const char*>(part_.blocks + part_.scanned / bvh_leaf_size + index)
            : reinterpret_cast<const char*>(part_.nodes + index);
    for (int line = 0; line < 4; ++line) __builtin_prefetch(begin + 64 * line);
    if (is_leaf) {
      __builtin_prefetch(part_.id + part_.scanned + index * bvh_leaf_size);
    } else {
      for (int line = 4; line < 8; ++line) __builtin_prefetch(begin + 64 * line);
    }
  }

 private:
  BOULE_INLINE void set_row(int i, const Vec3d& row, double shift) {
    turned_[i][0] = static_cast<float>(row.x);
    turned_[i][1] = static_cast<float>(row.y);
    turned_[i][2] = static_cast<float>(row.z);
    for (int j = 0; j < 3; ++j) stretched_[i][j] = __builtin_fabsf(turned_[i][j]);
    shift_[i] = static_cast<float>(shift);
  }
  /// Moves the ids of sixteen slots. Empty slots have the radius NaN, whatever their id.
  BOULE_INLINE void move(const std::int32_t* own) const {
    for (std::size_t at = 0; at < bvh_leaf_size; at += width)
      store(ids_ + at, load_integers(own + at) + Bits(part_.first_id));
  }
  BOULE_INLINE void move(const SphereBlock& own) const {
    for (std::size_t at = 0; at < bvh_leaf_size; at += width) {
      const Vec3<Real> center{load(own.center_x + at), load(own.center_y + at),
                              load(own.center_z + at)};
      const Vec3<Real> moved = narrow(placement_.apply(widen(center)));
      store(block_.center_x + at, moved.x);
      store(block_.center_y + at, moved.y);
      store(block_.center_z + at, moved.z);
      store(block_.radius + at, narrow(placement_.scale * widen(load(own.radius + at))));
    }
  }
  /// Moves the boxes of a node: their centres, and half their sizes by the largest extent after
  /// rotation.
  BOULE_INLINE void move(const BvhNode& own) const {
    const float* const low[3] = {own.min_x, own.min_y, own.min_z};
    const float* const high[3] = {own.max_x, own.max_y, own.max_z};
    float* const moved_low[3] = {node_.min_x, node_.min_y, node_.min_z};
    float* const moved_high[3] = {node_.max_x, node_.max_y, node_.max_z};
    constexpr auto outward = static_cast<float>(filter::moved_box * filter::u);
    for (std::size_t at = 0; at < bvh_width; at += width) {
      Real center[3], half[3];
      for (int j = 0; j < 3; ++j) {
        const Real least = load(low[j] + at) * Real(0.5F), most = load(high[j] + at) * Real(0.5F);
        const Real farthest = filter_max(abs(least), abs(most)) * Real(2 * outward);
        center[j] = least + most;
        half[j] = most - least + farthest + Real(filter::moved_least);
      }
      for (int i = 0; i < 3; ++i) {
        const Real middle = turn(turned_[i], center, shift_[i]);
        const Real size = turn(stretched_[i], half, __builtin_fabsf(shift_[i]) * outward);
        store(moved_low[i] + at, middle - size);
        store(moved_high[i] + at, middle + size);
      }
    }
    __builtin_memcpy(node_.child, own.child, sizeof own.child);
    __builtin_memcpy(node_.leaf_size, own.leaf_size, sizeof own.leaf_size);
    node_.size = own.size;
  }
  BOULE_INLINE static Real turn(const float (&row)[3], const Real (&v)[3], float shift) {
    return filter_fma(Real(row[2]), v[2],
                      filter_fma(Real(row[1]), v[1], filter_fma(Real(row[0]), v[0], Real(shift))));
  }

  const PartView& part_;
  Placement<Wide> placement_;
  float turned_[3][3], stretched_[3][3];  ///< scale R, and its absolute values
  float shift_[3];
  mutable BvhNode node_;
  mutable SphereBlock block_;
  alignas(64) mutable std::int32_t ids_[bvh_leaf_size];
};

}  // namespace boule::BOULE_KERNEL_ISA
