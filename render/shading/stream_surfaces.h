#pragma once

#include <cstddef>
#include <cstdint>

#include "core/surface.h"
#include "render/prepare/prepared_scene.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// The surfaces that a stream's rays hit, found block by block. The data for shadow rays are kept
/// for the whole stream; the rest is kept for the last block.
class StreamSurfaces {
 public:
  /// The largest number of rays in a block: few enough for their surfaces to stay in the nearest
  /// caches.
  static constexpr std::size_t block_size = 256;

  /// `scene` and `kernels` must outlive it.
  StreamSurfaces(const PreparedScene& scene, const KernelTable& kernels);

  /// Makes room for `rays` rays.
  void resize(std::size_t rays);

  /// Finds the surfaces of the block of rays first .. first + size - 1. Preconditions: `first` is a
  /// multiple of block_size, and size <= block_size.
  void find(const RayStream& rays, const HitStream& hits, std::size_t first, std::size_t size);

  /// The surfaces of the last block, by its rays.
  SurfaceStream of_block();
  /// The planes, which have no inside.
  [[nodiscard]] const PlaneView& planes() const { return geometry_.planes; }

  /// The surface that ray k of the block hit. Precondition: it hit one.
  [[nodiscard]] Surface get(std::size_t k) const;

  /// Surface::point and Surface::mirrored, by ray of the stream.
  VectorStream points() { return points_.view(); }
  VectorStream mirrored() { return mirrored_.view(); }

  /// The hits of the first `size` rays. lit[k] is 1 if light may reach the hit of ray k, otherwise
  /// 0, also up to padded(size).
  LitStream lit(const std::uint8_t* lit, std::size_t size);

 private:
  [[nodiscard]] bool is_plane(std::int32_t id) const {
    const PlaneView& planes = geometry_.planes;
    const auto first = static_cast<std::uint32_t>(planes.first_id);
    return static_cast<std::uint32_t>(id) - first < planes.size;
  }

  const KernelTable& kernels_;
  GeometryView geometry_;
  const std::int32_t* ids_ = nullptr;  ///< by ray, from the last find()
  // By ray of the stream:
  VectorBuffer points_, normals_, mirrored_, orgs_;
  AlignedArray<std::uint8_t> inside_;
  // By ray of the block:
  std::size_t first_ = 0;
  VectorBuffer views_;
  AlignedArray<double> cosines_, reaches_;
  AlignedArray<std::uint8_t> inner_;
};

}  // namespace boule
