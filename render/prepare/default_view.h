#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace boule {

/// The box around all spheres in double; low is inf and high -inf where there is none. Nothing here
/// throws but lacks_light(), whatever the numbers.
struct SphereBounds {
  Vec3d low, high;
};
SphereBounds bounds_of(const std::vector<Sphere>& spheres);

/// The camera of a scene that has none: a pinhole whose picture of `width` x `height` pixels holds
/// every sphere. With planes only it looks at the first one, with nothing along -z. Coordinates
/// near the end of float's range can overflow: check it with find_problem().
Camera default_camera(const Scene& scene, int width, int height);

/// True if nothing in the scene gives light: no light, no object of an emissive material, no
/// gradient; by path tracing constant backgrounds and environments give light too. What is black
/// gives none. Of a valid scene whose instances are expanded. Throws std::bad_alloc.
bool lacks_light(const Scene& scene, Method method);

/// What is told of the light that such a scene gets.
const char* light_note(const Scene& scene, Method method);

/// The light of such a scene: white, intensity 1, no falloff, at the camera's eye.
PointLight light_at_eye(const Camera& camera);

}  // namespace boule
