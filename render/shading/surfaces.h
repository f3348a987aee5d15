#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/surface.h"
#include "render/prepare/prepared_scene.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// The surfaces that a stream's rays met, found block by block. What lights need is kept for the
/// whole stream; whole surfaces are those of the block that was found last. One serves one thread
/// and keeps its memory from stream to stream.
class Surfaces {
 public:
  /// Rays in a block, at most: few enough for their surfaces to stay in the nearest caches.
  static constexpr std::size_t block_size = 256;

  /// `scene` and `kernels` must outlive it.
  Surfaces(const PreparedScene& scene, const KernelTable& kernels);

  /// Makes room for so many rays. Throws std::bad_alloc.
  void resize(std::size_t rays);

  /// Finds what rays first .. first + size - 1 met; `first` is a multiple of block_size, and size
  /// at most that.
  void find(const RayStream& rays, const HitStream& hits, std::size_t first, std::size_t size);

  /// What ray k of the block met, a hit.
  [[nodiscard]] Surface get(std::size_t k) const;

  /// Where ray k of the stream met something, and what it mirrors there.
  [[nodiscard]] Vec3d point(std::size_t k) const { return points_.get(k); }
  [[nodiscard]] Vec3d mirrored(std::size_t k) const { return mirrored_.get(k); }

  /// Where rays leave the point of ray k of the stream, to the viewer's side.
  [[nodiscard]] Departure departure(std::size_t k) const {
    return {orgs_.get(k), ids_[k], inside_[k] != 0};
  }

  /// The points of the first `size` rays; lit[k]: 1 where light may fall on that of ray k, 0 for
  /// all others up to padded(size).
  LitStream lit(const std::uint8_t* lit, std::size_t size);

 private:
  const KernelTable& kernels_;
  GeometryView geometry_;
  SphereRows spheres_;
  const std::int32_t* ids_ = nullptr;  ///< by ray, as found last
  // By ray of the stream.
  VectorBuffer points_, normals_, mirrored_, orgs_;
  AlignedArray<std::uint8_t> inside_;
  // By ray of the block.
  std::size_t first_ = 0;
  VectorBuffer views_;
  AlignedArray<double> cosines_, reaches_;
  AlignedArray<std::uint8_t> inner_;
};

}  // namespace boule
