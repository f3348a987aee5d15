#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/renderer/ray_columns.h"

namespace boule::python {

/// Numbers that an argument holds, read where numpy has them: arrays of float32 or float64 of any
/// strides are not copied; lists and whole numbers are, once, as float64.
class Numbers {
 public:
  /// Which shapes are taken, of the dimensions (rows, columns).
  struct Shape {
    std::optional<std::size_t> rows{};  ///< none: any number of them
    std::size_t columns = 1;            ///< 1: an array of one dimension, or N x 1
    bool takes_one = false;             ///< one row stands for all of them
    bool takes_bytes = false;           ///< uint8 stay what they are
  };

  /// Throws Error, with what was expected and what came, for another shape or type. `name` is the
  /// argument's.
  Numbers(const pybind11::object& argument, const std::string& name, const Shape& shape);

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] bool is_bytes() const { return is_bytes_; }
  /// One value was given for all rows.
  [[nodiscard]] bool is_one() const { return is_one_; }
  [[nodiscard]] bool is_double() const { return column_.is_double; }
  /// The numbers, of floats; valid as long as owner() is.
  [[nodiscard]] const RayNumbers& column() const { return column_; }
  [[nodiscard]] double at(std::size_t row, std::size_t component = 0) const {
    if (!is_bytes_) return column_.at(row, component);
    return static_cast<double>(*(column_.first +
                                 static_cast<std::ptrdiff_t>(row) * column_.ray_step +
                                 static_cast<std::ptrdiff_t>(component) * column_.component_step));
  }
  /// Keeps the numbers alive; see keep().
  [[nodiscard]] const std::shared_ptr<const pybind11::object>& owner() const { return owner_; }

 private:
  void point_to(const pybind11::array& array, const std::string& name, const Shape& shape);

  std::shared_ptr<const pybind11::object> owner_;
  RayNumbers column_;
  std::size_t rows_ = 0;
  bool is_bytes_ = false;
  bool is_one_ = false;
};

/// Whether the argument is an array of numpy.ma.
bool is_masked(const pybind11::object& argument);

/// An Error about an array of numpy.ma that masks something: any other array of it would show what
/// is masked.
void refuse_masked(const pybind11::object& argument, const std::string& name);

/// The argument as an array of whatever numpy makes of it; an Error if that is none, or masked.
pybind11::array to_array(const pybind11::object& argument, const std::string& name);

/// "float32 of shape (5, 3)".
std::string describe(const pybind11::array& array);

/// The arrays of numpy 2 lie otherwise in memory, which pybind11 knows from 2.12 on.
inline constexpr int numpy_below = PYBIND11_VERSION_HEX < 0x020C0000 ? 2 : 3;

/// Loads numpy; an ImportError if it is not below that version. pybind11 loads it otherwise, inside
/// the lock of a static variable: of two threads that make their first arrays, one would wait for
/// that lock, the other for the GIL.
pybind11::module_ need_numpy();

/// An array without initial values. Throws MemoryError.
template <class Number>
pybind11::array_t<Number> empty_array(std::vector<pybind11::ssize_t> shape) {
  need_numpy();
  return pybind11::array_t<Number>(std::move(shape));
}

/// A writable array over memory that `owner` has. `Shown` is the type that Python sees.
template <class Shown, class Owner>
pybind11::array array_in(Shown* data, std::vector<pybind11::ssize_t> shape,
                         const std::shared_ptr<Owner>& owner) {
  need_numpy();
  const pybind11::capsule kept(new std::shared_ptr<Owner>(owner), [](void* pointer) {
    delete static_cast<std::shared_ptr<Owner>*>(pointer);
  });
  return pybind11::array(pybind11::dtype::of<Shown>(), std::move(shape), {}, data, kept);
}

/// A read-only array over memory that `owner` keeps.
template <class Number>
pybind11::array view_of(const Number* data, std::vector<pybind11::ssize_t> shape,
                        std::vector<pybind11::ssize_t> strides, const pybind11::handle& owner) {
  need_numpy();
  pybind11::array view(pybind11::dtype::of<Number>(), std::move(shape), std::move(strides), data,
                       owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace boule::python
