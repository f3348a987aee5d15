#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/ray.h"
#include "simd/abi/kernel_table.h"

namespace boule {

/// A chord of a ray: see ChordStream.
struct RayChord {
  double enter, leave;
  std::int32_t id;
  std::uint32_t slot;
};

/// Whether a hit comes before another: it is nearer, or as near with a lower id.
inline bool comes_before(double t, std::int32_t id, const Hit& other) {
  return t < other.t ||
         (t == other.t && static_cast<std::uint32_t>(id) < static_cast<std::uint32_t>(other.id));
}

/// The first hit among the ends of chords, where interval.holds(t).
template <class Interval>
Hit first_hit(std::span<const RayChord> chords, const Interval& interval) {
  Hit nearest;
  for (const RayChord& chord : chords) {
    for (const double t : {chord.enter, chord.leave}) {
      if (interval.holds(t) && comes_before(t, chord.id, nearest))
        nearest = {t, chord.id, chord.slot};
    }
  }
  return nearest;
}

/// The chords of rays, as many rays at a time as there is room for. The memory is kept.
class ChordLists {
 public:
  /// Calls visit(k, chords) with the chords of each ray. Before that it calls amend(first, stop)
  /// with the rays whose chords are in chords() and ends(), which it may change.
  template <class Visit, class Amend>
  void visit(const KernelTable& kernels, const GeometryView& view, const RayStream& rays,
             const Visit& visit, const Amend& amend) {
    for (std::size_t first = 0; first < rays.size;) {
      const std::size_t stop = find(kernels, view, rays, first);
      amend(first, stop);
      std::size_t begin = 0;
      for (; first < stop; ++first) {
        visit(first, std::span<const RayChord>(chords_).subspan(begin, ends_[first] - begin));
        begin = ends_[first];
      }
    }
  }

  /// One ray's after the other's.
  [[nodiscard]] std::vector<RayChord>& chords() { return chords_; }
  /// Where those of each ray end in chords().
  [[nodiscard]] std::vector<std::size_t>& ends() { return ends_; }

 private:
  /// Finds those of rays first .. , as far as there is room. Returns the ray that it stops at.
  std::size_t find(const KernelTable& kernels, const GeometryView& view, const RayStream& rays,
                   std::size_t first);

  std::vector<double> enter_, leave_;
  std::vector<std::int32_t> id_;
  std::vector<std::uint32_t> slot_;
  std::vector<std::size_t> ends_;
  std::vector<RayChord> chords_;
};

}  // namespace boule
