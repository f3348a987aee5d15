#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/presence.h"
#include "render/apps/python/values/values.h"
#include "render/files/scene_file/toml/lens_file.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// A picture of H x W pixels with so many numbers each, of which the first three count.
Data picture_of(const py::object& argument, const std::string& name, int components) {
  const py::array array = to_array(argument, name);
  const bool is_picture = array.ndim() == 3 && array.shape(2) == components;
  const bool is_small = is_picture && array.shape(0) <= max_image_side &&
                        array.shape(1) <= max_image_side && array.size() > 0;
  if (!is_small) {
    throw_error(name, "expected float32 or float64 of shape (H, W, " + std::to_string(components) +
                          "), sides from 1 to " + std::to_string(max_image_side) + ", got " +
                          describe(array));
  }
  const auto rows = static_cast<std::size_t>(array.shape(0) * array.shape(1));
  const py::object flat = array.attr("reshape")(rows, components);
  const Numbers numbers(flat, name,
                        {.rows = rows, .columns = static_cast<std::size_t>(components)});
  auto image =
      std::make_shared<Image>(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  for (std::size_t i = 0; i < rows; ++i) {
    const auto at = [&](std::size_t k) { return static_cast<float>(numbers.at(i, k)); };
    image->pixels[i] = {at(0), at(1), components > 2 ? at(2) : 0};
  }
  return Data{std::shared_ptr<const Image>(image)};
}

/// A lens prescription: N surfaces of radius, thickness, index, aperture.
Data lens_of(const py::object& argument) {
  const Numbers numbers(argument, "surfaces", {.columns = 4});
  auto surfaces = std::make_shared<std::vector<LensSurface>>(numbers.rows());
  for (std::size_t i = 0; i < numbers.rows(); ++i) {
    const auto at = [&](std::size_t k) { return static_cast<float>(numbers.at(i, k)); };
    (*surfaces)[i] = {at(0), at(1), air_if_none(at(2)), at(3)};
  }
  return Data{std::shared_ptr<const std::vector<LensSurface>>(surfaces)};
}

/// The numbers of a picture, H x W x `components`, or of a lens, N x 4: a view.
py::array array_of(const py::object& data, int components) {
  const Data& known = py::cast<const Data&>(data);
  constexpr auto number = static_cast<py::ssize_t>(sizeof(float));
  if (const auto* picture = std::get_if<std::shared_ptr<const Image>>(&known.held)) {
    const Image& image = **picture;
    constexpr auto step = static_cast<py::ssize_t>(sizeof(Color));
    const py::ssize_t most = step / number;
    if (components < 1 || components > most) throw_error("components", "must be 1 to 3");
    return view_of<float>(&image.pixels.front().r, {image.height, image.width, components},
                          {step * image.width, step, number}, data);
  }
  using Surfaces = std::shared_ptr<const std::vector<LensSurface>>;
  const auto* lens = std::get_if<Surfaces>(&known.held);
  if (lens == nullptr) throw_error("data", "expected a picture or a lens");
  const std::vector<LensSurface>& surfaces = **lens;
  const float* const first = surfaces.empty() ? nullptr : &surfaces.front().radius;
  return view_of<float>(first, {static_cast<py::ssize_t>(surfaces.size()), 4},
                        {static_cast<py::ssize_t>(sizeof(LensSurface)), number}, data);
}

/// Spheres as they are held: views, where these have the numbers.
py::dict sphere_views(const py::object& data) {
  const auto* held =
      std::get_if<std::shared_ptr<const SphereArrays>>(&py::cast<const Data&>(data).held);
  if (held == nullptr) throw_error("spheres", "expected spheres");
  const SphereArrays& arrays = **held;
  const auto count = static_cast<py::ssize_t>(arrays.spheres.size());
  constexpr auto step = static_cast<py::ssize_t>(sizeof(Sphere));
  constexpr auto number = static_cast<py::ssize_t>(sizeof(float));
  const Sphere* const first = arrays.spheres.data();
  py::dict views;
  const float* const center = first == nullptr ? nullptr : &first->center.x;
  const float* const radius = first == nullptr ? nullptr : &first->radius;
  views["centers"] = arrays.centers.empty()
                         ? view_of<float>(center, {count, 3}, {step, number}, data)
                         : view_of<double>(&arrays.centers.front().x, {count, 3},
                                           {static_cast<py::ssize_t>(sizeof(Vec3d)),
                                            static_cast<py::ssize_t>(sizeof(double))},
                                           data);
  views["radii"] = view_of<float>(radius, {count}, {step}, data);
  views["base"] = py::make_tuple(arrays.base.x, arrays.base.y, arrays.base.z);
  return views;
}

/// The colours that spheres have of their own, N x 3 of uint8 (black where they have none), or
/// None.
py::object sphere_colors(const Data& data) {
  const auto* held = std::get_if<std::shared_ptr<const SphereArrays>>(&data.held);
  if (held == nullptr) throw_error("spheres", "expected spheres");
  if (!(*held)->has_colors) return py::none();
  const std::vector<Sphere>& spheres = (*held)->spheres;
  auto colors = empty_array<std::uint8_t>({static_cast<py::ssize_t>(spheres.size()), 3});
  std::uint8_t* next = colors.mutable_data();
  for (const Sphere& sphere : spheres) {
    const SrgbColor color = sphere.material.has_color() ? sphere.material.color() : SrgbColor{};
    for (const std::uint8_t code : {color.r, color.g, color.b}) *next++ = code;
  }
  return colors;
}

}  // namespace

void bind_data(py::module_& module) {
  module.def("picture", &picture_of, inside(), py::arg("pixels"), py::arg("name"),
             py::arg("components"));
  module.def("lens", &lens_of, inside(), py::arg("surfaces"));
  module.def("array_of", &array_of, inside(), py::arg("data"), py::arg("components"));
  module.def("sphere_views", &sphere_views, inside(), py::arg("data"));
  module.def("sphere_colors", &sphere_colors, inside(), py::arg("data"));
}

}  // namespace boule::python
