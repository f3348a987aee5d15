#include "core/scene/sphere_digest.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "core/math/random.h"

namespace boule {
namespace {

constexpr std::size_t digest_chunk = 16'384;

std::uint64_t word_of(float low, float high) {
  return std::bit_cast<std::uint32_t>(low) | std::uint64_t{std::bit_cast<std::uint32_t>(high)}
                                                 << 32;
}

/// Appends a hash to those before it: the sum of all, each times a power of an odd number that
/// encodes its place.
std::uint64_t append(std::uint64_t hashes, std::uint64_t next) {
  return hashes * golden_step + next;
}

std::uint64_t hash_of(const Sphere& s) {
  std::uint64_t hash = mix64(word_of(s.center.x, s.center.y) + golden_step);
  hash = mix64(hash + word_of(s.center.z, s.radius));
  return mix64(hash + s.material.bits());
}

std::uint64_t hash_of(std::uint64_t before, std::span<const Sphere> spheres) {
  for (const Sphere& sphere : spheres) before = append(before, hash_of(sphere));
  return before;
}

}  // namespace

/// Precondition: they fit into the rest of the chunk.
void SphereDigest::add_to_chunk(std::span<const Sphere> spheres) {
  chunk_ = hash_of(chunk_, spheres);
  count_ += spheres.size();
  if (count_ % digest_chunk != 0 || spheres.empty()) return;
  chunks_ = append(chunks_, mix64(chunk_));
  chunk_ = 0;
}

void SphereDigest::add(std::span<const Sphere> spheres, const ParallelFor& parallel_for) {
  const std::size_t first =
      std::min(spheres.size(),
               static_cast<std::size_t>((digest_chunk - count_ % digest_chunk) % digest_chunk));
  add_to_chunk(spheres.first(first));
  const std::span<const Sphere> rest = spheres.subspan(first);
  std::vector<std::uint64_t> hashes(rest.size() / digest_chunk);
  if (!hashes.empty()) {
    parallel_for(hashes.size(), [&](std::size_t i) {
      hashes[i] = hash_of(0, rest.subspan(i * digest_chunk, digest_chunk));
    });
  }
  for (const std::uint64_t hash : hashes) chunks_ = append(chunks_, mix64(hash));
  count_ += hashes.size() * digest_chunk;
  add_to_chunk(rest.subspan(hashes.size() * digest_chunk));
}

std::uint64_t SphereDigest::value() const { return mix64(mix64(mix64(chunks_) + chunk_) + count_); }

}  // namespace boule
