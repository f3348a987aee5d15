#pragma once

#include <string>

#include "render/apps/view/messages/client_message.h"
#include "render/files/scene_file/scene_file.h"
#include "render/integrators/ray_record.h"
#include "render/prepare/prepared_scene.h"

namespace boule::view {

/// What a pixel's rays are told from.
struct PickedPixel {
  const PickMessage& message;
  const PreparedScene& scene;
  const LoadedScene& loaded;  ///< with the names of materials
  const RayRecord& record;
  float weight;  ///< that the camera gives the sample
};

/// The answer to a pick: docs/view_protocol.md.
std::string picked_text(const PickedPixel& pixel);

}  // namespace boule::view
