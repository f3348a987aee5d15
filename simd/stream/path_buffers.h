#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/color.h"
#include "simd/abi/paths.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Memory for the streams of simd/abi/paths.h, reused from call to call like that of RayBuffer.

class ColorBuffer {
 public:
  /// New memory is filled with grey of this value.
  void resize(std::size_t size, float fill = 0) {
    for (auto* numbers : {&r_, &g_, &b_}) numbers->resize(size, fill);
  }
  void set(std::size_t i, const Color& c) {
    r_[i] = c.r;
    g_[i] = c.g;
    b_[i] = c.b;
  }
  [[nodiscard]] Color get(std::size_t i) const { return {r_[i], g_[i], b_[i]}; }
  void add(std::size_t i, const Color& c) { set(i, get(i) + c); }
  ColorStream view() { return {r_.data(), g_.data(), b_.data()}; }

 private:
  AlignedArray<float> r_, g_, b_;
};

/// Memory for LobePoints.
class LobePointBuffer {
 public:
  explicit LobePointBuffer(std::size_t size) {
    const std::size_t room = size + max_width;
    for (auto* vectors : {&normal_, &org_, &point_}) vectors->resize(room);
    reach_.resize(room);
    dir_.resize(room);
    id_.resize(room);
    for (auto* numbers : {&side_, &ray_, &sample_}) numbers->resize(room);
    throughput_.resize(room);
  }
  /// A view with room for points and a size of 0.
  LobePoints view() {
    return {normal_.view(),
            org_.view(),
            point_.view(),
            reach_.data(),
            dir_.view(),
            side_.data(),
            id_.data(),
            ray_.data(),
            throughput_.view(),
            sample_.data(),
            0};
  }

 private:
  VectorBuffer normal_, org_, point_;
  AlignedArray<double> reach_;
  AlignedArray<std::uint32_t> side_, ray_, sample_;
  AlignedArray<std::int32_t> id_;
  ColorBuffer dir_, throughput_;
};

/// Memory for SampledLights.
class SampledLightBuffer {
 public:
  void resize(std::size_t size) {
    rays_.resize(size + max_width);
    ray_.resize(size + max_width);
    radiance_.resize(size + max_width);
  }
  [[nodiscard]] Ray shadow_ray(std::size_t k) const { return rays_.get(k); }
  void set_shadow_ray(std::size_t k, const Ray& ray) { rays_.set(k, ray); }
  /// A view with room for shadow rays and a size of 0.
  SampledLights view() { return {rays_.view(), ray_.data(), radiance_.view(), 0}; }

 private:
  RayBuffer rays_;
  AlignedArray<std::uint32_t> ray_;
  ColorBuffer radiance_;
};

/// Memory for GoingOn.
class GoingOnBuffer {
 public:
  void resize(std::size_t size) {
    rays_.resize(size + max_width);
    throughput_.resize(size + max_width);
    sample_.resize(size + max_width);
    density_.resize(size + max_width);
  }
  /// Sets ray i, which continues in the direction of a mirror or of refraction.
  void set(std::size_t i, const Ray& ray, const Color& throughput, std::uint32_t sample) {
    rays_.set(i, ray);
    throughput_.set(i, throughput);
    sample_[i] = sample;
    density_[i] = 0;
  }
  RayBuffer& rays() { return rays_; }
  /// A view that has room for rays behind the first `size`.
  GoingOn view(std::size_t size = 0) {
    return {rays_.view(), throughput_.view(), sample_.data(), density_.data(), size};
  }

 private:
  RayBuffer rays_;
  ColorBuffer throughput_;
  AlignedArray<std::uint32_t> sample_;
  AlignedArray<float> density_;
};

/// Memory for GivenLight.
class GivenLightBuffer {
 public:
  void resize(std::size_t size) {
    given_.resize(size);
    direction_.resize(size);
    density_.resize(size);
    radiance_.resize(size);
  }
  void set(std::size_t i, const Vec3d& direction, double density, const Color& radiance) {
    given_[i] = 1;
    direction_.set(i, direction);
    density_[i] = density;
    radiance_.set(i, radiance);
  }
  void set_none(std::size_t i) { given_[i] = 0; }
  GivenLight view() {
    return {given_.data(), direction_.view(), density_.data(), radiance_.view()};
  }

 private:
  AlignedArray<std::uint8_t> given_;
  VectorBuffer direction_;
  AlignedArray<double> density_;
  ColorBuffer radiance_;
};

}  // namespace boule
