#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"

namespace boule {

/// A hash of spheres in their order, added in parts of any size: 64 bits that are the same for any
/// partition and any `parallel_for`. Not cryptographic.
class SphereDigest {
 public:
  /// Throws std::bad_alloc, and the exceptions of `parallel_for`.
  void add(std::span<const Sphere> spheres, const ParallelFor& parallel_for = serial_for);

  [[nodiscard]] std::uint64_t value() const;

 private:
  void add_to_chunk(std::span<const Sphere> spheres);

  std::uint64_t count_ = 0;
  std::uint64_t chunks_ = 0;  ///< of whole chunks
  std::uint64_t chunk_ = 0;   ///< of the spheres since
};

}  // namespace boule
