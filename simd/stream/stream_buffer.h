#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/ray.h"
#include "simd/abi/camera.h"
#include "simd/abi/shading.h"
#include "simd/abi/stream.h"
#include "simd/stream/aligned_array.h"

namespace boule {

/// Memory for a RayStream, kept from use to use. Growing loses the rays that were in it. As of all
/// buffers here, what places there are is not checked: i < size() is a precondition. resize()
/// throws std::bad_alloc, and the size stays what it was. One that was moved away is resized first.
class RayBuffer {
 public:
  RayBuffer() = default;
  explicit RayBuffer(std::size_t size) { resize(size); }

  void resize(std::size_t size) {
    org_x_.resize(size);
    org_y_.resize(size);
    org_z_.resize(size);
    dir_x_.resize(size);
    dir_y_.resize(size);
    dir_z_.resize(size);
    tmin_.resize(size);
    tmax_.resize(size);
    source_.resize(size);
    inside_.resize(size);
    size_ = size;
  }
  [[nodiscard]] std::size_t size() const { return size_; }

  void set(std::size_t i, const Ray& ray) {
    org_x_[i] = ray.org.x;
    org_y_[i] = ray.org.y;
    org_z_[i] = ray.org.z;
    dir_x_[i] = ray.dir.x;
    dir_y_[i] = ray.dir.y;
    dir_z_[i] = ray.dir.z;
    tmin_[i] = ray.tmin;
    tmax_[i] = ray.tmax;
    source_[i] = ray.source;
    inside_[i] = ray.inside ? 1 : 0;
  }
  [[nodiscard]] Vec3d org(std::size_t i) const { return {org_x_[i], org_y_[i], org_z_[i]}; }
  [[nodiscard]] Vec3f dir(std::size_t i) const { return {dir_x_[i], dir_y_[i], dir_z_[i]}; }
  [[nodiscard]] Ray get(std::size_t i) const {
    Ray ray{{org_x_[i], org_y_[i], org_z_[i]}, {dir_x_[i], dir_y_[i], dir_z_[i]}};
    ray.tmin = tmin_[i];
    ray.tmax = tmax_[i];
    ray.source = source_[i];
    ray.inside = inside_[i] != 0;
    return ray;
  }

  /// The rays as the kernels see them; valid until the next resize.
  RayStream view() {
    return {org_x_.data(),  org_y_.data(),  org_z_.data(), dir_x_.data(),
            dir_y_.data(),  dir_z_.data(),  tmin_.data(),  tmax_.data(),
            source_.data(), inside_.data(), size_};
  }

 private:
  AlignedArray<double> org_x_, org_y_, org_z_;
  AlignedArray<float> dir_x_, dir_y_, dir_z_, tmin_, tmax_;
  AlignedArray<std::int32_t> source_;
  AlignedArray<std::uint8_t> inside_;
  std::size_t size_ = 0;
};

/// Memory for a HitStream, likewise.
class HitBuffer {
 public:
  HitBuffer() = default;
  explicit HitBuffer(std::size_t size) { resize(size); }

  void resize(std::size_t size) {
    t_.resize(size);
    id_.resize(size);
    size_ = size;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Hit get(std::size_t i) const { return {t_[i], id_[i]}; }
  HitStream view() { return {t_.data(), id_.data(), size_}; }

 private:
  AlignedArray<double> t_;
  AlignedArray<std::int32_t> id_;
  std::size_t size_ = 0;
};

/// Memory for a VectorStream, likewise.
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

/// Memory for a TurnStream, likewise.
class TurnBuffer {
 public:
  void resize(std::size_t size) {
    vectors_.resize(size);
    for (auto* numbers : {&cosine_, &sine_, &turns_}) numbers->resize(size);
  }
  void set(std::size_t i, const Vec3d& axis, double cosine, double sine, double turns) {
    vectors_.set(i, axis);
    cosine_[i] = cosine;
    sine_[i] = sine;
    turns_[i] = turns;
  }
  /// What the kernels made of axis i.
  [[nodiscard]] Vec3d direction(std::size_t i) const { return vectors_.get(i); }
  /// The first `size`; directions take their axes' places.
  TurnStream view(std::size_t size) {
    return {vectors_.view(), cosine_.data(), sine_.data(), turns_.data(), vectors_.view(), size};
  }

 private:
  VectorBuffer vectors_;
  AlignedArray<double> cosine_, sine_, turns_;
};

/// Memory for a SeekStream, likewise.
class SeekBuffer {
 public:
  void resize(std::size_t size) {
    org_.resize(size);
    center_.resize(size);
    for (auto* numbers : {&radius_, &u_, &v_, &density_}) numbers->resize(size);
    tmax_.resize(size);
  }
  void set(std::size_t i, const Vec3d& org, const Vec3d& center, double radius, double u,
           double v) {
    org_.set(i, org);
    center_.set(i, center);
    radius_[i] = radius;
    u_[i] = u;
    v_[i] = v;
  }
  [[nodiscard]] Vec3d direction(std::size_t i) const { return center_.get(i); }
  [[nodiscard]] double density(std::size_t i) const { return density_[i]; }
  [[nodiscard]] float tmax(std::size_t i) const { return tmax_[i]; }
  /// The first `size`; directions take the centres' places.
  SeekStream view(std::size_t size) {
    return {org_.view(),    center_.view(),  radius_.data(), u_.data(), v_.data(),
            center_.view(), density_.data(), tmax_.data(),   size};
  }

 private:
  VectorBuffer org_, center_;
  AlignedArray<double> radius_, u_, v_, density_;
  AlignedArray<float> tmax_;
};

/// Memory for a SampleStream, likewise.
class SampleBuffer {
 public:
  /// Room for samples without a lens and without weights.
  void resize(std::size_t size) {
    raster_x_.resize(size);
    raster_y_.resize(size);
    size_ = size;
  }
  /// Room for what a camera asks for; new lens samples are in the lens' centre.
  void resize(std::size_t size, const CameraView& camera) {
    resize(size);
    if (has_lens(camera.kind)) {
      lens_x_.resize(size, 0.5);
      lens_y_.resize(size, 0.5);
    }
    if (camera.weighs) weight_.resize(size);
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
  /// What the camera's ray counts; of a camera that weighs.
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
