#pragma once

#include <cstddef>

namespace boule {

/// The instruction sets kernels are compiled for; `width` lanes of float each.
enum class Isa { scalar, sse42, avx2, avx512, neon };

/// How a hit is found. fast: in float, answers within a band. robust: conservative float reject,
/// then double: exact decisions. reference: scalar, every pair in double, robust's bits.
enum class Solver { fast, robust, reference };

/// Which side of the work is laid across the lanes: W rays against one primitive (packet), or one
/// ray against W primitives, ray after ray (single), or many in flight at a time, step by step
/// (flight: with a tree and solver robust; else packets; rays with tmin < 0, or that floats cannot
/// judge, go single). The answers are the same; automatic lets the kernel choose.
enum class Form { automatic, packet, single, flight };

/// What a stream's rays have in common: a promise by the caller that lets a kernel treat them as a
/// bundle. Kept, it may change the time, never the answer; broken, some hits may be missed. Bundles
/// give robust's answers to solver fast as well.
/// common_end: all end in one point, at t = 1, up to the rounding of their directions; for any_hit
/// only.
enum class Coherence { none, common_origin, common_direction, common_end };

/// How to answer one stream. Solver reference is reference_kernels()' business: other tables take
/// it for robust.
struct Query {
  Solver solver = Solver::robust;
  Form form = Form::automatic;
  Coherence coherence = Coherence::none;
};

/// The widest packet: every stream and every primitive array is padded to a multiple of it.
inline constexpr std::size_t max_width = 16;

/// Bytes: streams and primitive arrays start on a cache line.
inline constexpr std::size_t stream_alignment = 64;

/// n rounded up to a whole number of the widest packets.
constexpr std::size_t padded(std::size_t n) { return (n + max_width - 1) / max_width * max_width; }

}  // namespace boule
