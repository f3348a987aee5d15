#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/optics/camera_view.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace boule {

/// Some thousand spheres of a scene, evenly from all that it shows, those of these groups too; none
/// of a packed scene.
std::vector<Sphere> sample_spheres(const Scene& scene,
                                   const std::optional<std::vector<ShownGroup>>& groups);

/// What the user is told of a camera and a picture of this size, a sentence each: that neighbouring
/// pixels have the same ray; that most of these spheres, of those in the picture, are smaller than
/// a pixel (pinhole, thin lens, orthographic). No sentence has a number in it: a series tells it
/// once.
std::vector<std::string> view_notes(const CameraView& camera, int width, int height,
                                    const std::vector<Sphere>& spheres);

}  // namespace boule
