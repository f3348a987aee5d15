#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/packet_stream.h"

/// Rays that have nothing in common: some are in flight at a time, a step of one at a time, so that
/// memory is asked for long before it is needed. A ray that has landed makes room for the next.
namespace boule::BOULE_KERNEL_ISA {

inline constexpr std::size_t flights = 16;
inline constexpr std::size_t parts_of_eight = width < 8 ? 8 / lanes : 1;
inline constexpr unsigned part_lanes = width < 8 ? all_lanes : 0xffU;

/// Nodes and leaves that a ray is still to visit.
class Pending {
 public:
  BOULE_INLINE void clear() { size_ = 0; }
  BOULE_INLINE void push_root() {
    near_[0] = -static_cast<float>(no_hit);
    child_[0] = 0;
    size_ = 1;
    close();
  }
  /// The children of `chosen` lanes.
  BOULE_INLINE void push(const Real& near, const Real& child, unsigned chosen) {
    store_chosen(near_ + size_, near, chosen);
    store_chosen(child_ + size_, child, chosen);
    size_ += static_cast<unsigned>(std::popcount(chosen));
  }
  /// To be called after pushes.
  BOULE_INLINE void close() { store_anywhere(near_ + size_, static_cast<float>(no_hit)); }
  /// Takes the nearest one; false if there is none before `reach`.
  BOULE_INLINE bool pop(float reach, std::uint32_t& child) {
    const float slack = static_cast<float>(filter::box * filter::u);
    while (size_ > 0) {
      const unsigned place = size_ > most_sorted ? size_ - 1 : nearest();
      const float near = near_[place];
      child = std::bit_cast<std::uint32_t>(child_[place]);
      --size_;
      near_[place] = near_[size_];
      child_[place] = child_[size_];
      near_[size_] = static_cast<float>(no_hit);
      if (!(reach < near - (near < 0 ? -near : near) * slack)) return true;
      if (size_ < most_sorted) return false;
    }
    return false;
  }

 private:
  BOULE_INLINE unsigned nearest() const {
    Real least = load(near_);
    for (unsigned first = lanes; first < size_; first += lanes)
      least = filter_min(least, load(near_ + first));
    const Real nearest(least_lane(least));
    for (unsigned first = 0;; first += lanes) {
      const unsigned equal = bits(load(near_ + first) <= nearest);
      if (equal != 0) return first + static_cast<unsigned>(std::countr_zero(equal));
    }
  }

  /// Of more the last one comes first: a way down the tree adds so many at most.
  static constexpr unsigned most_sorted = 48;
  static constexpr unsigned capacity =
      most_sorted + 1 + bvh_max_depth * (bvh_width - 1) + 2 * width + 8;
  alignas(64) float near_[(capacity + 15) / 16 * 16];
  alignas(64) float child_[(capacity + 15) / 16 * 16];
  unsigned size_ = 0;
};

/// Between the planes of an axis: t of a plane x is x / d - (o + m) / d of the one met first, x / d
/// - (o - m) / d of the other.
struct Slab {
  Real inverse, near, far;

  BOULE_INLINE Slab(const Real& org, const Real& unit, const Real& extent) {
    const Real least(0x1p-40F), size = abs(unit);
    const RealMask tiny = size < least;
    const Real clamped = select(tiny, least, size);
    const Real aside =
        select(tiny, extent * Real(0x1p-38F), Real(static_cast<float>(filter::floor)));
    const Real margin = filter_fma(abs(org), Real(static_cast<float>(8 * filter::u)), aside);
    const Real positive = Real(1.0F) / clamped, zero(0.0F);
    const RealMask down = unit < zero;
    inverse = select(down, zero - positive, positive);
    const Real ahead = org * inverse, slack = margin * positive;
    near = zero - ahead - slack;
    far = slack - ahead;
  }
};

/// A ray's constants.
struct FlightRay {
  float inverse[3], near[3], far[3];
  std::uint32_t near_row[3];  ///< in the node
  float org[3], h[3], unit[3];
  float origin_error, live_from, live_to, dead_below;
  float reach;
  std::int32_t source;
  bool inside;

  BOULE_INLINE static Vec3<Real> all(const float* v) { return {v[0], v[1], v[2]}; }
  BOULE_INLINE FilterRays filter_rays() const {
    FilterRays rays;
    rays.org = all(org);
    rays.h = all(h);
    rays.unit = all(unit);
    rays.origin_error = origin_error;
    rays.origins_exact = false;
    rays.live_from = live_from;
    rays.live_to = live_to;
    rays.dead_below = dead_below;
    return rays;
  }
};

/// W rays that wait for their start.
struct Takeoffs {
  static constexpr int values = 23;
  alignas(64) float value[values][width];
  std::size_t first = 0, next = 0, size = 0;

  BOULE_INLINE void set(const RayLanes& rays, const Real& reach, float extent) {
    const FilterRays& f = rays.filter;
    const Real farthest = abs(f.org.x) + abs(f.org.y) + abs(f.org.z) + Real(extent);
    const Slab x(f.org.x, f.unit.x, farthest), y(f.org.y, f.unit.y, farthest),
        z(f.org.z, f.unit.z, farthest);
    const Real all[values] = {
        x.inverse, y.inverse, z.inverse,      x.near,      y.near,    z.near,       x.far, y.far,
        z.far,     f.org.x,   f.org.y,        f.org.z,     f.h.x,     f.h.y,        f.h.z, f.unit.x,
        f.unit.y,  f.unit.z,  f.origin_error, f.live_from, f.live_to, f.dead_below, reach};
    for (int k = 0; k < values; ++k) store(value[k], all[k]);
  }
  BOULE_INLINE void get(std::size_t lane, FlightRay& ray) const {
    for (int k = 0; k < 3; ++k) ray.inverse[k] = value[k][lane];
    for (int k = 0; k < 3; ++k) ray.near[k] = value[3 + k][lane];
    for (int k = 0; k < 3; ++k) ray.far[k] = value[6 + k][lane];
    for (int k = 0; k < 3; ++k) {
      ray.near_row[k] = static_cast<unsigned>(k) + (ray.inverse[k] < 0 ? 3U : 0U);
    }
    for (int k = 0; k < 3; ++k) ray.org[k] = value[9 + k][lane];
    for (int k = 0; k < 3; ++k) ray.h[k] = value[12 + k][lane];
    for (int k = 0; k < 3; ++k) ray.unit[k] = value[15 + k][lane];
    ray.origin_error = value[18][lane];
    ray.live_from = value[19][lane];
    ray.live_to = value[20][lane];
    ray.dead_below = value[21][lane];
    ray.reach = value[22][lane];
  }
};

/// Spheres that a ray may have met first: only a double solve tells.
struct FlightCandidates {
  static constexpr unsigned capacity = 32;
  float low[capacity];
  std::uint32_t slot[capacity];
  unsigned size = 0;

  BOULE_INLINE void add(float lower, std::uint32_t which) {
    low[size] = lower;
    slot[size++] = which;
  }
  BOULE_INLINE void drop_beyond(float reach) {
    unsigned kept = 0;
    for (unsigned k = 0; k < size; ++k) {
      low[kept] = low[k];
      slot[kept] = slot[k];
      kept += reach < low[k] ? 0 : 1;
    }
    size = kept;
  }
};

struct Flight {
  FlightRay ray;
  std::uint32_t index;
  std::uint32_t child;
  FlightCandidates candidates;
  Pending pending;
};

/// Ray-sphere pairs that wait for their double solve, W at a time.
template <class Answers>
class SolveQueue {
 public:
  SolveQueue(const RayStream& rays, const SphereView& spheres, const Answers& answers)
      : rays_(rays), spheres_(spheres), answers_(answers) {}

  BOULE_INLINE void add(std::uint32_t ray, std::uint32_t slot) {
    ray_[size_] = ray;
    slot_[size_++] = slot;
    if (size_ == lanes) flush();
  }
  BOULE_NOINLINE void flush() {
    if (size_ == 0) return;
    alignas(64) double places[lanes];
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::size_t from = k < size_ ? k : 0;
      gathered_.set(k, rays_, ray_[from]);
      places[k] = static_cast<double>(slot_[from]);
    }
    const ExactRays exact = load_exact(gathered_.view(lanes), 0);
    const SphereLanes spheres = gather_spheres(spheres_, load(places));
    const Roots roots = solve_robust(exact, spheres);
    alignas(64) double t[lanes], id[lanes];
    store(t, roots.t);
    store(id, spheres.id);
    const unsigned hit = bits(roots.hit);
    for (std::size_t k = 0; k < size_; ++k) {
      if ((hit >> k & 1U) != 0) answer(answers_, ray_[k], t[k], static_cast<std::int32_t>(id[k]));
    }
    size_ = 0;
  }

 private:
  BOULE_INLINE static void answer(const HitStream& hits, std::size_t ray, double t,
                                  std::int32_t id) {
    const bool nearer = t < hits.t[ray] || (t == hits.t[ray] && id < hits.id[ray]);
    if (!nearer) return;
    hits.t[ray] = t;
    hits.id[ray] = id;
  }
  BOULE_INLINE static void answer(std::uint8_t* occluded, std::size_t ray, double, std::int32_t) {
    occluded[ray] = 1;
  }

  const RayStream& rays_;
  const SphereView& spheres_;
  const Answers& answers_;
  GatheredRays<lanes> gathered_;
  std::uint32_t ray_[lanes], slot_[lanes];
  std::size_t size_ = 0;
};

/// All rays of a stream, for nearest hits (Answers: HitStream) or any (std::uint8_t*).
template <class Answers>
class Airport {
 public:
  static constexpr bool any = !std::is_same_v<Answers, HitStream>;

  Airport(const GeometryView& geometry, const PaddedStream& stream, const Answers& answers)
      : geometry_(geometry),
        stream_(stream),
        answers_(answers),
        queue_(stream.rays(), geometry_.spheres, answers_) {
    const BvhNode& root = geometry.bvh.nodes[0];
    for (int k = 0; k < root.size; ++k) {
      const auto grow = [&](float x) { extent_ = extent_ < x ? x : extent_; };
      grow(-root.min_x[k]);
      grow(-root.min_y[k]);
      grow(-root.min_z[k]);
      grow(root.max_x[k]);
      grow(root.max_y[k]);
      grow(root.max_z[k]);
    }
  }

  void run() {
    for (std::size_t k = 0; k < flights; ++k) {
      if (take_off(flight_[k])) nodes_[node_count_++] = static_cast<std::uint8_t>(k);
    }
    while (node_count_ + leaf_count_ > 0) {
      const std::size_t nodes = node_count_, leaves = leaf_count_;
      std::uint8_t at_node[flights], at_leaf[flights];
      for (std::size_t k = 0; k < nodes; ++k) at_node[k] = nodes_[k];
      for (std::size_t k = 0; k < leaves; ++k) at_leaf[k] = leaves_[k];
      node_count_ = leaf_count_ = 0;
      for (std::size_t k = 0; k < nodes; ++k) visit_node(flight_[at_node[k]]);
      for (std::size_t k = 0; k < leaves; ++k) visit_leaf(flight_[at_leaf[k]]);
      for (std::size_t k = 0; k < nodes; ++k) go_on(flight_[at_node[k]], at_node[k]);
      for (std::size_t k = 0; k < leaves; ++k) go_on(flight_[at_leaf[k]], at_leaf[k]);
    }
    queue_.flush();
  }

 private:
  /// W rays more: what is in no tree is met at once, all of them together.
  BOULE_NOINLINE bool prepare() {
    const std::size_t size = stream_.rays().size;
    takeoffs_.first += takeoffs_.size;
    takeoffs_.next = 0;
    if (takeoffs_.first >= size) {
      takeoffs_.size = 0;
      takeoffs_.first = size;
      return false;
    }
    takeoffs_.size = stream_.live(takeoffs_.first);
    const PacketPlace place = stream_.packet(takeoffs_.first);
    const RayLanes rays = load_packet(*place.rays, place.first);
    if constexpr (any) {
      AnyHit<false> best(rays);
      meet_scanned(rays, best);
      for (std::size_t lane = 0; lane < takeoffs_.size; ++lane)
        answers_[takeoffs_.first + lane] = static_cast<std::uint8_t>(best.hit >> lane & 1U);
      takeoffs_.set(rays, best.far, extent_);
    } else {
      ClosestHit best(rays);
      meet_scanned(rays, best);
      store_packet(best, answers_, takeoffs_.first, takeoffs_.size);
      takeoffs_.set(rays, best.reach, extent_);
    }
    return true;
  }
  template <class Best>
  BOULE_INLINE void meet_scanned(const RayLanes& rays, Best& best) {
    if (rays.filter.origins_exact) {
      scan_spheres<Solver::robust, OneForAll, true>(rays, geometry_.spheres, best);
    } else {
      scan_spheres<Solver::robust, OneForAll, false>(rays, geometry_.spheres, best);
    }
    best.settle(geometry_.spheres, rays);
    scan_planes<Solver::robust, OneForAll>(rays, geometry_.planes, best);
  }

  /// The next ray that has somewhere to go; false if there is none.
  BOULE_INLINE bool take_off(Flight& flight) {
    for (;;) {
      if (takeoffs_.next == takeoffs_.size && !prepare()) return false;
      const std::size_t lane = takeoffs_.next++;
      FlightRay& ray = flight.ray;
      takeoffs_.get(lane, ray);
      flight.index = static_cast<std::uint32_t>(takeoffs_.first + lane);
      if (!(ray.unit[0] <= ray.unit[0]) || ray.dead_below < 0) {
        go_alone(flight.index);
        continue;
      }
      if (!(ray.dead_below <= ray.reach)) continue;
      ray.source = stream_.rays().source[flight.index];
      ray.inside = stream_.rays().inside[flight.index] != 0;
      flight.child = 0;
      flight.pending.clear();
      flight.candidates.size = 0;
      return true;
    }
  }

  /// A ray that floats cannot judge.
  BOULE_NOINLINE void go_alone(std::size_t index) {
    const RayLanes ray = load_single(stream_.rays(), index);
    if constexpr (any) {
      AnyHit<true> best(ray);
      search<Solver::robust, OnePerLane>(ray, geometry_, best);
      answers_[index] = best.hit != 0 ? 1 : 0;
    } else {
      ClosestHit best(ray);
      search<Solver::robust, OnePerLane>(ray, geometry_, best);
      store_single(best, answers_, index);
    }
  }

  BOULE_INLINE void visit_node(Flight& flight) {
    const BvhNode& node = geometry_.bvh.nodes[flight.child];
    const FlightRay& ray = flight.ray;
    const float* const rows = node.min_x;
    const Real more(static_cast<float>(1 + 2 * filter::box * filter::u));
    const std::uint32_t x = ray.near_row[0], y = ray.near_row[1], z = ray.near_row[2];
    for (std::size_t part = 0; part < parts_of_eight; ++part) {
      const auto get = [&](std::uint32_t row) { return load_of_eight(rows + row * 8, part); };
      const auto cut = [&](std::uint32_t row, int axis, const float* moved) {
        return filter_fma(get(row), Real(ray.inverse[axis]), Real(moved[axis]));
      };
      const Real near = filter_max(filter_max(cut(x, 0, ray.near), cut(y, 1, ray.near)),
                                   filter_max(cut(z, 2, ray.near), Real(0.0F)));
      const Real far = filter_min(filter_min(cut(3 - x, 0, ray.far), cut(5 - y, 1, ray.far)),
                                  filter_min(cut(7 - z, 2, ray.far), Real(ray.reach)));
      const unsigned in = bits(near <= far * more) & part_lanes;
      flight.pending.push(near, load_bits_of_eight(node.child, part), in);
    }
    flight.pending.close();
  }

  BOULE_INLINE void visit_leaf(Flight& flight) {
    const SphereView& spheres = geometry_.spheres;
    const std::size_t number = place_of(flight.child);
    const std::size_t block = spheres.scanned / bvh_leaf_size + number;
    const SphereBlock& leaf = spheres.blocks[block];
    const FilterRays rays = flight.ray.filter_rays();
    for (std::size_t part = 0; part < parts_of_eight; ++part) {
      const auto get = [&](const float* row) { return load_of_eight(row, part); };
      const Vec3<Real> center{get(leaf.center_x), get(leaf.center_y), get(leaf.center_z)};
      const Real r = get(leaf.radius);
      const Real outward(static_cast<float>(1 + filter::slack_on_the_spot * filter::u));
      const Real grown = abs(r) * outward + Real(static_cast<float>(2 * filter::floor));
      const RealMask misses = rejected<false>(rays, center, grown, grown);
      unsigned in = bits(~misses & (r <= r)) & part_lanes;
      if (in == 0) continue;
      const std::uint32_t first = static_cast<std::uint32_t>(block * bvh_leaf_size + part * lanes);
      if (flight.ray.source >= 0) in = without_source(flight, first, in);
      if (in != 0) meet(flight, rays, center, r, first, in);
    }
  }
  /// The sphere that a ray leaves is met again only from the inside, and only double tells where.
  BOULE_INLINE unsigned without_source(Flight& flight, std::uint32_t first, unsigned in) {
    for (unsigned rest = in; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(rest));
      if (geometry_.spheres.id[first + lane] != flight.ray.source) continue;
      if (flight.ray.inside) add_candidate(flight, -static_cast<float>(no_hit), first + lane);
      return in & ~(1U << lane);
    }
    return in;
  }

  BOULE_INLINE void meet(Flight& flight, const FilterRays& rays, const Vec3<Real>& center,
                         const Real& r, std::uint32_t first, unsigned in) {
    const RootBounds roots = bound_roots(rays, center, r);
    const Real low = lowest(roots, rays);
    in &= ~bits(dead(roots, rays) | (Real(flight.ray.reach) < low));
    if (in == 0) return;
    if constexpr (any) {
      if ((bits(live(roots, rays)) & in) != 0) {
        answers_[flight.index] = 1;
        flight.pending.clear();
        flight.candidates.size = 0;
        flight.ray.reach = -static_cast<float>(no_hit);
        return;
      }
    } else {
      alignas(64) float high[width];
      store(high, highest(roots, rays));
      for (unsigned rest = in; rest != 0; rest &= rest - 1) {
        const float h = high[std::countr_zero(rest)];
        if (h < flight.ray.reach) flight.ray.reach = h;
      }
    }
    alignas(64) float lows[width];
    store(lows, low);
    for (; in != 0; in &= in - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(in));
      if (flight.ray.reach < lows[lane]) continue;
      add_candidate(flight, lows[lane], first + lane);
    }
  }

  BOULE_INLINE void add_candidate(Flight& flight, float low, std::uint32_t slot) {
    if (flight.candidates.size == FlightCandidates::capacity) make_room(flight);
    flight.candidates.add(low, slot);
  }
  BOULE_NOINLINE void make_room(Flight& flight) {
    flight.candidates.drop_beyond(flight.ray.reach);
    if (flight.candidates.size == FlightCandidates::capacity) land(flight);
  }

  BOULE_INLINE void land(Flight& flight) {
    FlightCandidates& candidates = flight.candidates;
    for (unsigned k = 0; k < candidates.size; ++k) {
      if (!(flight.ray.reach < candidates.low[k])) queue_.add(flight.index, candidates.slot[k]);
    }
    candidates.size = 0;
  }

  BOULE_INLINE void go_on(Flight& flight, std::uint8_t k) {
    std::uint32_t child = 0;
    if (!flight.pending.pop(flight.ray.reach, child)) {
      land(flight);
      if (!take_off(flight)) return;
    } else {
      flight.child = child;
    }
    const bool leaf = (flight.child & leaf_bit) != 0;
    prefetch(flight.child, leaf);
    nodes_[node_count_] = k;
    leaves_[leaf_count_] = k;
    node_count_ += leaf ? 0 : 1;
    leaf_count_ += leaf ? 1 : 0;
  }

  BOULE_INLINE void prefetch(std::uint32_t child, bool leaf) const {
    const char* const begin =
        leaf ? reinterpret_cast<const char*>(geometry_.spheres.blocks +
                                             geometry_.spheres.scanned / bvh_leaf_size +
                                             place_of(child))
             : reinterpret_cast<const char*>(geometry_.bvh.nodes + child);
    __builtin_prefetch(begin);
    __builtin_prefetch(begin + 64);
    if (leaf) return;
    __builtin_prefetch(begin + 128);
    __builtin_prefetch(begin + 192);
  }

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  Answers answers_;
  float extent_ = 0;
  SolveQueue<Answers> queue_;
  Takeoffs takeoffs_;
  Flight flight_[flights];
  std::uint8_t nodes_[flights + 1], leaves_[flights + 1];
  std::size_t node_count_ = 0, leaf_count_ = 0;
};

template <class Answers>
BOULE_NOINLINE void fly(const GeometryView& geometry, const PaddedStream& stream,
                        const Answers& answers) {
  Airport<Answers>(geometry, stream, answers).run();
}

}  // namespace boule::BOULE_KERNEL_ISA
