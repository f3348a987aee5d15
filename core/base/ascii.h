#pragma once

namespace boule {

/// An ASCII capital as its small letter, any other character as it is. Independent of the locale.
constexpr char ascii_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace boule
