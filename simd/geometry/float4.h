#pragma once

#include <cstdint>
#include <cstring>

namespace boule {

/// Four floats, and four integers, in a register of the base CPU: GCC and Clang do arithmetic on
/// these types on every machine. GCC 12 makes no such code of short loops by itself.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 load4(const float (&from)[4]) {
  Float4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return b < a ? a : b; }

/// Toward zero.
inline Int4 truncate4(Float4 a) { return __builtin_convertvector(a, Int4); }

}  // namespace boule
