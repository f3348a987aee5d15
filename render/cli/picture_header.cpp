#include "render/cli/picture_header.h"

#include <fmt/format.h>

#include "render/cli/camera_matrices.h"

namespace boule::cli {

const char* solver_name(Solver solver) {
  switch (solver) {
    case Solver::fast:
      return "fast";
    case Solver::reference:
      return "reference";
    case Solver::robust:
      break;
  }
  return "robust";
}

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
