#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace boule {

/// True if nothing in the scene gives light. Lights do; for Method::path objects of an emissive
/// material and a background too. By Method::whitted these are seen, but light nothing: a gradient
/// and emissive objects count as light there only if no object needs one, being a mirror, glass or
/// emissive, or if there is ambient light. What is black gives none. Preconditions: the scene is
/// valid, and its instances show no planes (expand_instances(), expand_all_but_spheres()).
bool lacks_light(const Scene& scene, Method method);

/// The lights that such a scene is given: a white directional one from the camera's upper left,
/// which shows shape, and a weaker one at its eye, so that no shadow is black, nor a room that the
/// other does not enter.
std::vector<Light> default_lights(const Camera& camera);

/// The sentence that tells the user of it.
std::string light_note(const Scene& scene, Method method);

}  // namespace boule
