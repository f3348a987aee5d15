#pragma once

#include <optional>
#include <variant>

#include "core/math/vec.h"
#include "core/scene/primitive.h"

namespace boule {

/// Where a camera stands and what it looks at: L = unit(look_at - eye), u = unit(L x up),
/// v = u x L. Right-handed; u points right in the picture, v up.
struct CameraPose {
  Vec3f eye{0, 0, 0};
  Vec3f look_at{0, 0, -1};
  Vec3f up{0, 1, 0};
};

/// Which side of the film the field of view spans: x (its width), y, or the longer of the two
/// (the lecture's -1..1 rule).
enum class FovAxis { x, y, max };

/// All rays from the eye (lecture "Pinhole camera"); fov in degrees, 0 < fov < 180.
struct PinholeCamera {
  CameraPose pose;
  float fov = 45;
  FovAxis fov_axis = FovAxis::x;
};

/// All rays along L (lecture "Orthographic camera"); height of the film in world units, > 0.
struct OrthographicCamera {
  CameraPose pose;
  float height = 2;
};

using Camera = std::variant<PinholeCamera, OrthographicCamera>;

/// From raster to film coordinates, one axis: film = (raster * scale + offset) / extent.
struct RasterToFilm {
  double scale, offset, extent;
};

/// A camera ready for an image of W x H square pixels: the film point (x, y), each about -1..1,
/// stands for the vector p = x right + y up. Perspective: rays from the eye along forward + p.
/// Parallel: rays along forward from eye + p.
struct CameraBasis {
  Vec3d eye;
  Vec3d forward;  ///< L, unit length
  Vec3d right;    ///< u times half the film's width
  Vec3d up;       ///< v times half the film's height
  bool parallel;
  RasterToFilm film_x, film_y;
};

/// The basis of a valid camera for an image of `width` x `height` pixels.
CameraBasis camera_basis(const Camera& camera, int width, int height);

/// Raster (0, 0) is the top left corner of the picture, pixel (i, j) has its centre at
/// (i + 0.5, j + 0.5); the film runs from -1 to 1 and its y grows upward. This is the one place
/// where the picture is turned upside down (lecture "The image is upside down").
inline RasterToFilm raster_to_film_x(int width) { return {2.0, -1.0 * width, 1.0 * width}; }
inline RasterToFilm raster_to_film_y(int height) { return {-2.0, 1.0 * height, 1.0 * height}; }

/// The first Problem of a camera: see the scene file's rules for eye, look_at, up, fov, height.
std::optional<Problem> find_problem(const Camera& camera);

}  // namespace boule
