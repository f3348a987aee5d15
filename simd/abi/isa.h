#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace boule {

/// The instruction sets for which kernels are compiled.
enum class Isa { scalar, sse42, avx2, avx512, neon };

/// The way in which a hit is decided. fast: in float. Decisions may be wrong within a band
/// (docs/numerics.md). robust: a conservative reject in float, then double. Decisions are exact.
/// reference: scalar code that tests every pair in double, with the same bits as robust.
enum class Solver { fast, robust, reference };

/// The contents of the W lanes of a kernel. packet: W rays against one primitive. single: one ray
/// against W primitives, ray after ray. flight: as single, with many rays at a time, each of which
/// advances step by step along its own path. set: as single, with hundreds of rays that visit a
/// node together. Flights and sets need a tree and the solver robust; otherwise rays are traced as
/// packets. Rays with tmin < 0, or beyond the range of floats, are traced as single. For any_hit,
/// flight means set. The hits are the same in every form; automatic lets the kernel choose.
enum class Form { automatic, packet, single, flight, set };

/// The coherence of a stream's rays: a promise by the caller that lets a kernel trace them as
/// bundles. A true promise changes the time and leaves every hit as it is. A false promise may lose
/// hits. Bundles give the hits of robust to the solver fast, too. common_end is for any_hit only:
/// all rays end in one point, at t = 1, up to the rounding of their directions.
enum class Coherence { none, common_origin, common_direction, common_end };

/// The results of trials that find the fastest way to trace rays of one kind. If you trace many
/// short streams, keep an Experience and pass it on: each stream then saves its own trials. Keep
/// one per kind of rays (say, those after the second bounce of a picture), per geometry, per kernel
/// table and function, and per thread. A new Experience is empty. It changes the time and leaves
/// every hit as it is. The numbers belong to the kernels.
struct Experience {
  struct Cost {
    float ticks = 0, rays = 0;  ///< of all trials, later ones weighing more
  };
  Cost cost[3];            ///< cost of each way of the last trial
  std::uint32_t way = 0;   ///< the fastest one
  std::uint32_t rays = 0;  ///< number of rays that go that way after a trial
  std::uint32_t left = 0;  ///< number of those rays still to come; 0: the next rays are a trial
  std::uint32_t next_way = 0, last_way = 0;  ///< of the trial

  /// Of shadow rays that have little in common with their neighbours: whether they are sorted.
  struct Sorting {
    float most = std::numeric_limits<float>::max();  ///< ticks of an unsorted ray
    std::uint32_t pays = 2;  ///< 1 if a sorted ray takes at most that, otherwise 0; 2: unknown
    std::uint32_t rays = 0;  ///< number of rays after a trial that rely on it
    std::uint32_t left = 0;  ///< number of those rays still to come; 0: the next rays are a trial
  };
  Sorting sorting;
};

/// The settings for tracing one stream. Only reference_kernels() has the solver reference; other
/// tables treat it as robust.
struct Query {
  Solver solver = Solver::robust;
  Form form = Form::automatic;
  Coherence coherence = Coherence::none;
  Experience* experience = nullptr;  ///< null: the stream runs its own trials
};

/// The number of rays in the widest packet. Every stream and every array of primitives is padded to
/// a multiple of it.
inline constexpr std::size_t max_width = 16;

/// The alignment of streams and of arrays of primitives, in bytes: a cache line.
inline constexpr std::size_t stream_alignment = 64;

/// n rounded up to a multiple of max_width.
constexpr std::size_t padded(std::size_t n) { return (n + max_width - 1) / max_width * max_width; }

}  // namespace boule
