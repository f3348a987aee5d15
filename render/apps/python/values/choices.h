#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/names.h"
#include "render/apps/python/values/errors.h"
#include "render/files/file/nearest_name.h"

namespace boule::python {

/// The enumerator of a name; an Error about the argument if there is none.
template <class Enum, std::size_t n>
Enum choose(const std::string& name, const char* argument,
            const std::array<std::string_view, n>& known) {
  for (std::size_t i = 0; i < n; ++i) {
    if (name == known[i]) return static_cast<Enum>(i);
  }
  const std::vector<std::string_view> all(known.begin(), known.end());
  throw_error(argument, "unknown name " + quote(name) + ", expected " + list_names(all) +
                            did_you_mean(name, all));
}

template <class Enum>
Enum choose(const std::string& name, const char* argument) {
  static_assert(names_every_enumerator<Enum>, "an enumerator has no name");
  return choose<Enum>(name, argument, names<Enum>);
}

}  // namespace boule::python
