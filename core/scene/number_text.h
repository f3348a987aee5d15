#pragma once

#include <array>
#include <charconv>
#include <string>

namespace boule {

/// A number for a message, with at most `digits` digits, and with a point in any locale. Throws
/// std::bad_alloc. Precondition: 1 <= digits <= 17.
inline std::string number_text(double value, int digits = 6) {
  std::array<char, 32> buffer{};
  char* const end = buffer.data() + buffer.size();
  return {buffer.data(),
          std::to_chars(buffer.data(), end, value, std::chars_format::general, digits).ptr};
}

}  // namespace boule
