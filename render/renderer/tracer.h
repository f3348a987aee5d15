#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/ray.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"
#include "render/frame/point_lists.h"
#include "render/frame/progress.h"
#include "render/frame/ray_lists.h"
#include "render/frame/scheduler.h"
#include "render/frame/traced_hit.h"
#include "render/renderer/point_columns.h"
#include "render/renderer/ray_columns.h"
#include "render/renderer/run_statistics.h"
#include "simd/abi/kernel_table.h"
#include "simd/geometry/geometry.h"

namespace boule {

/// The options of tracing. The hits depend only on `solver`, and only if that is fast.
struct TraceOptions {
  Solver solver = Solver::robust;
  unsigned threads = 0;      ///< at most 1024; 0: as many as the hardware runs at once
  std::string isa = "auto";  ///< a name that select_kernels() knows
  const std::atomic<bool>* cancel = nullptr;        ///< true stops tracing; must outlive the tracer
  std::function<void(const Progress&)> progress{};  ///< called often, on the thread that traces
};

/// The cost of tracing, over all calls so far.
struct TraceStatistics : RunStatistics {
  std::uint64_t rays = 0;
  std::uint64_t points = 0;  ///< of nearest(), within() and the like
  double trace_seconds = 0;
};

struct TraceTarget;
class TraceWorker;

/// Traces a caller's own rays against the objects of a scene. The scene needs the materials that
/// its objects name, scene.materials = {{"", Matte{}}}, but neither camera nor lights. The bits of
/// a hit are the same for any ISA, threads and other rays. Takes any rays. Every failure is a
/// Diagnostic, an exception of options.progress included. After a tracer was moved from, closest()
/// and any() return an error.
class Tracer {
 public:
  /// Prepares the objects of the scene, which may be destroyed afterwards. Takes any values. An
  /// error if the scene is invalid (validate()), if this computer lacks the ISA, or if there is too
  /// little memory.
  static Result<Tracer> create(const Scene& scene, const TraceOptions& options = {});
  /// The same without a copy of the primitives.
  static Result<Tracer> create(Scene&& scene, const TraceOptions& options = {});
  Tracer(Tracer&& other) noexcept;
  Tracer& operator=(Tracer&& other) noexcept;
  ~Tracer();

  /// Sets hits[k] to the nearest hit of rays[k] with tmin < t <= tmax; at equal t, the one with the
  /// lowest id. t is compared with the ends of the interval in double. The normal is that of the
  /// AOV `normal`. An error if the numbers of rays and hits differ, if there is too little memory,
  /// or after a cancellation; then some hits may be unset.
  Status closest(std::span<const Ray> rays, std::span<TracedHit> hits);
  /// The same for one ray, on the caller's thread: for rays that depend on one another. Does
  /// neither ask `cancel` nor report progress, and its time does not count in statistics().
  Result<TracedHit> closest(const Ray& ray);

  /// Sets met[k] to 1 if rays[k] hits a primitive with tmin < t <= tmax, otherwise to 0. It agrees
  /// with closest() and takes less time. Errors are as for closest().
  Status any(std::span<const Ray> rays, std::span<std::uint8_t> met);
  /// The same for one ray, as closest() for one.
  Result<bool> any(const Ray& ray);

  /// The same for rays and hits in columns, which are read and written in place. The numbers of
  /// rays must stay unchanged in the meantime. An error, with the key "source" and the row, if a
  /// source is neither no_primitive nor an id of the scene.
  Status closest_of_columns(const RayColumns& rays, const HitColumns& hits);
  Status any_of_columns(const RayColumns& rays, std::span<std::uint8_t> met);

  /// All crossings of each ray with tmin < t <= tmax, or the first `limit` of them: two of a
  /// sphere or capsule, one where a line touches it, one of a plane. Decisions are exact, whatever
  /// the solver. Of more than sixteen exact copies of a sphere in a packed scene, two count. Errors
  /// are as for closest_of_columns(); too little memory for the results is one with the memory that
  /// they need.
  Result<Crossings> all_hits(const RayView& rays, std::optional<std::size_t> limit = {});

  /// Sets counts[k] to the number of crossings of rays[k].
  Status count(const RayView& rays, std::span<std::int64_t> counts);

  /// Sets lengths[k] to the length of rays[k] inside the union of all spheres and capsules,
  /// between tmin and tmax, in units of t: where they overlap it counts once.
  Status chord(const RayView& rays, std::span<double> lengths);

  /// The length of each ray inside each sphere and capsule, between tmin and tmax, where it is
  /// above 0.
  Result<SphereChords> chords(const RayView& rays);

  /// Moves the spheres: that with the id k becomes spheres[k], except for its material. All answers
  /// are then those of a new tracer, to the bit. This takes less time than a new one: the tree
  /// stays while it is good (tuning::worn_tree). An error, with the tracer unchanged, if there are
  /// not as many spheres, if one is invalid, if they are those of a packed scene or of instances
  /// that share their group, or if there is too little memory. Planes and capsules stay.
  Status update(std::span<const Sphere> spheres);

  /// The spheres by id; none of a packed scene, or of instances that share their group. Their
  /// materials mean nothing. Throws std::bad_alloc.
  [[nodiscard]] std::vector<Sphere> spheres() const;

  /// The k nearest primitives of each point whose distance is at most `limit`, the nearest first;
  /// at equal distance the one with the lowest id. Where there are fewer, the rest has the distance
  /// inf and no_primitive. A distance is that of the surface, negative inside: the exact one,
  /// rounded once. A plane bounds the half-space behind it. The answers do not depend on the
  /// solver. An error, with the key "points" and the row, if a coordinate is not finite or beyond
  /// 1e150 in size.
  Status nearest(const PointColumns& points, std::size_t k, double limit,
                 const NearestColumns& found);

  /// The primitives that hold each point, on their surface or inside. Of more than sixteen exact
  /// copies of a sphere in a packed scene, two count, here and below. Errors are as for nearest();
  /// too little memory for the results is one with the memory that they need.
  Result<Members> inside(const PointColumns& points);
  /// Sets ids[k] to the lowest id of those, or to no_primitive.
  Status first_inside(const PointColumns& points, std::span<std::int32_t> ids);

  /// The primitives whose exact distance from each point is at most `radius`: one number, or one
  /// for each point. An error if it is NaN.
  Result<Members> within(const PointColumns& points, double radius);
  Result<Members> within(const PointColumns& points, const RayNumbers& radius);

  /// All pairs of spheres whose surfaces are at most `gap` apart, exactly: those that touch or
  /// overlap for 0, those that overlap by at least as much for a negative number.
  Result<SpherePairs> pairs(double gap = 0);

  /// The number of ids: of spheres, planes and capsules.
  [[nodiscard]] std::size_t primitives() const;
  [[nodiscard]] TraceStatistics statistics() const;

 private:
  /// Answers the rays that a worker has loaded: those of the call from `first` on.
  using Body = std::function<void(TraceWorker& worker, std::size_t first)>;

  /// Things in blocks of one size.
  struct Blocks {
    std::size_t all, size;
    [[nodiscard]] std::size_t count() const { return all / size + (all % size != 0 ? 1 : 0); }
  };
  using BlockWork = std::function<void(unsigned worker, std::size_t block)>;

  /// Answers points, the block-th block of the call.
  using PointBody = std::function<void(const PointRows& rows, std::size_t block)>;

  template <class AnyScene>
  static Result<Tracer> create_from(AnyScene&& scene, const TraceOptions& options);
  Tracer(Scene scene, const std::optional<std::vector<ShownGroup>>& groups,
         const TraceOptions& options, const KernelTable& kernels);
  static Diagnostic moved_away();
  /// An error unless there is a result for each of the things that are `asked`. `what`: their name.
  static Status check_room(const char* what, std::size_t asked, std::size_t results);
  [[nodiscard]] TraceTarget target() const;
  template <class Answer>
  auto answer_one(const Answer& answer) -> Result<decltype(answer(std::declval<TraceWorker&>()))>;
  Status find_any(const RayView& rays, std::span<std::uint8_t> met);
  [[nodiscard]] Status check_sources(const RayView& rays) const;
  Status run(const RayView& rays, std::size_t results, const Body& body);
  template <class Item, class MakeList>
  Result<RayLists<Item>> list_items(const RayView& rays, const std::string& name,
                                    const MakeList& make_list);
  Status run_rays(const RayView& rays, const Body& body);
  Status run_points(const PointColumns& points, const PointBody& body);
  /// Runs work(worker, block) for all blocks and tells the progress; `done` counts the things of
  /// the blocks that have ended. An error if it was cancelled.
  Status run_blocks(const Blocks& blocks, const BlockWork& work, std::atomic<std::size_t>& done);
  [[nodiscard]] bool is_solid(std::int32_t id) const { return !geometry_.is_plane({0, id}); }
  /// Rays per stream: enough to fill packets, and few enough to stay in the cache.
  static constexpr std::size_t rays_of_stream = 1024;
  TraceWorker& worker(unsigned index);

  TraceOptions options_;
  const KernelTable* kernels_;
  Geometry geometry_;
  GeometryView view_;      ///< of geometry_
  double built_cost_ = 0;  ///< of its tree when it was built
  Scheduler scheduler_;
  std::vector<std::unique_ptr<TraceWorker>> workers_;
  std::uint64_t rays_ = 0, points_ = 0;
  double prepare_seconds_ = 0;
  double trace_seconds_ = 0;
};

}  // namespace boule
