#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/job/overlay/overlay_facts.h"
#include "render/files/scene_file/loaded/particle_facts.h"
#include "render/renderer/renderer.h"

namespace boule {

/// The labels of these tables that are in the picture, the nearest first: those whose particle
/// nothing hides at its middle. `origin` is that of the scene. None where the camera bends straight
/// lines.
Result<std::vector<OverlayLabel>> seen_labels(const std::vector<ParticleFacts>& particles,
                                              const Vec3d& origin, Renderer& renderer);

/// True if a table has any.
bool has_labels(const std::vector<ParticleFacts>& particles);

}  // namespace boule
