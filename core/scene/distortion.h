#pragma once

#include <optional>
#include <vector>

#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// An ST map: says for the points of a picture where on the film they are seen, so that any camera
/// gets the distortions of a lens. Its pixels span the whole frame whatever the size of either;
/// between their centres the numbers are bilinear, and so they go on at the rim.
struct DistortionMap {
  int width = 0, height = 0;  ///< >= 2
  /// s and t of each pixel, row 0 on top: s from 0 on the left to 1 on the right edge of the film,
  /// t from 0 at the bottom to 1 at the top. Finite; may lie outside, where cameras see on.
  std::vector<float> st;
};

template <>
inline constexpr auto fields<DistortionMap> = field_list(
    "distortion", field("size", &DistortionMap::width, &DistortionMap::height, rule::from_file),
    field("file", &DistortionMap::st, rule::from_file));

/// The first Problem of a map: fewer than 2 x 2 pixels, not two numbers for each, any not finite.
std::optional<Problem> find_problem(const DistortionMap& map);

}  // namespace boule
