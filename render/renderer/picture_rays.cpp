#include "render/renderer/picture_rays.h"

#include <string>
#include <utility>

#include "core/base/float_environment.h"
#include "core/optics/camera_builder.h"
#include "render/memory/scene_memory.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/preparation.h"
#include "render/renderer/sample_rays.h"

namespace boule {
namespace {

constexpr std::size_t rays_at_a_time = 1024;

/// Writes the rays of one row of the picture.
void find_row(SampleRays& found, const PixelRect& rect, int y, int sample, bool weighs,
              const PictureRays& to) {
  std::vector<SampleId> ids;
  std::size_t at = static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width());
  for (int x = rect.x0; x < rect.x1; ++x) {
    ids.push_back({x, y, sample});
    if (ids.size() < rays_at_a_time && x + 1 < rect.x1) continue;
    found.find(ids);
    for (std::size_t k = 0; k < ids.size(); ++k, ++at) {
      const bool has_ray = !weighs || found.samples().weight(k) != 0;
      to.org[at] = has_ray ? found.rays().org(k) : Vec3d{};
      to.dir[at] = has_ray ? found.rays().dir(k) : Vec3f{};
    }
    ids.clear();
  }
}

}  // namespace

Status find_picture_rays(Scene scene, const RenderOptions& options, int sample,
                         const PictureRays& to, const ParallelFor& parallel_for) {
  const FloatEnvironment environment;
  if (auto done = check_scene_memory(scene); !done) return done;
  if (auto done = validate(options); !done) return done;
  if (sample < 0 || sample >= options.spp) {
    return Diagnostic::about("sample", "must be from 0 to " + std::to_string(options.spp - 1) +
                                           ", is " + std::to_string(sample));
  }
  const auto kernels = kernels_for(options.isa, options.solver);
  if (!kernels) return kernels.error();
  if (auto done = settle_camera(scene, options.width, options.height, parallel_for); !done)
    return done;
  const LensOptics lens = build_lens(*scene.camera, options.width, options.height);
  const CameraView camera = build_camera(*scene.camera, options.width, options.height,
                                         scene.distortion ? &*scene.distortion : nullptr, &lens);
  const Sampler sampler(options.spp, options.seed, options.filter);
  const PixelRect rect = rendered_rect(options);
  parallel_for(static_cast<std::size_t>(rect.height()), [&](std::size_t row) {
    SampleRays found(camera, *kernels.value(), sampler, rays_at_a_time);
    find_row(found, rect, rect.y0 + static_cast<int>(row), sample, camera.weighs, to);
  });
  return {};
}

}  // namespace boule
