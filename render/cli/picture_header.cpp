#include "render/cli/picture_header.h"

#include <fmt/format.h>

#include "render/cli/camera_matrices.h"
#include "render/cli/stats.h"

namespace boule::cli {

Metadata picture_header(const Renderer& renderer, std::uint64_t scene_hash) {
  const RenderOptions& options = renderer.options();
  const CameraMatrices matrices =
      camera_matrices(renderer.scene().camera, options.width, options.height);
  return {{"worldtocamera", matrices.world_to_camera},
          {"worldtoscreen", matrices.world_to_screen},
          {"samplesPerPixel", options.spp},
          {"boule:solver", solver_name(options.solver)},
          {"boule:seed", std::to_string(options.seed)},
          {"boule:scene_hash", fmt::format("{:016x}", scene_hash)}};
}

}  // namespace boule::cli
