#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "render/apps/python/scenes/sphere_arrays.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/errors.h"
#include "render/renderer/tracer.h"

namespace boule::python {

/// So few rays or points take less than a millisecond: they are traced without a thread that waits.
inline constexpr std::size_t few_questions = 2048;

/// A Tracer that any threads may call: one call at a time works, the others wait for it.
class SharedTracer {
 public:
  SharedTracer(TraceOptions options, const Vec3d& zero)
      : options_(std::move(options)), zero_(zero) {
    options_.cancel = &stop_;
    options_.progress = [this](const Progress&) { stop_ = asked_->load(); };
  }

  Status create(Scene&& scene) {
    Result<Tracer> made = Tracer::create(std::move(scene), options_);
    if (!made) return made.error();
    primitives_ = made.value().primitives();
    tracer_.emplace(std::move(made).value());
    return {};
  }

  /// Traces, until `cancel` is true.
  template <class Trace>
  Status run(const std::atomic<bool>& cancel, const Trace& trace) {
    const std::lock_guard lock(mutex_);
    asked_ = &cancel;
    stop_ = cancel.load();
    return trace(*tracer_);
  }

  /// Moves its spheres, which count from `zero` from now on.
  Status update(const PlacedSpheres& placed) {
    const std::lock_guard lock(mutex_);
    if (auto done = tracer_->update(placed.spheres); !done) return done;
    zero_ = placed.origin;
    return {};
  }
  /// How many objects it has; of a Tracer of spheres they are all.
  [[nodiscard]] std::size_t primitives() const { return primitives_; }
  [[nodiscard]] PlacedSpheres spheres() {
    const std::lock_guard lock(mutex_);
    return {tracer_->spheres(), zero_};
  }

  /// Where rays are counted from. The calling thread is in run().
  [[nodiscard]] const Vec3d& zero() const { return zero_; }
  [[nodiscard]] TraceStatistics statistics() {
    const std::lock_guard lock(mutex_);
    return tracer_->statistics();
  }

 private:
  TraceOptions options_;
  Vec3d zero_;
  std::size_t primitives_ = 0;
  std::mutex mutex_;
  std::atomic<bool> stop_{false};
  const std::atomic<bool>* asked_ = nullptr;  ///< the flag of the call that works
  std::optional<Tracer> tracer_;
};

using TracerHandle = std::shared_ptr<SharedTracer>;

/// Runs query(tracer, zero) for so many rays or points, with a thread that waits for signals if it
/// may take long.
template <class Query>
void ask(const TracerHandle& tracer, std::size_t count, const Query& query) {
  const auto work = [tracer, query](const std::atomic<bool>& cancel) {
    return tracer->run(cancel, [&](Tracer& one) { return query(one, tracer->zero()); });
  };
  if (count <= few_questions) {
    const std::atomic<bool> never{false};
    Status status;
    {
      const pybind11::gil_scoped_release no_gil;
      status = work(never);
    }
    return check(status);
  }
  check(interruptible([work](Call& call) { return work(call.cancel); }));
}

/// A vector's values as an array, which keeps all of `lists`.
template <class Shown, class Lists, class Number>
pybind11::array kept_column(const std::shared_ptr<Lists>& lists, std::vector<Number>& column) {
  static_assert(sizeof(Shown) == sizeof(Number));
  return array_in(reinterpret_cast<Shown*>(column.data()),
                  {static_cast<pybind11::ssize_t>(column.size())}, lists);
}

}  // namespace boule::python
