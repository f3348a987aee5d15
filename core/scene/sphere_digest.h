#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"

namespace boule {

/// A hash of spheres in their order, which come in parts of any size: 64 bits that are the same
/// however they are cut into parts, and whatever runs the loops. Not cryptographic.
class SphereDigest {
 public:
  /// Throws std::bad_alloc, and what `parallel_for` throws.
  void add(std::span<const Sphere> spheres, const ParallelFor& parallel_for = serial_for);

  [[nodiscard]] std::uint64_t value() const;

 private:
  void add_to_chunk(std::span<const Sphere> spheres);

  std::uint64_t count_ = 0;
  std::uint64_t chunks_ = 0;  ///< of whole chunks
  std::uint64_t chunk_ = 0;   ///< of the spheres since
};

}  // namespace boule
