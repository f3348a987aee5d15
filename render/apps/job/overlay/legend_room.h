#pragma once

#include <optional>

#include "render/apps/job/render_job.h"
#include "render/files/scene_file/loaded/loaded_scene.h"

namespace boule {

/// Where a legend will be drawn, lets the camera that will be fitted to the scene leave room for
/// it, unless the scene says how much (CameraFit::room). `overlay`: in place of the scene's.
void leave_legend_room(const std::optional<OverlayParts>& overlay, const SizeChoice& size,
                       LoadedScene& loaded);

}  // namespace boule
