#pragma once

#include <optional>
#include <variant>

#include "core/scene/camera_pose.h"
#include "core/scene/lens.h"
#include "core/scene/problem.h"

namespace boule {

/// The side of the film that the field of view spans: x (its width), y, or the longer of the two
/// (the lecture's -1..1 rule).
enum class FovAxis { x, y, max };
template <>
inline constexpr std::array<std::string_view, 3> names<FovAxis>{"x", "y", "max"};

/// All rays from the eye (lecture "Pinhole camera"); fov in degrees, 0 < fov < 180.
struct PinholeCamera {
  CameraPose pose{};
  float fov = 45;
  FovAxis fov_axis = FovAxis::x;
};

template <>
inline constexpr auto fields<PinholeCamera> =
    field_list("pinhole", field("pose", &PinholeCamera::pose),
               field("fov", &PinholeCamera::fov, rule::acute_view),
               field("fov_axis", &PinholeCamera::fov_axis));

/// All rays along L (lecture "Orthographic camera"); height of the film in world units, > 0.
struct OrthographicCamera {
  CameraPose pose{};
  float height = 2;
};

template <>
inline constexpr auto fields<OrthographicCamera> =
    field_list("orthographic", field("pose", &OrthographicCamera::pose),
               field("height", &OrthographicCamera::height, rule::positive));

/// All rays from the eye, at angles from the view direction in proportion to the distance from the
/// middle of the film (equidistant projection); fov in degrees, 0 < fov <= 360.
struct FisheyeCamera {
  CameraPose pose{};
  float fov = 180;
  FovAxis fov_axis = FovAxis::x;
};

template <>
inline constexpr auto fields<FisheyeCamera> = field_list(
    "fisheye", field("pose", &FisheyeCamera::pose),
    field("fov", &FisheyeCamera::fov, rule::any_view), field("fov_axis", &FisheyeCamera::fov_axis));

/// A pinhole opened to a disc (Cook, Porter, Carpenter, "Distributed ray tracing", SIGGRAPH 1984).
/// Points at the distance `focus` along L are sharp; fov as in PinholeCamera.
struct ThinLensCamera {
  CameraPose pose{};
  float fov = 45;
  FovAxis fov_axis = FovAxis::x;
  float aperture = 0;            ///< radius of the lens in world units, >= 0; 0 is a pinhole
  std::optional<float> focus{};  ///< in world units, > 0; none: the distance of look_at
};

template <>
inline constexpr auto fields<ThinLensCamera> =
    field_list("thin_lens", field("pose", &ThinLensCamera::pose),
               field("fov", &ThinLensCamera::fov, rule::acute_view),
               field("fov_axis", &ThinLensCamera::fov_axis),
               field("aperture", &ThinLensCamera::aperture, rule::not_negative).with_other_forms(),
               field("focus", &ThinLensCamera::focus, rule::positive).with_other_forms());

using Camera =
    std::variant<PinholeCamera, OrthographicCamera, FisheyeCamera, ThinLensCamera, LensCamera>;

/// The first Problem of a camera: a field against its rule; eye = look_at; up within 1e-6 rad of
/// the direction of view; a lens that does not gather light, whose film cannot be focused, or that
/// lets no light to the middle of the film.
std::optional<Problem> find_problem(const Camera& camera);

}  // namespace boule
