#pragma once

#include <optional>

#include "core/math/vec.h"
#include "core/scene/field.h"

namespace boule {

/// The place and the direction of a camera: L = unit(look_at - eye), u = unit(L x up), v = u x L.
/// Right-handed; u points right in the picture, v up.
struct CameraPose {
  Vec3f eye{0, 0, 0};
  Vec3f look_at{0, 0, -1};
  Vec3f up{0, 1, 0};
};

template <>
inline constexpr auto fields<CameraPose> =
    field_list("pose", field("eye", &CameraPose::eye, rule::point),
               field("look_at", &CameraPose::look_at, rule::point),
               field("up", &CameraPose::up, rule::direction));

/// L; NaN if it is undefined.
Vec3d view_direction(const CameraPose& pose);

/// The distance of a point from the eye along L; negative behind the eye, NaN if L is undefined.
double depth_of(const CameraPose& pose, const Vec3f& point);

/// The distance along L at which a lens is in focus: `focus` or, without it, that of look_at.
double focus_of(const CameraPose& pose, const std::optional<float>& focus);

}  // namespace boule
