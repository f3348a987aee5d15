#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/math/ray.h"
#include "core/reference.h"
#include "render/frame/traced_hit.h"
#include "render/integrators/chord_lists.h"
#include "simd/abi/kernel_table.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"
#include "simd/stream/surface_buffer.h"

namespace boule {

/// What the rays of a Tracer are traced against, and how.
struct TraceTarget {
  const KernelTable& kernels;
  const Geometry& geometry;
  const GeometryView& view;  ///< of the geometry
  Solver solver;
};

/// The ends of a ray as they were given.
struct RayInterval {
  double tmin, tmax;

  [[nodiscard]] double end() const {
    constexpr double largest{std::numeric_limits<float>::max()};
    return tmax > largest ? largest : tmax;
  }
  /// Whether a hit at t counts.
  [[nodiscard]] bool holds(double t) const { return tmin < t && t <= end(); }
};

/// One thread's rays, and the answers to them. A stream has the ends of rays as floats, rounded
/// outward; the answers here are compared with the ends as they were given, in double. The memory
/// is kept from block to block.
class TraceWorker {
 public:
  /// Takes `count` rays, ray(k) for each k.
  template <class GetRay>
  void load(std::size_t count, const GetRay& ray) {
    start(count);
    for (std::size_t k = 0; k < count; ++k) set(k, ray(k));
  }
  [[nodiscard]] std::size_t size() const { return rays_.size(); }
  [[nodiscard]] const RayInterval& interval(std::size_t k) const { return ends_[k]; }
  [[nodiscard]] Ray ray(std::size_t k) const { return rays_.get(k); }

  /// Finds the nearest hit of each ray. Sets hits[k] by set(k, hit).
  template <class Set>
  void find_closest(const TraceTarget& target, const Set& set) {
    meet_closest(target);
    for (std::size_t first = 0; first < size(); first += surface_block) {
      const std::size_t count = find_surfaces(target, first);
      for (std::size_t k = 0; k < count; ++k) set(first + k, traced(target, first + k, k));
    }
  }

  /// The same for one ray: the nearest hit, and whether there is any.
  TracedHit find_closest(const TraceTarget& target, const Ray& ray);
  bool find_any(const TraceTarget& target, const Ray& ray);

  /// 1 for each ray that meets something, otherwise 0; valid until the next call.
  const std::uint8_t* find_any(const TraceTarget& target);

  /// Calls visit(k, chords) with the chords of each ray, in any order; a ray may have chords that
  /// end within a unit of float beyond its interval.
  template <class Visit>
  void find_chords(const TraceTarget& target, const Visit& visit) {
    visit_chords(target, rays_, visit);
  }

 private:
  /// Number of rays whose surfaces are found at a time: few enough for them to stay in the nearest
  /// caches.
  static constexpr std::size_t surface_block = 256;

  void start(std::size_t count);
  void set(std::size_t k, const Ray& ray);
  void meet_closest(const TraceTarget& target);
  void settle_ends(const TraceTarget& target);
  std::size_t find_surfaces(const TraceTarget& target, std::size_t first);
  TracedHit traced(const TraceTarget& target, std::size_t k, std::size_t surface);
  void add_copies(const Geometry& geometry, const RayBuffer& rays, std::size_t first,
                  std::size_t stop);

  template <class Visit>
  void visit_chords(const TraceTarget& target, RayBuffer& rays, const Visit& visit) {
    lists_.visit(target.kernels, target.view, rays.view(), visit,
                 [&](std::size_t first, std::size_t stop) {
                   if (target.geometry.lacks_copies())
                     add_copies(target.geometry, rays, first, stop);
                 });
  }

  RayBuffer rays_;
  std::vector<RayInterval> ends_;
  std::vector<std::size_t> rounded_;  ///< the rays whose ends are no floats
  HitBuffer hits_;
  SurfaceBuffer surfaces_{surface_block};
  AlignedArray<std::uint8_t> met_;
  Experience closest_, any_;  ///< of all calls: they probably have rays of one kind

  // Of rays that need a second look.
  std::vector<std::size_t> again_;
  RayBuffer again_rays_;
  AlignedArray<std::uint8_t> again_met_;

  ChordLists lists_;
};

}  // namespace boule
