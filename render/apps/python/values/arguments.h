#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "core/scene/rule.h"
#include "render/apps/python/values/choices.h"

namespace boule::python {

/// The arguments of a call by their names. What is None counts as not given; everything that is
/// wrong is an Error with the argument's name as its key.
class Arguments {
 public:
  explicit Arguments(const pybind11::dict& given) : given_(given) {}

  [[nodiscard]] std::optional<pybind11::object> find(const char* name) const;
  [[nodiscard]] std::optional<int> whole(const char* name, const WholeRule& rule) const;
  [[nodiscard]] std::optional<double> number(const char* name, const NumberRule& rule) const;
  [[nodiscard]] std::optional<std::string> text(const char* name) const;
  [[nodiscard]] bool flag(const char* name) const;

  template <class Enum>
  [[nodiscard]] std::optional<Enum> choice(const char* name) const {
    const auto chosen = text(name);
    if (!chosen) return std::nullopt;
    return choose<Enum>(*chosen, name);
  }

 private:
  const pybind11::dict& given_;
};

/// The name of an instruction set under "isa", which this build and this machine have.
std::optional<std::string> isa_of(const Arguments& given);

}  // namespace boule::python
