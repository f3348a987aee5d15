#include "render/apps/python/values/array_colors.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/scene/number_text.h"
#include "render/apps/python/values/choices.h"
#include "render/apps/python/values/errors.h"
#include "render/files/particles/colors/percentiles.h"

namespace py = pybind11;

namespace boule::python {
namespace {

Status color_rows(const Numbers& colors, ColorSpace space, const MaterialRows& materials) {
  if (colors.is_bytes() && space == ColorSpace::linear) {
    return Diagnostic::about("colors",
                             "are uint8, which are sRGB codes: linear colours must be floats");
  }
  for (std::size_t i = 0; i < materials.count; ++i) {
    std::array<std::uint8_t, 3> codes{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double component = colors.at(i, k);
      const auto code = color_code(colors.is_bytes() ? component / 255 : component, space);
      if (!code) {
        return Diagnostic::about(
            "colors",
            "row " + std::to_string(i) + ": must be from 0 to 1, is " + number_text(component));
      }
      codes[k] = *code;
    }
    materials.at(i) = MaterialRef::colored(0, {codes[0], codes[1], codes[2]});
  }
  return {};
}

/// Colours by a map of one number for each; the range that was chosen.
Result<std::array<double, 2>> map_rows(const Numbers& scalar, const ColorMapKeys& keys,
                                       const MaterialRows& materials,
                                       const ParallelFor& parallel_for) {
  std::vector<double> numbers(scalar.rows());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = scalar.at(i);
    if (std::isfinite(numbers[i])) continue;
    return Diagnostic::about(
        "scalar", "row " + std::to_string(i) + ": must be finite, is " + number_text(numbers[i]));
  }
  std::array<double, 2> range{0, 1};
  if (keys.range) range = *keys.range;
  if (!keys.range && !numbers.empty()) {
    range = percentiles(ParticleNumbers(numbers.data(), 1), numbers.size(), parallel_for);
  }
  const RangePlace place(range);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    materials.at(i) = MaterialRef::colored(0, keys.map.color(place(numbers[i])));
  return range;
}

ColorMapKeys read_map(const py::object& map, const py::object& range) {
  py::dict keys;
  keys["map"] = map;
  keys["range"] = range;
  TreeBuilder builder;
  const TomlMembers members = builder.members(keys, "");
  FirstError error("");
  TomlTable table(members, {}, "", error);
  ColorMapKeys read = read_color_map(table);
  check(error.status());
  return read;
}

}  // namespace

void ArrayColors::refuse_together(const py::object& colors, const py::object& scalar,
                                  const py::object& map, const py::object& range) {
  if (!colors.is_none() && !scalar.is_none()) throw_error("scalar", "cannot stand beside 'colors'");
  if (scalar.is_none() && !(map.is_none() && range.is_none())) {
    throw_error(map.is_none() ? "range" : "map", "goes with 'scalar', which is missing");
  }
}

ArrayColors::ArrayColors(const py::object& colors, const std::string& color_space,
                         const py::object& scalar, const py::object& map, const py::object& range,
                         std::size_t count) {
  if (!colors.is_none()) {
    rgb_.emplace(colors, "colors",
                 Numbers::Shape{.rows = count, .columns = 3, .takes_bytes = true});
  }
  if (!scalar.is_none()) numbers_.emplace(scalar, "scalar", Numbers::Shape{.rows = count});
  space_ = choose<ColorSpace>(color_space, "color_space");
  keys_ = read_map(map, range);
}

Result<ArrayColors::Range> ArrayColors::color(const MaterialRows& materials,
                                              const ParallelFor& parallel_for) const {
  if (rgb_) {
    if (auto done = color_rows(*rgb_, space_, materials); !done) return done.error();
  }
  if (!numbers_) return Range{};
  auto chosen = map_rows(*numbers_, keys_, materials, parallel_for);
  if (!chosen) return chosen.error();
  return Range{chosen.value()};
}

}  // namespace boule::python
