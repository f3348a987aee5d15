#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>

#include "core/math/vec.h"
#include "core/scene/number_text.h"
#include "render/apps/python/values/arrays.h"
#include "render/files/file/float32.h"

namespace boule::python {

/// A row of an array of points.
inline Vec3d point_at(const Numbers& points, std::size_t row) {
  return {points.at(row, 0), points.at(row, 1), points.at(row, 2)};
}

inline Vec3f rounded(const Vec3d& v) {
  return {float32_or_inf(v.x), float32_or_inf(v.y), float32_or_inf(v.z)};
}

/// Why a row is no sphere or capsule: the first of its points, by their arguments, that cannot be
/// float32, else its radius.
inline Diagnostic explain_row(std::size_t row,
                              std::initializer_list<std::pair<const char*, Vec3d>> points,
                              const char* radius_name, double radius) {
  const auto about = [row](const char* argument, const std::string& message) {
    return Diagnostic::about(argument, "row " + std::to_string(row) + ": " + message);
  };
  for (const auto& [name, point] : points) {
    for (const double x : {point.x, point.y, point.z}) {
      if (!std::isfinite(x)) return about(name, "must be finite, is " + number_text(x));
      if (!to_float32(x)) return about(name, "is too large for a 32-bit float");
    }
  }
  const std::string text = number_text(radius);
  if (!std::isfinite(radius)) return about(radius_name, "must be finite, is " + text);
  if (!to_float32(radius)) return about(radius_name, "is too large for a 32-bit float");
  if (radius > 0) return about(radius_name, "is too small for a 32-bit float: " + text);
  return about(radius_name, "must be above 0, is " + text);
}

}  // namespace boule::python
