#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/math/geometry.h"
#include "render/apps/python/scenes/array_rows.h"
#include "render/apps/python/values/array_colors.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/presence.h"
#include "render/files/scene_file/loaded/primitive_points.h"
#include "render/memory/available_memory.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// Ends and radii in arrays; what is one stands for all.
class CapsuleInput {
 public:
  CapsuleInput(const py::object& a, const py::object& b, const py::object& radius)
      : a_(a, "a", {.columns = 3, .takes_one = true}),
        b_(b, "b", {.rows = rows_of_other(a_), .columns = 3, .takes_one = true}),
        radius_(radius, "radius",
                {.rows = a_.is_one() ? rows_of_other(b_) : a_.rows(), .takes_one = true}) {
    for (const Numbers* numbers : {&a_, &b_, &radius_}) {
      if (!numbers->is_one()) rows_ = numbers->rows();
    }
  }

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] bool is_double() const { return a_.is_double() || b_.is_double(); }
  [[nodiscard]] Vec3d a(std::size_t row) const { return point_at(a_, row); }
  [[nodiscard]] Vec3d b(std::size_t row) const { return point_at(b_, row); }
  [[nodiscard]] double radius(std::size_t row) const { return radius_.at(row); }

 private:
  /// As many rows as an array has; any number, if it has one for all.
  static std::optional<std::size_t> rows_of_other(const Numbers& numbers) {
    return numbers.is_one() ? std::nullopt : std::optional(numbers.rows());
  }

  Numbers a_, b_, radius_;
  std::size_t rows_ = 1;
};

/// The capsules, checked. Ends of double precision are kept as they are. Without the GIL.
Result<CapsuleArrays> make_capsules(const CapsuleInput& input) {
  const std::size_t count = input.rows();
  const std::uint64_t exact = input.is_double() ? 2 * sizeof(Vec3d) : 0;
  if (auto done =
          check_memory(count * (sizeof(Capsule) + exact), std::to_string(count) + " capsules need");
      !done) {
    return done.error();
  }
  CapsuleArrays arrays;
  arrays.capsules.reserve(count);
  if (input.is_double()) arrays.ends.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d a = input.a(i), b = input.b(i);
    arrays.capsules.push_back({rounded(a), rounded(b), float32_or_inf(input.radius(i)), {}});
    if (!is_valid(arrays.capsules.back()))
      return explain_row(i, {{"a", a}, {"b", b}}, "radius", input.radius(i));
    if (input.is_double()) arrays.ends.insert(arrays.ends.end(), {a, b});
  }
  return arrays;
}

/// Capsules and their colours for a scene, and the range of their colour map, or None.
py::tuple capsules_of(const py::object& a, const py::object& b, const py::object& radius,
                      const py::object& colors, const std::string& color_space,
                      const py::object& scalar, const py::object& map, const py::object& range) {
  ArrayColors::refuse_together(colors, scalar, map, range);
  const CapsuleInput input(a, b, radius);
  const ArrayColors own(colors, color_space, scalar, map, range, input.rows());
  return of_arrays<CapsuleArrays>(own,
                                  [input](const ParallelFor&) { return make_capsules(input); });
}

const CapsuleArrays& arrays_in(const Data& data) {
  const auto* held = std::get_if<std::shared_ptr<const CapsuleArrays>>(&data.held);
  if (held == nullptr) throw_error("capsules", "expected capsules");
  return **held;
}

/// Capsules as they are held: views, where these have the numbers.
py::dict capsule_views(const py::object& data) {
  const CapsuleArrays& arrays = arrays_in(py::cast<const Data&>(data));
  const auto count = static_cast<py::ssize_t>(arrays.capsules.size());
  const auto view = [&](const auto* first, std::size_t step, py::ssize_t columns) {
    using Number = std::remove_cvref_t<decltype(*first)>;
    const auto bytes = static_cast<py::ssize_t>(step), number = py::ssize_t{sizeof(Number)};
    return columns == 1 ? view_of<Number>(first, {count}, {bytes}, data)
                        : view_of<Number>(first, {count, columns}, {bytes, number}, data);
  };
  static const Capsule none;
  const Capsule& first = count == 0 ? none : arrays.capsules.front();
  py::dict views;
  if (arrays.ends.empty()) {
    views["a"] = view(&first.a.x, sizeof(Capsule), 3);
    views["b"] = view(&first.b.x, sizeof(Capsule), 3);
  } else {
    views["a"] = view(&arrays.ends[0].x, 2 * sizeof(Vec3d), 3);
    views["b"] = view(&arrays.ends[1].x, 2 * sizeof(Vec3d), 3);
  }
  views["radius"] = view(&first.radius, sizeof(Capsule), 1);
  views["base"] = py::make_tuple(arrays.base.x, arrays.base.y, arrays.base.z);
  return views;
}

/// As those of spheres.
py::object capsule_colors(const Data& data) {
  const CapsuleArrays& arrays = arrays_in(data);
  if (!arrays.has_colors) return py::none();
  auto colors = empty_array<std::uint8_t>({static_cast<py::ssize_t>(arrays.capsules.size()), 3});
  std::uint8_t* next = colors.mutable_data();
  for (const Capsule& capsule : arrays.capsules) {
    const SrgbColor color = capsule.material.has_color() ? capsule.material.color() : SrgbColor{};
    for (const std::uint8_t code : {color.r, color.g, color.b}) *next++ = code;
  }
  return colors;
}

}  // namespace

void bind_capsule_arrays(py::module_& module) {
  module.def("capsules", &capsules_of, inside(), py::arg("a"), py::arg("b"), py::arg("radius"),
             py::arg("colors"), py::arg("color_space"), py::arg("scalar"), py::arg("map"),
             py::arg("range"));
  module.def("capsule_views", &capsule_views, inside(), py::arg("data"));
  module.def("capsule_colors", &capsule_colors, inside(), py::arg("data"));
}

}  // namespace boule::python
