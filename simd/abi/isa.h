#pragma once

#include <cstddef>

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

/// How to trace one stream. Only reference_kernels() has solver reference; other tables take it for
/// robust.
struct Query {
  Solver solver = Solver::robust;
  Form form = Form::automatic;
  Coherence coherence = Coherence::none;
};

/// The widest packet. Every stream and every array of primitives is padded to a multiple of it.
inline constexpr std::size_t max_width = 16;

/// In bytes. Streams and arrays of primitives start on a cache line.
inline constexpr std::size_t stream_alignment = 64;

/// n rounded up to a whole number of the widest packets.
constexpr std::size_t padded(std::size_t n) { return (n + max_width - 1) / max_width * max_width; }

}  // namespace boule
