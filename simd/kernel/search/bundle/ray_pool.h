#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/bundle/bundle_rays.h"
#include "simd/kernel/search/bundle/bundle_source.h"
#include "simd/kernel/search/bundle/light_grid.h"
#include "simd/kernel/tuning.h"

/// Pools of shadow rays, sorted by their place as their light sees it, and the bundles made of
/// them. Chosen for any hit where a stream's neighbours are too incoherent (shadow_stream.h).
namespace boule::BOULE_KERNEL_ISA {

/// Rays of a stream in an order of their own. The data of a ray for bundles are kept together,
/// because neighbours in this order are scattered in memory.
template <Common common>
class RayPool {
 public:
  /// Rays begin .. end - 1 of the stream, at most tuning::pool_size; `begin` is a multiple of W.
  RayPool(const PaddedStream& stream, std::size_t begin, std::size_t end)
      : stream_(stream), begin_(begin), size_(end - begin), shared_(stream.rays(), begin) {
    sort();
  }
  RayPool(const RayPool&) = delete;
  RayPool& operator=(const RayPool&) = delete;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const RayStream& stream() const { return stream_.rays(); }
  [[nodiscard]] const SharedByRays<common>& shared() const { return shared_; }
  /// Whether the shared part of all rays is equal.
  [[nodiscard]] bool all_belong() const { return all_belong_; }
  /// Whether any ray leaves a sphere on its inside.
  [[nodiscard]] bool any_inside() const { return any_inside_; }
  /// The largest Sight::shift.
  [[nodiscard]] float shift() const { return shift_; }
  [[nodiscard]] std::size_t begin() const { return begin_; }
  /// The order: indices of rays, counted from begin() on. The last index is repeated to fill the
  /// packet.
  [[nodiscard]] const std::uint16_t* order() const { return order_; }
  /// The index in the stream of the k-th ray in this order.
  [[nodiscard]] std::size_t index(std::size_t k) const { return begin_ + order_[k]; }
  /// The number of cells between the first and the last of `count` rays from the k-th on: about the
  /// area that they cover as their light sees them.
  [[nodiscard]] unsigned cells(std::size_t k, std::size_t count) const {
    return static_cast<unsigned>(cell_[order_[k + count - 1]]) - cell_[order_[k]];
  }
  /// Four numbers of the ray begin() + i: x, y and z of its sight, and tmax.
  [[nodiscard]] const float* ray(std::size_t i) const { return rays_ + 4 * i; }

 private:
  static constexpr std::size_t chunk = tuning::pool_chunk;

  struct PoolSums {
    RealMask belong = uniform(true);
    bool inside = false;
    Real shift{0.0F};
  };
  BOULE_NOINLINE void sort() {
    const RayStream& rays = stream_.rays();
    const LightMap<common> map(rays, begin_, begin_ + size_);
    const LightGrid grid = fit_grid(map);
    CellSort cells(grid.cells());
    PoolSums sums;
    for (std::size_t at = 0; at < size_; at += chunk) {
      const std::size_t end = size_ - at < chunk ? size_ : at + chunk;
      alignas(64) float x[chunk], y[chunk], z[chunk];
      for (std::size_t i = at; i < end; i += width) {
        const Vec3<Real> sight = enter(i, sums);
        store(x + (i - at), sight.x);
        store(y + (i - at), sight.y);
        store(z + (i - at), sight.z);
      }
      for (std::size_t i = 0; i < end - at; i += width)
        grid.find_cells(map.point_of({load(x + i), load(y + i), load(z + i)}), cell_ + at + i);
      for (std::size_t i = at; i < end; ++i) cells.count(cell_[i]);
    }
    all_belong_ = all(sums.belong);
    any_inside_ = sums.inside;
    shift_ = greatest_lane(sums.shift);
    cells.find_order(cell_, size_, order_);
    for (std::size_t k = size_; k % width != 0; ++k) order_[k] = order_[size_ - 1];
  }

  /// Enters W rays. Returns the x, y and z of their sights.
  BOULE_INLINE Vec3<Real> enter(std::size_t i, PoolSums& sums) {
    const PacketRef packet = stream_.packet(begin_ + i);
    prefetch_packet(stream_.rays(), begin_ + i + chunk);
    const Sight s = shared_.sight(packet);
    sums.belong =
        sums.belong & shared_.template belongs<Sought::any>(packet) & (s.shift <= s.shift);
    sums.inside =
        sums.inside || !all_zero(packet.rays->inside + packet.rays->places(packet.first).start);
    sums.shift = filter_max(sums.shift, s.shift);
    const Real tmax = load(packet.rays->tmax + packet.first);
    store_rows(rays_ + 4 * i, {s.sight.x, s.sight.y, s.sight.z, tmax});
    return s.sight;
  }

  LightGrid fit_grid(const LightMap<common>& map) const {
    constexpr std::size_t step = tuning::pool_chunk;
    ExtentLanes some;
    for (std::size_t at = 0; at < size_; at += step) {
      const auto point = map.point_of(shared_.sight(stream_.packet(begin_ + at)).sight);
      some.add(point.x, point.y);
    }
    return {some.total(), size_};
  }

  const PaddedStream& stream_;
  std::size_t begin_, size_;
  SharedByRays<common> shared_;
  bool all_belong_ = false, any_inside_ = false;
  float shift_ = 0;
  static constexpr std::size_t room = tuning::pool_size + max_width;
  alignas(64) float rays_[4 * room];
  std::uint16_t order_[room];
  std::uint16_t cell_[room];
};

/// Neighbours in a sorted pool whose shared part is equal. A source of a bundle's rays: RaysInOrder
/// (bundle_source.h) documents the members.
template <Common common>
class RaysOfPool {
 public:
  /// `count` rays of the pool, at most bundle_size, from its first-th ray on.
  RaysOfPool(const RayPool<common>& pool, std::size_t first, int count)
      : pool_(pool), first_(first), count_(count), packet_view_(packet_.view(width)) {
    const RayStream& rays = pool.stream();
    const std::uint16_t* const order = pool.order() + first;
    const int padded = (count + width - 1) / width * width;
    for (int at = 0; at < padded; at += width) {
      const float* rows[width];
      for (int lane = 0; lane < width; ++lane) rows[lane] = pool.ray(order[at + lane]);
      const Columns c = load_rows(rows);
      store(x_ + at, c.x);
      store(y_ + at, c.y);
      store(z_ + at, c.z);
      store(tmax_ + at, c.w);
    }
    const auto start = [&](int i) { return rays.places(pool.begin() + order[i]).start; };
    for (int i = 0; i < padded; ++i) source_[i] = rays.source[start(i)];
    if (!pool.any_inside()) return;
    for (int i = 0; i < padded; ++i) inside_[i] = rays.inside[start(i)];
  }
  RaysOfPool(const RaysOfPool&) = delete;
  RaysOfPool& operator=(const RaysOfPool&) = delete;

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const Vec3d& org() const { return pool_.shared().org(); }
  [[nodiscard]] const Vec3d& dir() const { return pool_.shared().dir(); }

  BOULE_INLINE Vec3d one_sight(int i) const {
    return {double{x_[i]}, double{y_[i]}, double{z_[i]}};
  }
  BOULE_INLINE Sight sight(int ray) const {
    return {{load(x_ + ray), load(y_ + ray), load(z_ + ray)}, Real(pool_.shift())};
  }
  template <Sought sought>
  BOULE_INLINE RealMask belongs(int /*ray*/) const {
    return uniform(true);
  }
  BOULE_INLINE PacketStart start(int ray) const {
    static constexpr std::uint8_t none[width] = {};
    return {tmax_ + ray, source_ + ray, pool_.any_inside() ? inside_ + ray : none};
  }
  BOULE_NOINLINE PacketRef packet(int ray, unsigned wanted) const {
    for (unsigned left = wanted; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      packet_.set(static_cast<std::size_t>(lane), pool_.stream(),
                  pool_.index(first_ + static_cast<std::size_t>(ray + lane)));
    }
    return {&packet_view_, 0};
  }
  BOULE_INLINE void answer(int ray, unsigned met, std::uint8_t* answers) const {
    const int end = live(ray);
    for (int lane = 0; lane < end; ++lane)
      answers[pool_.index(first_ + static_cast<std::size_t>(ray + lane))] =
          static_cast<std::uint8_t>((met >> lane) & 1U);
  }
  BOULE_INLINE int live(int ray) const { return count_ - ray < width ? count_ - ray : width; }
  BOULE_INLINE void prefetch_next(int /*ray*/) const {}

 private:
  const RayPool<common>& pool_;
  std::size_t first_;
  int count_;
  alignas(64) float x_[bundle_size], y_[bundle_size], z_[bundle_size], tmax_[bundle_size];
  alignas(64) std::int32_t source_[bundle_size];
  alignas(64) std::uint8_t inside_[bundle_size];
  mutable GatheredRays<width> packet_{};  ///< of packet(); lanes outside `wanted` are stale
  RayStream packet_view_;
};

}  // namespace boule::BOULE_KERNEL_ISA
