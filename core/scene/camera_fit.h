#pragma once

#include <optional>

#include "core/math/vec.h"
#include "core/scene/camera.h"
#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// The kinds of camera that can be fitted to a scene.
enum class FittedCamera { pinhole, orthographic };
template <>
inline constexpr std::array<std::string_view, 2> names<FittedCamera>{"pinhole", "orthographic"};

/// How a fitted camera stands that is not told its direction: what is upward stays upward, or the
/// spheres' principal axes decide (core/scene/principal_pose.h).
enum class FittedPose { upright, principal };
template <>
inline constexpr std::array<std::string_view, 2> names<FittedPose>{"upright", "principal"};

namespace rule {
/// The allowed margins, which leave some of the picture.
inline constexpr NumberRule margin{.low = 0, .high = 0.5, .takes_high = false};
}  // namespace rule

/// The settings for fitting a camera to a scene without one: the tightest frame that holds the
/// outlines of all spheres.
struct CameraFit {
  FittedCamera type = FittedCamera::pinhole;
  std::optional<Vec3f> direction{};   ///< direction of view, of any length; none: default_view()
  std::optional<Vec3f> up{};          ///< as that of a CameraPose; none: default_view()
  float fov = 45;                     ///< of a pinhole, in degrees, 0 < fov < 180
  std::optional<FovAxis> fov_axis{};  ///< of a pinhole; none: the shorter side of the picture
  float margin = 0.05F;               ///< left free at each edge, as a fraction of the picture's
                                      ///< side; 0 to 0.5
  /// None: upright, unless a reader knows that axes mean nothing. Principal has no direction or up.
  std::optional<FittedPose> pose{};
  float roll = 0;  ///< degrees by which the picture turns counter-clockwise
  float room = 0;  ///< left free at the right for a legend, as a fraction of the picture's width

  friend bool operator==(const CameraFit&, const CameraFit&) = default;
};

template <>
inline constexpr auto fields<CameraFit> = field_list(
    "fit", field("type", &CameraFit::type),
    field("direction", &CameraFit::direction, rule::direction),
    field("up", &CameraFit::up, rule::direction), field("fov", &CameraFit::fov, rule::acute_view),
    field("fov_axis", &CameraFit::fov_axis), field("margin", &CameraFit::margin, rule::margin),
    field("pose", &CameraFit::pose), field("roll", &CameraFit::roll, rule::finite),
    field("room", &CameraFit::room, rule::margin));

/// The first Problem of a fit: a field against its rule, or up within 1e-6 rad of the direction.
std::optional<Problem> find_problem(const CameraFit& fit);

}  // namespace boule
