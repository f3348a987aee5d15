#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>

#include "render/apps/python/values/arrays.h"
#include "render/renderer/ray_columns.h"

namespace boule::python {

/// The arrays of rays, as Python gives them: a dict with org, dir, tmin, tmax, source and inside.
class RayInput {
 public:
  /// Throws Error, with the name of the array, unless all have the shapes of rays.
  explicit RayInput(const pybind11::dict& given);

  /// One origin may stand for all rays, and one direction.
  [[nodiscard]] std::size_t count() const { return org_.is_one() ? dir_.rows() : org_.rows(); }
  /// The rays, counted from `zero`; valid as long as this.
  [[nodiscard]] RayColumns columns(const Vec3d& zero) const;

 private:
  [[nodiscard]] Numbers::Shape dir_shape() const;
  [[nodiscard]] Numbers::Shape each() const { return {.rows = count(), .takes_one = true}; }

  Numbers org_, dir_, tmin_, tmax_, source_, inside_;
};

}  // namespace boule::python
