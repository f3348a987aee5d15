#pragma once

#include <optional>

#include "core/math/vec.h"
#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// A plane that cuts spheres and capsules: of each, the part behind it is left, with a flat cap.
/// Planes of the scene are not cut. Pictures show the cut; Tracer does not know of it.
struct Clip {
  Vec3f point{};
  Vec3f normal{0, 1, 0};  ///< to what is cut off, of any length but 0
};

template <>
inline constexpr auto fields<Clip> = field_list("clip", field("point", &Clip::point, rule::point),
                                                field("normal", &Clip::normal, rule::direction));

/// The first Problem of a clip plane: a field against its rule.
std::optional<Problem> find_problem(const Clip& clip);

}  // namespace boule
