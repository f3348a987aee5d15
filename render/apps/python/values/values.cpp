#include "render/apps/python/values/values.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "render/apps/python/values/errors.h"

namespace py = pybind11;

namespace boule::python {
namespace {

constexpr int deepest = 32;
constexpr py::ssize_t longest = 1'000'000;  // of a list in a table

std::string inner_path(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::int64_t to_integer(const py::handle& object, const std::string& path) {
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(object.ptr(), &overflow);
  if (overflow != 0) throw_error(path, "is too large a number");
  if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  return number;
}

struct Depth {
  explicit Depth(int& depth) : depth_(depth) { ++depth_; }
  ~Depth() { --depth_; }
  Depth(const Depth&) = delete;
  Depth& operator=(const Depth&) = delete;

 private:
  int& depth_;
};

}  // namespace

std::string to_text(const py::handle& object, const std::string& path) {
  py::ssize_t size = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(object.ptr(), &size);
  if (bytes != nullptr) return {bytes, static_cast<std::size_t>(size)};
  PyErr_Clear();
  throw_error(path, "is text that is not UTF-8");
}

TomlMembers TreeBuilder::members(const py::dict& table, const std::string& path) {
  const Depth depth(depth_);
  if (depth_ > deepest) throw_error(path, "is nested too deep");
  TomlMembers members;
  for (const auto& [key, object] : table) {
    if (object.is_none()) continue;
    if (key.is_none() && py::isinstance<py::list>(object)) {
      add_in_order(object, path, members);
      continue;
    }
    if (!py::isinstance<py::str>(key))
      throw_error(path, "keys must be text, got " + type_name(key));
    std::string name = to_text(key, path);
    const TextPlace place = next_place();
    TomlValue one = value(object, inner_path(path, name));
    members.push_back({std::move(name), place, std::move(one)});
  }
  return members;
}

void TreeBuilder::add_in_order(const py::handle& pairs, const std::string& path,
                               TomlMembers& members) {
  for (const py::handle pair : pairs) {
    if (!py::isinstance<py::tuple>(pair) || py::len(pair) != 2) throw_error(path, "expected pairs");
    const auto both = py::reinterpret_borrow<py::tuple>(pair);
    const std::string key = to_text(both[0], path);
    auto known = std::find_if(members.begin(), members.end(),
                              [&](const TomlMember& member) { return member.key == key; });
    if (known == members.end()) {
      const TextPlace place = next_place();
      members.push_back({key, place, {place, TomlArray{}}});
      known = members.end() - 1;
    }
    auto& tables = std::get<TomlArray>(known->value.data);
    tables.push_back(value(both[1], inner_path(path, key)));
  }
}

TomlArray TreeBuilder::elements(const py::handle& sequence, const std::string& path) {
  const Depth depth(depth_);
  if (depth_ > deepest) throw_error(path, "is nested too deep");
  const auto size = static_cast<py::ssize_t>(py::len(sequence));
  if (size > longest)
    throw_error(path, "has " + std::to_string(size) + " elements, too many for a key");
  TomlArray elements;
  for (const py::handle element : sequence) elements.push_back(value(element, path));
  return elements;
}

/// An array or a number of numpy.
TomlValue TreeBuilder::of_array(const py::handle& array, const std::string& path) {
  const auto size = py::cast<py::ssize_t>(array.attr("size"));
  if (size > longest)
    throw_error(path, "has " + std::to_string(size) + " elements, too many for a key");
  return value(py::object(array.attr("tolist")()), path);
}

TomlValue TreeBuilder::value(const py::handle& object, const std::string& path) {
  const TextPlace place = next_place();
  if (py::isinstance<py::bool_>(object)) return {place, py::cast<bool>(object)};
  if (py::isinstance<py::int_>(object)) return {place, to_integer(object, path)};
  if (py::isinstance<py::float_>(object)) return {place, PyFloat_AsDouble(object.ptr())};
  if (py::isinstance<py::str>(object)) return {place, to_text(object, path)};
  if (py::isinstance<Data>(object)) return {place, add(py::cast<const Data&>(object))};
  if (py::isinstance<py::dict>(object)) {
    return {place, members(py::reinterpret_borrow<py::dict>(object), path)};
  }
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
    return {place, elements(object, path)};
  }
  if (py::hasattr(object, "tolist") && py::hasattr(object, "size")) {
    const Depth depth(depth_);
    if (depth_ > deepest) throw_error(path, "is nested too deep");
    return of_array(object, path);
  }
  throw_error(path,
              "expected a number, text, a sequence or a dictionary, got " + type_name(object));
}

std::string TreeBuilder::add(const Data& data) {
  std::string name = "array " + std::to_string(next_place().line);
  if (const auto* spheres = std::get_if<0>(&data.held)) data_.spheres.emplace(name, *spheres);
  if (const auto* particles = std::get_if<1>(&data.held)) data_.particles.emplace(name, *particles);
  if (const auto* picture = std::get_if<2>(&data.held)) data_.pictures.emplace(name, *picture);
  if (const auto* lens = std::get_if<3>(&data.held)) data_.lenses.emplace(name, *lens);
  if (const auto* capsules = std::get_if<4>(&data.held)) data_.capsules.emplace(name, *capsules);
  return name;
}

py::dict to_python(const TomlMembers& members) {
  py::dict table;
  for (const TomlMember& member : members) table[py::str(member.key)] = to_python(member.value);
  return table;
}

py::object to_python(const TomlValue& value) {
  if (const auto* flag = std::get_if<bool>(&value.data)) return py::bool_(*flag);
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) return py::int_(*integer);
  if (const auto* number = std::get_if<double>(&value.data)) return py::float_(*number);
  if (const auto* text = std::get_if<std::string>(&value.data)) return py::str(*text);
  if (const auto* members = std::get_if<TomlMembers>(&value.data)) return to_python(*members);
  if (const auto* array = std::get_if<TomlArray>(&value.data)) {
    py::tuple elements(array->size());
    for (std::size_t i = 0; i < array->size(); ++i) elements[i] = to_python((*array)[i]);
    return elements;
  }
  return py::none();
}

py::object to_python(float number) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  double shortest = double{number};
  std::from_chars(text, end, shortest);
  return py::float_(shortest);
}

py::object to_python(const Vec3f& v) {
  return py::make_tuple(to_python(v.x), to_python(v.y), to_python(v.z));
}

py::object to_python(const Color& c) {
  return py::make_tuple(to_python(c.r), to_python(c.g), to_python(c.b));
}

}  // namespace boule::python
