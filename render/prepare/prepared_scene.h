#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "core/surface.h"
#include "render/prepare/area_lights.h"
#include "render/prepare/environment.h"
#include "render/prepare/flat_material.h"
#include "simd/abi/camera.h"
#include "simd/abi/isa.h"
#include "simd/camera/camera_builder.h"
#include "simd/geometry/geometry.h"

namespace boule {

/// A scene ready to be rendered at one size (the lecture's "preprocess"): complete, with a camera
/// and a light, and laid out for the kernels. Const once made; any number of threads may read it.
struct PreparedScene {
  Geometry geometry;                    ///< what rays are tested against
  std::vector<Sphere> spheres;          ///< by id: what shading looks up
  std::vector<Plane> planes;            ///< by id - spheres.size()
  std::vector<FlatMaterial> materials;  ///< by Sphere::material, Plane::material
  std::vector<Light> lights;            ///< in file order
  AreaLights area_lights;               ///< for path tracing
  Background background;
  EnvironmentLight environment;    ///< of an image, for path tracing
  Camera camera;                   ///< the scene's, or the default one
  DistortionMap distortion;        ///< what camera_view.map points into, if anything
  LensStack lens;                  ///< what camera_view.lens points into, likewise
  CameraView camera_view;          ///< camera and distortion for the kernels
  Coherence coherence;             ///< what primary rays have in common
  Coherence central_coherence;     ///< and those of them through the lens' centre
  std::vector<std::string> notes;  ///< what was decided for the user, a sentence each

  /// The material of the primitive with this id, of which there is one: precondition.
  [[nodiscard]] const FlatMaterial& material_of(std::int32_t id) const {
    const auto i = static_cast<std::size_t>(id);
    const std::size_t first_plane = spheres.size();
    return materials[i < first_plane ? spheres[i].material : planes[i - first_plane].material];
  }
};

/// The surface a ray met in it.
inline Surface find_surface(const PreparedScene& scene, const Ray& ray, const Hit& hit) {
  return find_surface(scene.spheres, scene.planes, ray, hit);
}

/// Prepares a scene for a picture of `width` x `height` pixels. Takes any values: an error if the
/// scene is invalid (validate()), a side is not 1 .. 65535, or the scene has no camera and none can
/// be made for it. The bits do not depend on `parallel_for`. Throws std::bad_alloc, and what
/// `parallel_for` throws. Instances become spheres and planes (expand_instances()).
/// Spheres and planes are kept, not copied: move a scene here that is not needed any more. How the
/// scene itself asks to be rendered does not matter.
Result<PreparedScene> prepare(Scene scene, int width, int height,
                              const ParallelFor& parallel_for = serial_for,
                              Method method = Method::whitted);

}  // namespace boule
