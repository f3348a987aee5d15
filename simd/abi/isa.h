#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// The instruction sets that kernels are compiled for.
enum class Isa { scalar, sse42, avx2, avx512, neon };

/// How a hit is found. fast: in float; decisions may be wrong within a band (docs/numerics.md).
/// robust: a conservative reject in float, then double; decisions are exact. reference: scalar,
/// every pair in double; the same bits as robust.
enum class Solver { fast, robust, reference };

/// What the W lanes of a kernel hold. packet: W rays against one primitive. single: one ray against
/// W primitives, ray after ray. flight: the same with many rays at a time, step by step, each on
/// its own way. set: the same with hundreds of rays, which visit a node together. Flights and sets
/// need a tree and solver robust, else rays go as packets; rays with tmin < 0, or that floats
/// cannot judge, go single; and for any hit flights are sets. The hits are the same; automatic lets
/// the kernel choose.
enum class Form { automatic, packet, single, flight, set };

/// What a stream's rays have in common: a promise by the caller, by which a kernel may trace them
/// as bundles. A promise that is kept changes the time, never a hit; one that is broken may lose
/// hits. Bundles give robust's hits to solver fast, too. common_end, for any_hit only: all rays end
/// in one point, at t = 1, up to the rounding of their directions.
enum class Coherence { none, common_origin, common_direction, common_end };

/// What trials among rays of one kind have found out: which way is fastest. A caller who keeps it
/// from stream to stream saves each the trials of its own. One for each kind of rays (say, those
/// after the second bounce of a picture), for each geometry, table and function of kernels, and for
/// each thread. A new one knows nothing. It changes the time, never a hit. Its numbers are the
/// kernels' own.
struct Experience {
  struct Cost {
    float ticks = 0, rays = 0;  ///< of all trials, the later the more
  };
  Cost cost[3];            ///< of each way
  std::uint32_t way = 0;   ///< the fastest one
  std::uint32_t rays = 0;  ///< how many go that way after a trial
  std::uint32_t left = 0;  ///< how many of them are still to come; 0: the next ones are a trial
  std::uint32_t next_way = 0, tried_ways = 0;  ///< of the trial: the next one, and how many
};

/// How to trace one stream. Only reference_kernels() has solver reference; other tables take it for
/// robust.
struct Query {
  Solver solver = Solver::robust;
  Form form = Form::automatic;
  Coherence coherence = Coherence::none;
  Experience* experience = nullptr;  ///< null: the stream finds out for itself
};

/// The widest packet. Every stream and every array of primitives is padded to a multiple of it.
inline constexpr std::size_t max_width = 16;

/// In bytes. Streams and arrays of primitives start on a cache line.
inline constexpr std::size_t stream_alignment = 64;

/// n rounded up to a whole number of the widest packets.
constexpr std::size_t padded(std::size_t n) { return (n + max_width - 1) / max_width * max_width; }

}  // namespace boule
