#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/scenes/bench_scenes.h"
#include "bench/scenes/ray_kinds.h"
#include "core/math/ray.h"
#include "simd/abi/stream.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {

/// One question to all: the rays of one kind in one scene.
struct Workload {
  const BenchScene* scene;
  RayKind kind;
  RayBuffer* rays;
};

/// What was answered: nearest hits, or for shadow rays whether anything was met.
struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> occluded;
};

/// Contenders are asked for whole blocks of so many rays: the renderer's.
inline std::size_t block_size(const Workload& workload) {
  return fitting_stream_size(workload.scene->spheres.size());
}

/// One way of answering a workload.
class Contender {
 public:
  struct Info {
    std::string name;    ///< "boule-avx2-packet", "embree-user-16"
    std::string isa;     ///< of the code that runs
    std::size_t width;   ///< rays per call
    std::string solver;  ///< "robust", "fast", "float"
    bool embree;
    bool exact;  ///< its answers are to be the truth's, bit for bit
  };

  explicit Contender(Info info) : info_(std::move(info)) {}
  virtual ~Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;

  [[nodiscard]] const Info& info() const { return info_; }

  /// Makes everything ready for tracing all rays afresh. Not timed.
  virtual void prepare() = 0;
  /// Traces rays first .. last - 1; `first` a multiple of block_size(). Timed; from several
  /// threads.
  virtual void trace(std::size_t first, std::size_t last) = 0;
  /// The answers, once all rays are traced and before anybody else prepares.
  virtual void answer(Answers& answers) const = 0;

 private:
  Info info_;
};

}  // namespace boule::bench
