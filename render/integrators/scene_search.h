#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/integrators/chord_lists.h"
#include "render/prepare/prepared_scene.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Finds the hits of rays in a scene, whose spheres and capsules may be cut by clip planes. Without
/// clip planes it calls the kernels and nothing else.
///
/// A clip plane leaves of a sphere or capsule what is behind it. As both are convex, a ray is in
/// what is left where it is in the whole one and behind all clip planes: between the greater t of
/// entering and the lesser t of leaving, each in double. A hit is the first of the two ends within
/// the ray's interval. Where a plane makes that end it is a hit of a cap, whose surface is the
/// plane's; of several caps, that of the primitive whose centre, or whose segment, is nearest as a
/// share of its radius, at equal shares that of the lower id. A primitive that is entered at just
/// that t has one, too. Planes of the scene are left whole.
class SceneSearch {
 public:
  /// `scene` and `kernels` must outlive it.
  SceneSearch(const PreparedScene& scene, const KernelTable& kernels);

  /// KernelTable::closest_hit() of the scene that is cut. A cap has the id and the slot of its
  /// primitive.
  void closest_hit(const RayStream& rays, const Query& query, const HitStream& hits);
  /// KernelTable::any_hit() likewise.
  void any_hit(const RayStream& rays, const Query& query, std::uint8_t* occluded);

  /// The last closest hits as the surfaces that were met: caps have the id of their clip plane, one
  /// of PreparedScene::planes. They are written to `room` where anything is cut.
  HitStream surfaces(const HitStream& hits, HitBuffer& room) const;

 private:
  /// The part of a ray that is behind all clip planes, and the planes at its ends; no_primitive: it
  /// is the ray's own end.
  struct Kept {
    double from, to;
    std::int32_t enters = no_primitive, leaves = no_primitive;

    [[nodiscard]] bool is_empty() const { return !(from < to); }
    [[nodiscard]] bool holds(double t) const { return from < t && t <= to; }
  };

  [[nodiscard]] Kept kept_part(const Ray& ray) const;
  void cut(const RayStream& rays);
  void want_chords_at(const RayStream& rays, double Kept::*end);
  void find_entered_caps(const RayStream& rays);
  void find_left_caps(const RayStream& rays, const HitStream& hits);
  void find_again(const RayStream& rays, const HitStream& hits);
  void meet_planes(const RayStream& rays, const HitStream& hits);
  [[nodiscard]] Hit nearest_cap(const Ray& ray, std::span<const RayChord> chords, double t) const;
  [[nodiscard]] double share_of_radius(const RayChord& chord, const Vec3d& point) const;
  template <class Visit>
  void visit_chords(const Visit& visit);

  const PreparedScene& scene_;
  const KernelTable& kernels_;
  GeometryView geometry_;          ///< with planes only where nothing is cut
  std::span<const Plane> planes_;  ///< those of the scene, and those that cut it
  std::span<const Plane> clips_;
  std::int32_t first_plane_, first_clip_;  ///< ids

  // Of a stream, by ray:
  std::vector<Kept> kept_;
  std::vector<Hit> caps_;
  std::vector<std::int32_t> cap_planes_;  ///< of the hits that are caps
  RayBuffer cut_rays_;
  HitBuffer blocking_;

  // Of rays whose chords are wanted:
  std::vector<std::size_t> wanted_;
  RayBuffer chord_rays_;
  ChordLists lists_;
};

}  // namespace boule
