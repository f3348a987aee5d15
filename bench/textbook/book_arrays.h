#pragma once

#include <limits>

#include "bench/textbook/book_solvers.h"
#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "simd/abi/geometry.h"
#include "simd/stream/aligned_array.h"

namespace boule::bench {

/// Spheres and rays for the solvers of textbooks, and room for their answers.
class BookArrays {
 public:
  BookArrays(std::size_t spheres, std::size_t rays)
      : radius_(spheres, std::numeric_limits<float>::quiet_NaN()), t_(rays) {
    for (AlignedArray<float>& row : center_) row.resize(spheres);
    for (AlignedArray<float>& row : org_) row.resize(rays);
    for (AlignedArray<float>& row : dir_) row.resize(rays);
    data_ = {center_[0].data(), center_[1].data(), center_[2].data(), radius_.data(),
             spheres,           org_[0].data(),    org_[1].data(),    org_[2].data(),
             dir_[0].data(),    dir_[1].data(),    dir_[2].data(),    rays,
             t_.data(),         nullptr,           nullptr,           0};
  }

  void set(std::size_t i, const Sphere& sphere) {
    set(center_, i, sphere.center);
    radius_[i] = sphere.radius;
  }
  /// The origin is rounded to float, the bounds are left out.
  void set(std::size_t i, const Ray& ray) {
    set(org_, i, vec_cast<float>(ray.org));
    set(dir_, i, ray.dir);
  }

  /// Sets the tree to traverse; the geometry is made with Structure::bvh and must outlive this.
  void set(const GeometryView& tree) {
    data_.nodes = tree.bvh.size > 0 ? tree.bvh.nodes : nullptr;
    data_.blocks = tree.spheres.blocks;
    data_.apart = tree.spheres.scanned / bvh_leaf_size;
  }

  [[nodiscard]] const BookData& data() const { return data_; }

 private:
  static void set(AlignedArray<float> (&rows)[3], std::size_t i, const Vec3f& v) {
    rows[0][i] = v.x;
    rows[1][i] = v.y;
    rows[2][i] = v.z;
  }

  AlignedArray<float> center_[3], radius_, org_[3], dir_[3], t_;
  BookData data_;
};

/// Rays first .. first + size - 1; `first` a multiple of max_width.
inline BookData part_of(BookData data, std::size_t first, std::size_t size) {
  for (const float** row :
       {&data.org_x, &data.org_y, &data.org_z, &data.dir_x, &data.dir_y, &data.dir_z})
    *row += first;
  data.t += first;
  data.rays = size;
  return data;
}

}  // namespace boule::bench
