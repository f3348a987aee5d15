#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/ray.h"
#include "core/optics/camera_view.h"
#include "simd/abi/shading.h"
#include "simd/abi/stream.h"
#include "simd/stream/aligned_array.h"

namespace boule {

/// Memory for a RayStream. The ends of a ray's interval are rounded outward to float: kernels find
/// every hit that the ray has, and possibly others within a unit of float beyond its ends (Tracer
/// compares exactly). Reused from call to call. Growing, or sharing other numbers, loses the
/// rays in the buffer. Buffers in this file leave indices unchecked: i < size() is a precondition.
/// If resize() throws std::bad_alloc, the size stays as it was. A buffer that was moved from must
/// be resized before it is used again.
class RayBuffer {
 public:
  RayBuffer() = default;
  explicit RayBuffer(std::size_t size, CommonPart common = CommonPart::none) {
    resize(size, common);
  }

  /// Rays with a common origin or direction keep it once, and likewise tmin, source and inside:
  /// share() sets them. Kernels trace such rays faster if the query's coherence promises the same.
  void resize(std::size_t size, CommonPart common = CommonPart::none) {
    const SharedNumbers shared(common);
    each_array(
        shared.lengths(size), [](std::size_t length, auto& array) { array.resize(length); }, rays_);
    shared_ = shared;
    size_ = size;
  }
  /// Keeps the first `size` rays. Precondition: the buffer holds at least that many.
  void shrink(std::size_t size) { size_ = size; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Gives all rays the shared numbers of this one.
  void share(const Ray& ray) {
    for (std::size_t lane = 0; lane < max_width; ++lane) {
      if (shared_.has_origin()) set_origin(lane, ray);
      if (shared_.has_direction()) set_direction(lane, ray);
      if (shared_.has_start()) set_start(lane, ray);
    }
  }
  /// Sets the unshared numbers of ray i.
  void set(std::size_t i, const Ray& ray) {
    const RayPlaces at = shared_.places(i);
    if (!shared_.has_origin()) set_origin(at.org, ray);
    if (!shared_.has_direction()) set_direction(at.dir, ray);
    if (!shared_.has_start()) set_start(at.start, ray);
    rays_.tmax[at.tmax] = float_above(ray.tmax);
  }
  [[nodiscard]] Ray get(std::size_t i) const { return get_ray(rays_, shared_.places(i)); }
  [[nodiscard]] Vec3d org(std::size_t i) const { return get(i).org; }
  [[nodiscard]] Vec3f dir(std::size_t i) const { return get(i).dir; }

  /// The view for the kernels; valid until the next resize.
  RayStream view() {
    RayStream rays{};
    each_array(
        {}, [](std::size_t, auto& to, auto& array) { to = array.data(); }, rays, rays_);
    rays.shared = shared_;
    rays.size = size_;
    return rays;
  }

 private:
  void set_origin(std::size_t i, const Ray& ray) {
    rays_.org_x[i] = ray.org.x;
    rays_.org_y[i] = ray.org.y;
    rays_.org_z[i] = ray.org.z;
  }
  void set_direction(std::size_t i, const Ray& ray) {
    rays_.dir_x[i] = ray.dir.x;
    rays_.dir_y[i] = ray.dir.y;
    rays_.dir_z[i] = ray.dir.z;
  }
  void set_start(std::size_t i, const Ray& ray) {
    rays_.tmin[i] = float_below(ray.tmin);
    rays_.source[i] = ray.source;
    rays_.inside[i] = ray.inside ? 1 : 0;
  }

  RayArrays<AlignedArray> rays_;
  SharedNumbers shared_;
  std::size_t size_ = 0;
};

/// Memory for a HitStream, as RayBuffer.
class HitBuffer {
 public:
  HitBuffer() = default;
  explicit HitBuffer(std::size_t size) { resize(size); }

  void resize(std::size_t size) {
    t_.resize(size);
    id_.resize(size);
    slot_.resize(size);
    size_ = size;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Hit get(std::size_t i) const { return {t_[i], id_[i], slot_[i]}; }
  HitStream view() { return {t_.data(), id_.data(), slot_.data(), size_}; }

 private:
  AlignedArray<double> t_;
  AlignedArray<std::int32_t> id_;
  AlignedArray<std::uint32_t> slot_;
  std::size_t size_ = 0;
};

/// Memory for a VectorStream, as RayBuffer.
class VectorBuffer {
 public:
  void resize(std::size_t size) {
    x_.resize(size);
    y_.resize(size);
    z_.resize(size);
  }
  void set(std::size_t i, const Vec3d& v) {
    x_[i] = v.x;
    y_[i] = v.y;
    z_[i] = v.z;
  }
  [[nodiscard]] Vec3d get(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  VectorStream view() { return {x_.data(), y_.data(), z_.data()}; }

 private:
  AlignedArray<double> x_, y_, z_;
};

/// Memory for a SampleStream, as RayBuffer.
class SampleBuffer {
 public:
  /// Room for samples without a lens and without weights.
  void resize(std::size_t size) {
    raster_x_.resize(size);
    raster_y_.resize(size);
    size_ = size;
  }
  /// Room for the arrays that a camera needs; new lens samples are at the lens' centre.
  void resize(std::size_t size, const CameraView& camera) {
    if (has_lens(camera.kind)) {
      lens_x_.resize(size, 0.5);
      lens_y_.resize(size, 0.5);
    }
    if (camera.weighs) weight_.resize(size);
    resize(size);
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  void set(std::size_t i, double x, double y) {
    raster_x_[i] = x;
    raster_y_[i] = y;
  }
  void set_lens(std::size_t i, double x, double y) {
    lens_x_[i] = x;
    lens_y_[i] = y;
  }
  /// The weight of the ray through sample i; only for a camera that weighs.
  [[nodiscard]] float weight(std::size_t i) const { return weight_[i]; }
  SampleStream view() {
    return {raster_x_.data(), raster_y_.data(), lens_x_.data(),
            lens_y_.data(),   weight_.data(),   size_};
  }

 private:
  AlignedArray<double> raster_x_, raster_y_, lens_x_, lens_y_;
  AlignedArray<float> weight_;
  std::size_t size_ = 0;
};

}  // namespace boule
