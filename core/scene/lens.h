#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scene/camera_pose.h"
#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// One surface of a lens, or a stop, as prescriptions list them, from the scene to the film.
struct LensSurface {
  float radius = 0;     ///< of curvature, > 0 if the centre is on the film's side; 0: flat, a stop
  float thickness = 0;  ///< along the axis to the next surface, >= 0; unused in the last one
  float index = 1;      ///< of refraction up to the next surface, least_index to most_index
  float aperture = 0;   ///< diameter, > 0
};

/// The accepted indices of refraction. All real media are within them, relative to any medium that
/// fills the world, so a number outside stands in the wrong column of its file.
inline constexpr float least_index = 0.25f, most_index = 8;

template <>
inline constexpr auto fields<LensSurface> = field_list(
    "surface", field("radius", &LensSurface::radius, rule::finite),
    field("thickness", &LensSurface::thickness, rule::not_negative),
    field("index", &LensSurface::index, rule::from_to(double{least_index}, double{most_index})),
    field("aperture", &LensSurface::aperture, rule::positive));

/// The least width of a surface as a fraction of the last one's. The search for the exit pupil goes
/// in steps and would miss narrower ones.
inline constexpr double least_width = 1.0 / 500;

/// A lens of real elements before a film (Kolb, Mitchell, Hanrahan, "A realistic camera model for
/// computer graphics", SIGGRAPH 1995). The eye is the middle of its first surface. The film moves
/// such that points at the distance `focus` from there along L are sharp.
struct LensCamera {
  CameraPose pose{};
  std::vector<LensSurface> surfaces{};  ///< not empty, in any unit of length
  float film_width = 36;                ///< in that unit, > 0
  float scale = 0.001f;                 ///< world units per such unit, > 0
  std::optional<float> focus{};         ///< in world units, > 0; none: the distance of look_at
};

template <>
inline constexpr auto fields<LensCamera> = field_list(
    "lens", field("pose", &LensCamera::pose), field("file", &LensCamera::surfaces, rule::from_file),
    field("film_width", &LensCamera::film_width, rule::positive),
    field("scale", &LensCamera::scale, rule::positive),
    field("focus", &LensCamera::focus, rule::positive).with_other_forms());

/// The focal length of a lens for rays close to its axis, in its own unit. This function and all
/// below take any surfaces; for surfaces that form no lens the result is infinite, NaN or
/// std::nullopt.
double focal_length(const std::vector<LensSurface>& surfaces);

/// The image distance: rays close to the axis from a point at `distance` before the first surface
/// meet again this far behind the last one. `distance` may be infinite. A result of 0 or below
/// means that they do not meet behind the lens.
double image_distance(const std::vector<LensSurface>& surfaces, double distance);

/// The index of a lens' stop: its only flat surface between equal media. std::nullopt without such
/// a surface, or with several.
std::optional<std::size_t> find_stop(const std::vector<LensSurface>& surfaces);

/// The diameter of a stop at the f-number N = f / D, where D is the diameter of the beam along the
/// axis that passes the stop. A ray that comes in parallel to the axis at the height 1 passes the
/// stop at some y, so the stop's diameter is |y| f / N. The same formula turns a diameter into an
/// f-number. NaN if `stop` is not the index of a surface.
double stop_diameter(const std::vector<LensSurface>& surfaces, std::size_t stop, double f_number);

}  // namespace boule
