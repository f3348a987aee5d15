#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace boule {

/// The names of an enum's values in scene files and options, in the order of the values, which
/// count from 0. Each enum of the scene specialises it beside its definition.
template <class Enum>
inline constexpr std::array<std::string_view, 0> names{};

/// True if the value is one of its enum's enumerators: the compiler prints other values as numbers.
template <auto value>
constexpr bool is_enumerator() {
  const std::string_view signature = __PRETTY_FUNCTION__;
  return signature[signature.find("value = ") + 8] != '(';
}

/// True if an enum has as many names as enumerators.
template <class Enum>
inline constexpr bool names_every_enumerator = [] {
  constexpr std::size_t count = names<Enum>.size();
  if constexpr (count == 0) {
    return false;
  } else {
    return is_enumerator<static_cast<Enum>(count - 1)>() &&
           !is_enumerator<static_cast<Enum>(count)>();
  }
}();

/// The name of an enum's value; for other numbers, the first name.
template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::string_view name_of(Enum value) {
  static_assert(names_every_enumerator<Enum>, "an enumerator has no name");
  const auto index = static_cast<std::size_t>(value);
  return names<Enum>[index < names<Enum>.size() ? index : 0];
}

}  // namespace boule
