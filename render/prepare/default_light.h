#pragma once

#include "core/scene/scene.h"

namespace boule {

/// True if nothing in the scene gives light: it has no light, no object of an emissive material,
/// and no gradient as its background. For Method::path a constant background and an environment
/// give light too. What is black gives none. Preconditions: the scene is valid, and its instances
/// are expanded.
bool lacks_light(const Scene& scene, Method method);

/// The light that such a scene is given: white, intensity 1, no falloff, at the camera's eye.
PointLight light_at_eye(const Camera& camera);

/// The sentence that tells the user of it.
const char* light_note(const Scene& scene, Method method);

}  // namespace boule
