#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/scene/kinds.h"
#include "core/scene/names.h"
#include "core/scene/primitive.h"

namespace boule {

/// What the numbers of colours are: sRGB codes or linear values, both from 0 to 1; bytes are sRGB
/// codes from 0 to 255.
enum class ColorSpace { srgb, linear };
template <>
inline constexpr std::array<std::string_view, 2> names<ColorSpace>{"srgb", "linear"};

/// The 8-bit sRGB code of a component of a colour, if it is from 0 to 1.
std::optional<std::uint8_t> color_code(double component, ColorSpace space);

/// The materials of primitives, by row.
struct MaterialRows {
  std::size_t count;
  std::function<MaterialRef&(std::size_t row)> at;
  const char* of_each = "sphere";
};
template <class Primitive>
MaterialRows materials_of(std::span<Primitive> primitives) {
  return {primitives.size(),
          [primitives](std::size_t row) -> MaterialRef& { return primitives[row].material; },
          PrimitiveKind<Primitive>::name};
}

/// Gives each primitive the colour in its row of a .npy file, N x 3 of float32, float64 or uint8;
/// they keep their material, whose index is below MaterialRef::max_colored. A bad row is named by
/// its number, from 0 ("row 17"). On an error some may have their colour already.
Status color_by_npy(const std::string& path, ColorSpace space, const MaterialRows& materials);

/// The numbers of a .npy file, one for each of `count` primitives: floats, integers or bytes, N or
/// N x 1. All are finite.
Result<std::vector<double>> read_npy_scalars(const std::string& path, std::size_t count,
                                             const char* of_each = "sphere");

}  // namespace boule
