#pragma once

#include <optional>
#include <vector>

#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// An ST map gives, for each point of a picture, the point of the film that is seen there: it gives
/// any camera the distortions of a lens. Its pixels span the whole frame, whatever the sizes of
/// both. Between the pixels' centres the numbers are bilinear; beyond the outermost centres the
/// same bilinear functions continue.
struct DistortionMap {
  int width = 0, height = 0;  ///< >= 2
  /// s and t of each pixel, row 0 on top: s runs from 0 at the left edge of the film to 1 at the
  /// right, t from 0 at the bottom to 1 at the top. Finite; numbers outside of 0..1 are points
  /// beyond the film's edges, which cameras see as well.
  std::vector<float> st{};
};

template <>
inline constexpr auto fields<DistortionMap> = field_list(
    "distortion", field("size", &DistortionMap::width, &DistortionMap::height, rule::from_file),
    field("file", &DistortionMap::st, rule::from_file));

/// The first Problem of a map: fewer than 2 x 2 pixels, a wrong number of values (two per pixel),
/// or a value that is not finite.
std::optional<Problem> find_problem(const DistortionMap& map);

}  // namespace boule
