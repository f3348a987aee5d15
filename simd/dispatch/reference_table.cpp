#include <algorithm>
#include <limits>
#include <vector>

#include "core/reference.h"
#include "core/scene/group.h"
#include "simd/dispatch/dispatch.h"

namespace boule {
namespace {

Plane get_plane(const PlaneView& p, std::size_t i) {
  return {
      {p.point_x[i], p.point_y[i], p.point_z[i]}, {p.normal_x[i], p.normal_y[i], p.normal_z[i]}, 0};
}

Capsule get_capsule(const CapsuleView& view, std::size_t slot) {
  const CapsuleBlock& block = view.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  return {{block.a_x[k], block.a_y[k], block.a_z[k]},
          {block.b_x[k], block.b_y[k], block.b_z[k]},
          block.radius[k],
          0};
}

/// The sphere in a slot of a part, as placed in the scene.
Sphere get_sphere(const PartView& part, std::size_t slot) {
  const SphereBlock& block = part.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  const Vec3f center{block.center_x[k], block.center_y[k], block.center_z[k]};
  const Sphere own{center, block.radius[k], 0};
  const PlacementView& p = part.placement;
  if (!p.moves) return own;
  return transformed(own, {p.row_x, p.row_y, p.row_z, p.scale, p.shift}, std::nullopt);
}

/// The geometry as plain primitives in the order of their ids, for the reference path. Copies of a
/// sphere that the builder of the tree left out get the radius NaN, so rays miss them.
struct Primitives {
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> slots;  ///< by the sphere's id
  std::vector<Plane> planes;
  std::vector<Capsule> capsules;
  std::vector<std::uint32_t> capsule_slots;  ///< by the capsule's id, less the first one's

  explicit Primitives(const GeometryView& view) {
    const SphereView& s = view.spheres;
    const Sphere nowhere{{0, 0, 0}, std::numeric_limits<float>::quiet_NaN(), 0};
    spheres.resize(static_cast<std::uint32_t>(view.planes.first_id), nowhere);
    slots.resize(spheres.size());
    PartView whole{};
    whole.blocks = s.blocks;
    whole.id = s.id;
    whole.slots = static_cast<std::uint32_t>(s.block_count * bvh_leaf_size);
    if (view.parts.size == 0) add(whole);
    for (std::size_t part = 0; part < view.parts.size; ++part) add(view.parts.parts[part]);
    const PlaneView& p = view.planes;
    for (std::size_t i = 0; i < p.size; ++i) planes.push_back(get_plane(p, i));
    const Plane unseen{{}, {}, 0};  // of a view that leaves planes out, whose ids still count
    if (view.capsules.slots > 0)
      planes.resize(static_cast<std::size_t>(view.capsules.first_id - p.first_id), unseen);
    add(view.capsules);
  }

  void add(const CapsuleView& view) {
    for (std::uint32_t slot = 0; slot < view.slots; ++slot) {
      if (view.id[slot] < 0) continue;
      const auto place = static_cast<std::size_t>(view.id[slot] - view.first_id);
      capsules.resize(std::max(capsules.size(), place + 1));
      capsule_slots.resize(capsules.size());
      capsules[place] = get_capsule(view, slot);
      capsule_slots[place] = slot;
    }
  }

  /// The slot of a primitive; undefined for a plane.
  [[nodiscard]] std::uint32_t slot_of(std::int32_t id) const {
    const std::size_t place = static_cast<std::uint32_t>(id);
    if (place < slots.size()) return slots[place];
    const std::size_t others = spheres.size() + planes.size();
    return place - others < capsules.size() ? capsule_slots[place - others] : 0;
  }

  void add(const PartView& part) {
    for (std::uint32_t slot = 0; slot < part.slots; ++slot) {
      if (part.id[slot] < 0) continue;
      const std::size_t id =
          static_cast<std::uint32_t>(part.first_id) + static_cast<std::size_t>(part.id[slot]);
      spheres[id] = get_sphere(part, slot);
      slots[id] = part.first_slot + slot;
    }
  }
};

void closest_hit(const GeometryView& geometry, const RayStream& rays, const Query&,
                 const HitStream& hits) {
  const Primitives all(geometry);
  for (std::size_t i = 0; i < rays.size; ++i) {
    const Hit hit = reference::closest_hit(get_ray(rays, i), all.spheres, all.planes, all.capsules);
    hits.t[i] = hit.t;
    hits.id[i] = hit.id;
    if (hit.id != no_primitive) hits.slot[i] = all.slot_of(hit.id);
  }
}

void any_hit(const GeometryView& geometry, const RayStream& rays, const Query&,
             std::uint8_t* occluded) {
  const Primitives all(geometry);
  for (std::size_t i = 0; i < rays.size; ++i) {
    const Ray ray = get_ray(rays, i);
    occluded[i] = reference::any_hit(ray, all.spheres, all.planes, all.capsules) ? 1 : 0;
  }
}

std::size_t find_chords(const GeometryView& geometry, const RayStream& rays, std::size_t first,
                        const ChordStream& chords, std::size_t* ends) {
  const Primitives all(geometry);
  std::size_t count = 0;
  for (std::size_t i = first; i < rays.size; ++i) {
    const Ray ray = get_ray(rays, i);
    std::int32_t id = 0;
    const auto add = [&](const auto& primitive) {
      const reference::Chord chord = reference::find_chord(ray, primitive, id == ray.source);
      if (overlaps(chord, ray, primitive)) {
        if (count < chords.capacity) {
          chords.enter[count] = chord.enter;
          chords.leave[count] = chord.leave;
          chords.id[count] = id;
          chords.slot[count] = all.slot_of(id);
        }
        ++count;
      }
      ++id;
    };
    for (const Sphere& sphere : all.spheres) add(sphere);
    for (const Plane& plane : all.planes) add(plane);
    for (const Capsule& capsule : all.capsules) add(capsule);
    if (count > chords.capacity) return i;
    ends[i] = count;
  }
  return rays.size;
}

}  // namespace

const KernelTable& reference_kernels() {
  static const KernelTable table = [] {
    KernelTable made = *select_kernels("scalar").value();
    made.closest_hit = closest_hit;
    made.any_hit = any_hit;
    made.closest_of_ray = [](const GeometryView&, const Ray&, Hit&) { return false; };
    made.any_of_ray = [](const GeometryView&, const Ray&, bool&) { return false; };
    made.find_chords = find_chords;
    return made;
  }();
  return table;
}

}  // namespace boule
