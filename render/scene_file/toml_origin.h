#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "render/scene_file/toml_table.h"

namespace boule {

/// The box around the centres of spheres, and the smallest of their radii.
struct SphereExtent {
  Vec3d low{}, high{};
  double radius = std::numeric_limits<double>::infinity();  ///< infinite: there are no spheres
};

/// What floats may be too coarse for: the spheres of double precision that a scene has.
struct ExactSpheres {
  std::vector<SphereExtent> extents;   ///< one for each file or array of them
  std::optional<Vec3d> cell_middle{};  ///< of the cell, if all share one
};

/// The point that `origin = "auto"` stands for: 0, if rounding moves no centre that is counted from
/// there by more than 2^-16 of the smallest radius, which a picture of 65535 pixels could show.
/// Else the point with the fewest decimal digits near the middle of the spheres (that of their
/// cell, or of the box around their centres) from where this holds. Else a point near the middle,
/// if it makes the rounding eight times smaller than 0 does. Else 0.
Vec3d choose_origin(const ExactSpheres& spheres);

/// Reads the key `origin` of a scene: "auto", which is the default, or a point. What was chosen
/// automatically, if it is not 0, is told in a note. Errors are reported through the table.
Vec3d read_origin(TomlTable& root, const ExactSpheres& spheres, std::vector<std::string>& notes);

}  // namespace boule
