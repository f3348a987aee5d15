#pragma once

#include "core/base/platform.h"

namespace boule {

/// Linear RGB in float, unbounded above (lecture "Color": HDR, which a tone curve turns into LDR).
/// Components may be any numbers, as in Vec3.
struct Color {
  float r = 0, g = 0, b = 0;
};

inline Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Color operator*(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Color operator*(const Color& a, float s) { return {a.r * s, a.g * s, a.b * s}; }
inline bool operator==(const Color& a, const Color& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

/// The sum of the components.
inline double component_sum(const Color& c) { return double{c.r} + double{c.g} + double{c.b}; }

inline Color gray(float value) { return {value, value, value}; }
inline bool is_black(const Color& c) { return c.r == 0 && c.g == 0 && c.b == 0; }

}  // namespace boule
