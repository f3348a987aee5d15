#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/base/parallel.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/values.h"
#include "render/files/scene_file/npy/npy_colors.h"
#include "render/files/scene_file/toml/toml_color_map.h"

namespace boule::python {

/// The colours of primitives in arrays, as arguments give them: one for each, or numbers that a map
/// makes colours of.
class ArrayColors {
 public:
  /// Of `count` primitives. Throws Error.
  ArrayColors(const pybind11::object& colors, const std::string& color_space,
              const pybind11::object& scalar, const pybind11::object& map,
              const pybind11::object& range, std::size_t count);

  /// Refuses arguments that contradict each other.
  static void refuse_together(const pybind11::object& colors, const pybind11::object& scalar,
                              const pybind11::object& map, const pybind11::object& range);

  using Range = std::optional<std::array<double, 2>>;

  [[nodiscard]] bool any() const { return rgb_ || numbers_; }
  /// Colours them; the range of the map, if there is one. Without the GIL.
  Result<Range> color(const MaterialRows& materials, const ParallelFor& parallel_for) const;

 private:
  std::optional<Numbers> rgb_, numbers_;
  ColorSpace space_;
  ColorMapKeys keys_;
};

/// The materials of what is in arrays.
inline MaterialRows rows_of(SphereArrays& arrays) {
  return materials_of(std::span(arrays.spheres));
}
inline MaterialRows rows_of(CapsuleArrays& arrays) {
  return materials_of(std::span(arrays.capsules));
}

/// Arrays that make(parallel_for) makes without the GIL, in their colours, as Data; and the range
/// of their colour map, or None.
template <class Arrays, class Make>
pybind11::tuple of_arrays(const ArrayColors& colors, const Make& make) {
  using Made = std::pair<std::shared_ptr<Arrays>, ArrayColors::Range>;
  auto made = take(interruptible([=](Call& call) -> Result<Made> {
    const ParallelFor parallel_for = call.parallel_for();
    auto arrays = make(parallel_for);
    if (!arrays) return arrays.error();
    Made all{std::make_shared<Arrays>(std::move(arrays).value()), {}};
    Arrays& own = *all.first;
    own.has_colors = colors.any();
    auto range = colors.color(rows_of(own), parallel_for);
    if (!range) return range.error();
    all.second = range.value();
    return all;
  }));
  return pybind11::make_tuple(Data{std::shared_ptr<const Arrays>(made.first)}, made.second);
}

}  // namespace boule::python
