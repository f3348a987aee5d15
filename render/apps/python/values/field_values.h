#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/scene/field.h"
#include "render/apps/python/values/values.h"

namespace boule::python {

/// True for what stands in files or is the name of something.
template <class Rule>
inline constexpr bool is_left_out =
    std::is_same_v<Rule, FileRule> || std::is_same_v<Rule, MaterialRule> ||
    std::is_same_v<Rule, GroupRule>;

/// The values of a struct's fields as a dictionary, by the one list of fields. What is not set,
/// what stands in files, and what names materials or groups is left out.
class FieldValues {
 public:
  explicit FieldValues(const Vec3d& origin = {}) : origin_(origin) {}

  template <HasFields T>
  pybind11::dict of(const T& value) const {
    pybind11::dict values;
    add(values, value);
    return values;
  }

  /// The same for what a variant holds, with its `type`.
  template <class... Kinds>
  pybind11::dict of(const std::variant<Kinds...>& value) const {
    return std::visit(
        [this]<class Kind>(const Kind& kind) {
          pybind11::dict values;
          values["type"] = std::string(fields<Kind>.type);
          this->add(values, kind);
          return values;
        },
        value);
  }

 private:
  template <HasFields T>
  void add(pybind11::dict& values, const T& value) const {
    each_field(value, [&](const auto& field, const auto& member) {
      using Rule = std::remove_cvref_t<decltype(field.rule)>;
      if constexpr (!is_left_out<Rule>) {
        this->put(values, pybind11::str(std::string(field.key)), field.rule, member);
      }
    });
  }

  template <class Rule, class T>
  void put(pybind11::dict& values, const pybind11::str& key, const Rule&, const T& member) const {
    if constexpr (HasFields<T>) {
      add(values, member);
    } else if constexpr (std::is_enum_v<T>) {
      values[key] = std::string(name_of(member));
    } else if constexpr (std::is_same_v<T, bool>) {
      values[key] = pybind11::bool_(member);
    } else if constexpr (std::is_same_v<T, int>) {
      values[key] = pybind11::int_(member);
    } else {
      values[key] = to_python(member);
    }
  }
  template <class Rule, class Enum>
  requires std::is_enum_v<Enum>
  void put(pybind11::dict& values, const pybind11::str& key, const Rule&,
           const std::vector<Enum>& some) const {
    pybind11::list names;
    for (const Enum one : some) names.append(std::string(name_of(one)));
    values[key] = names;
  }
  template <class Rule, class T>
  void put(pybind11::dict& values, const pybind11::str& key, const Rule& rule,
           const std::optional<T>& member) const {
    if (member) put(values, key, rule, *member);
  }
  /// A point, counted from where the scene file counts it.
  void put(pybind11::dict& values, const pybind11::str& key, const PointRule&,
           const Vec3f& point) const {
    if (origin_ == Vec3d{}) {
      values[key] = to_python(point);
      return;
    }
    const Vec3d p = vec_cast<double>(point) + origin_;
    values[key] = pybind11::make_tuple(p.x, p.y, p.z);
  }
  void put(pybind11::dict& values, const pybind11::str& key, const WholeRule&,
           const Both<const int>& both) const {
    values[key] = pybind11::make_tuple(both.first, both.second);
  }
  Vec3d origin_;
};

}  // namespace boule::python
