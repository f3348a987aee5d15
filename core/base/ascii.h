#pragma once

#include <string>
#include <string_view>

namespace boule {

/// An ASCII capital as its small letter; any other character unchanged. Independent of the locale.
constexpr char ascii_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// A text in small letters.
inline std::string ascii_lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = ascii_lower(c);
  return small;
}

}  // namespace boule
