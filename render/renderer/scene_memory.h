#pragma once

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boule {

/// An error if what the instances of a valid scene show needs more memory than there is: it is
/// known before any is taken.
Status check_scene_memory(const Scene& scene);

}  // namespace boule
