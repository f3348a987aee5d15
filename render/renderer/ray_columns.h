#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

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

/// Rays in columns, in the layout of numpy. Origins are read as double; directions and the ends of
/// the interval are rounded to float once, and numbers beyond the range of float become infinite.
struct RayColumns {
  std::size_t size = 0;
  RayNumbers org{}, dir{};    ///< three components each
  RayNumbers tmin{}, tmax{};  ///< one component
  Vec3d zero{};               ///< subtracted from the origins
};

/// The output columns for hits: `size` numbers each, three of each normal.
struct HitColumns {
  double* t = nullptr;
  std::int32_t* id = nullptr;
  float* normal = nullptr;
};

}  // namespace boule
