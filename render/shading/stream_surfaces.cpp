#include "render/shading/stream_surfaces.h"

#include "simd/geometry/geometry.h"

namespace boule {

StreamSurfaces::StreamSurfaces(const PreparedScene& scene, const KernelTable& kernels)
    : kernels_(kernels), geometry_(scene.geometry.view()) {
  views_.resize(block_size);
  cosines_.resize(block_size);
  reaches_.resize(block_size);
  inner_.resize(block_size);
}

void StreamSurfaces::resize(std::size_t rays) {
  for (VectorBuffer* vectors : {&points_, &normals_, &mirrored_, &orgs_}) vectors->resize(rays);
  inside_.resize(rays);
}

void StreamSurfaces::find(const RayStream& rays, const HitStream& hits, std::size_t first,
                          std::size_t size) {
  first_ = first;
  ids_ = hits.id;
  kernels_.find_surfaces(geometry_, part(rays, first, size), part(hits, first, size), of_block());
}

SurfaceStream StreamSurfaces::of_block() {
  return {part(points_.view(), first_),
          part(normals_.view(), first_),
          views_.view(),
          part(mirrored_.view(), first_),
          part(orgs_.view(), first_),
          cosines_.data(),
          reaches_.data(),
          inner_.data(),
          inside_.data() + first_};
}

Surface StreamSurfaces::get(std::size_t k) const {
  const std::size_t i = first_ + k;
  const std::int32_t id = ids_[i];
  return {points_.get(i),
          normals_.get(i),
          views_.get(k),
          mirrored_.get(i),
          cosines_[k],
          reaches_[k],
          id,
          inner_[k] != 0,
          !is_plane(id)};
}

LitStream StreamSurfaces::lit(const std::uint8_t* lit, std::size_t size) {
  return {points_.view(), normals_.view(), orgs_.view(), ids_, inside_.data(), lit, size};
}

}  // namespace boule
