#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/math/ray.h"
#include "core/math/vec.h"

namespace boule {

/// Numbers of rays in a caller's memory, float or double in the byte order of the machine.
/// Component i of ray k is at first + k * ray_step + i * component_step, at any alignment. Steps
/// are in bytes and may be negative; a ray step of 0 is one value for all rays.
struct RayNumbers {
  const unsigned char* first = nullptr;
  std::ptrdiff_t ray_step = 0;
  std::ptrdiff_t component_step = 0;
  bool is_double = false;

  [[nodiscard]] double at(std::size_t ray, std::size_t component = 0) const {
    const unsigned char* const bytes = first + static_cast<std::ptrdiff_t>(ray) * ray_step +
                                       static_cast<std::ptrdiff_t>(component) * component_step;
    return is_double ? number<double>(bytes) : double{number<float>(bytes)};
  }

 private:
  template <class Number>
  static Number number(const unsigned char* bytes) {
    Number value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
};

/// Rays in columns, in the layout of numpy. Origins and the ends of the interval are read as
/// double; directions are rounded to float once, and numbers beyond the range of float become
/// infinite.
struct RayColumns {
  std::size_t size = 0;
  RayNumbers org{}, dir{};    ///< three components each
  RayNumbers tmin{}, tmax{};  ///< one component
  Vec3d zero{};               ///< subtracted from the origins
  RayNumbers source{};        ///< one component: an id, or no_primitive; `first` null: all of these
  RayNumbers inside{};        ///< one component: 0, or the ray is inside; `first` null: all are 0

  [[nodiscard]] Ray at(std::size_t ray) const;
};

/// Rays that a Tracer reads: a list, or columns. A view.
class RayView {
 public:
  RayView(std::span<const Ray> rays) : rays_(rays) {}
  RayView(const std::vector<Ray>& rays) : rays_(rays) {}
  RayView(const RayColumns& columns) : columns_(&columns) {}

  [[nodiscard]] std::size_t size() const {
    return columns_ != nullptr ? columns_->size : rays_.size();
  }
  [[nodiscard]] Ray at(std::size_t ray) const {
    return columns_ != nullptr ? columns_->at(ray) : rays_[ray];
  }
  /// Null for a list.
  [[nodiscard]] const RayColumns* columns() const { return columns_; }

 private:
  std::span<const Ray> rays_;
  const RayColumns* columns_ = nullptr;
};

/// The output columns for hits: `size` numbers each, three of each normal.
struct HitColumns {
  double* t = nullptr;
  std::int32_t* id = nullptr;
  float* normal = nullptr;
  std::uint8_t* entering = nullptr;  ///< 1 or 0
};

}  // namespace boule
