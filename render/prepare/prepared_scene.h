#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/optics/camera_builder.h"
#include "core/optics/camera_view.h"
#include "core/scene/scene.h"
#include "core/surface.h"
#include "render/prepare/area_lights.h"
#include "render/prepare/environment_light.h"
#include "render/prepare/flat_material.h"
#include "simd/abi/isa.h"
#include "simd/geometry/geometry.h"

namespace boule {

/// A scene ready to be rendered at one size (the lecture's "preprocess"): it has a camera and a
/// light, and is laid out for the kernels. It does not change any more.
struct PreparedScene {
  Geometry geometry;                      ///< what rays are tested against
  std::vector<Plane> planes;              ///< by id less that of the first plane, for shading
  std::vector<FlatMaterial> materials;    ///< by MaterialRef::index()
  std::vector<Material> plain_materials;  ///< likewise: what those in other colours are made of
  bool has_own_colors = false;            ///< some primitive has a colour of its own
  Method method = Method::whitted;        ///< for which the materials are flattened
  Color ambient;
  std::vector<Sphere> emissive_spheres;  ///< those that give light, in the order of their ids
  std::vector<Light> own_lights;         ///< as the scene has them, not placed by its camera yet
  bool lit_by_default = false;           ///< it has none, and gets default_lights()
  std::vector<Light> lights{};           ///< in file order, placed
  AreaLights area_lights{};              ///< for path tracing
  Background background;
  std::optional<Color> backdrop;   ///< what camera rays see instead
  EnvironmentLight environment;    ///< the background's image as a light, for path tracing
  Camera camera{};                 ///< the scene's, or the default one
  DistortionMap distortion;        ///< owns what camera_view.distortion points to
  LensOptics lens{};               ///< owns what camera_view.lens points to
  CameraView camera_view{};        ///< the camera as the kernels read it
  Coherence coherence{};           ///< what primary rays have in common
  Coherence central_coherence{};   ///< what those through the centre of the lens have in common
  std::vector<std::string> notes;  ///< what was decided for the user, a sentence each

  /// Whether a hit is one of a sphere. Precondition of this and of what follows: it is a hit of
  /// this geometry's, no miss.
  [[nodiscard]] bool is_sphere(const Hit& hit) const { return !geometry.is_plane(hit); }
  /// The plane that was hit. Precondition: it was no sphere.
  [[nodiscard]] const Plane& plane(const Hit& hit) const {
    return planes[static_cast<std::uint32_t>(hit.id) - geometry.sphere_count()];
  }
  /// What was hit is made of this.
  [[nodiscard]] MaterialRef material_ref(const Hit& hit) const {
    return is_sphere(hit) ? geometry.material(hit.slot) : plane(hit).material;
  }

  /// A material in a colour of its own. Precondition: the reference has one.
  [[nodiscard]] FlatMaterial colored_material(MaterialRef ref) const {
    return flatten(recolored(plain_materials[ref.index()], linear_of(ref.color())), ambient,
                   method);
  }

  /// The material of what was hit.
  [[nodiscard]] FlatMaterial material_of(const Hit& hit) const {
    const MaterialRef ref = material_ref(hit);
    return ref.has_color() ? colored_material(ref) : materials[ref.index()];
  }
};

/// The surface that a ray met in the scene.
inline Surface find_surface(const PreparedScene& scene, const Ray& ray, const Hit& hit) {
  return scene.is_sphere(hit) ? find_surface(scene.geometry.sphere(hit.slot), ray, hit)
                              : find_surface(scene.plane(hit), ray, hit);
}

/// Prepares a scene for a picture of `width` x `height` pixels. Takes any values; an error if the
/// scene is invalid (validate()), if a side is not 1 .. 65535, or if the scene has no camera and
/// none can be made for it. Passes on what `parallel_for` throws. Instances become spheres and
/// planes, or parts of the geometry (share_or_expand()). The geometry takes the place of the
/// scene's spheres: move a scene here that is not needed any more. scene.image and scene.render are
/// not used.
Result<PreparedScene> prepare(Scene scene, int width, int height,
                              const ParallelFor& parallel_for = serial_for,
                              Method method = Method::whitted);

/// Gives a prepared scene another camera, for a picture of this size: what depends on them is made
/// anew, and the scene is as if it had been prepared so. `notes` stay. An error as of prepare(),
/// and then the scene is unchanged. Throws std::bad_alloc. Precondition: nobody reads the scene
/// meanwhile.
Status reframe(PreparedScene& scene, const Camera& camera, int width, int height);

}  // namespace boule
