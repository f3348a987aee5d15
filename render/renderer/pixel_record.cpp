#include <new>

#include "core/base/float_environment.h"
#include "render/integrators/whitted.h"
#include "render/renderer/renderer.h"

/// The recursion of one pixel, which shows the parts of its colour.
namespace boule {

Result<float> Renderer::record_pixel(int x, int y, RayRecord& record) const {
  if (!scene_) return moved_away();
  const FloatEnvironment environment;
  try {
    return record_ray(x, y, record);
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory for the rays of a pixel");
  }
}

Result<float> Renderer::record_ray(int x, int y, RayRecord& record) const {
  const CameraView& camera = scene_->camera_view;
  SampleBuffer samples;
  samples.resize(1, camera);  // sets its lens point to the centre
  samples.set(0, x + 0.5, y + 0.5);
  RayBuffer rays(1);
  setup_->kernels.primary_rays(camera, samples.view(), rays.view());
  record.start();
  const float weight = camera.weighs ? samples.weight(0) : 1;
  if (weight == 0) return weight;
  IntegratorSettings settings = integrator_settings();
  settings.stream_size = 1;
  settings.record = &record;
  settings.cancel = &record.full();
  Whitted integrator(*scene_, setup_->kernels, settings);
  Color radiance;
  if (!integrator.trace({rays, scene_->coherence, nullptr}, &radiance))
    return Diagnostic::of("the recursion has more than " + std::to_string(RayRecord::most_rays) +
                          " rays here");
  return weight;
}

}  // namespace boule
