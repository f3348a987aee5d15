#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
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
#include "render/prepare/ghosts.h"
#include "render/prepare/sphere_bounds.h"
#include "simd/abi/isa.h"
#include "simd/geometry/geometry.h"

namespace boule {

/// A scene ready to be rendered at one size (the lecture's "preprocess"): it has a camera and a
/// light, and is laid out for the kernels. It is immutable, except for reframe().
struct PreparedScene {
  Geometry geometry;  ///< the primitives for rays
  /// By id less that of the first plane, for shading: those of the scene, then clip planes, which
  /// cut primitives and bound their caps.
  std::vector<Plane> planes;
  std::size_t clips = 0;                  ///< how many of them are clip planes
  std::vector<MaterialRef> of_capsules;   ///< by id less that of the first capsule
  std::vector<FlatMaterial> materials;    ///< by MaterialRef::index()
  std::vector<Material> plain_materials;  ///< by MaterialRef::index(): the base of materials in
                                          ///< other colours
  bool has_own_colors = false;            ///< some primitives have a colour of their own
  Method method = Method::whitted;        ///< for which the materials are flattened
  Color ambient;
  std::vector<Sphere> emissive_spheres;  ///< the emissive ones, in the order of their ids
  std::vector<Light> own_lights;         ///< the scene's lights, before their placement by the
                                         ///< camera
  bool lit_by_default = false;           ///< the scene has no lights and gets default_lights()
  std::vector<Light> lights{};           ///< in file order, placed
  AreaLights area_lights{};              ///< for path tracing
  Background background;
  std::optional<Color> backdrop;         ///< replaces the background for camera rays
  EnvironmentLight environment;          ///< the background's image as a light, for path tracing
  Camera camera{};                       ///< the scene's, or the default one
  DistortionMap distortion;              ///< owns what camera_view.distortion points to
  LensOptics lens{};                     ///< owns what camera_view.lens points to
  CameraView camera_view{};              ///< the camera as the kernels read it
  Coherence coherence{};                 ///< what primary rays have in common
  Coherence central_coherence{};         ///< the same for rays through the centre of the lens
  std::optional<SphereBounds> bounds{};  ///< if the scene asks for fog
  OutlineGroups outline_groups;          ///< by id, or by id less that of the first capsule
  std::shared_ptr<const Ghosts> ghosts;  ///< beside the geometry; null: none
  std::vector<std::string> notes;        ///< automatic choices, a sentence each

  /// Whether a hit is that of a sphere. Precondition of this and of the functions below: it is a
  /// hit of this geometry, not a miss.
  [[nodiscard]] bool is_sphere(const Hit& hit) const {
    return !geometry.is_plane(hit) && !is_capsule(hit);
  }
  [[nodiscard]] bool is_capsule(const Hit& hit) const { return geometry.is_capsule(hit); }
  /// The plane that was hit. Precondition: the hit is that of a plane.
  [[nodiscard]] const Plane& plane(const Hit& hit) const {
    return planes[static_cast<std::uint32_t>(hit.id) - geometry.sphere_count()];
  }
  [[nodiscard]] std::span<const Plane> clip_planes() const { return std::span(planes).last(clips); }
  /// Whether a clip plane cuts a part of a sphere off.
  [[nodiscard]] bool is_cut(const Sphere& sphere) const;
  /// The id of a primitive for users, who count ghosts, but no clip planes.
  [[nodiscard]] std::uint32_t primitive_id(const Hit& hit) const;
  /// The number of a capsule that was hit among the capsules.
  [[nodiscard]] std::uint32_t capsule_number(const Hit& hit) const {
    return static_cast<std::uint32_t>(hit.id) - geometry.sphere_count() - geometry.plane_count();
  }
  /// The group of the primitive that was hit (OutlineGroups), 0: none.
  [[nodiscard]] std::uint32_t outline_group(const Hit& hit) const {
    if (geometry.is_plane(hit)) return 0;
    if (is_capsule(hit)) return OutlineGroups::at(outline_groups.capsules, capsule_number(hit));
    return OutlineGroups::at(outline_groups.spheres, static_cast<std::uint32_t>(hit.id));
  }
  /// The material reference of the primitive that was hit.
  [[nodiscard]] MaterialRef material_ref(const Hit& hit) const {
    if (is_sphere(hit)) return geometry.material(hit.slot);
    if (geometry.is_plane(hit)) return plane(hit).material;
    return of_capsules[capsule_number(hit)];
  }

  /// A material in a colour of its own. Precondition: the reference has one.
  [[nodiscard]] FlatMaterial colored_material(MaterialRef ref) const {
    return flatten(recolored(plain_materials[ref.index()], linear_of(ref.color())), ambient,
                   method);
  }

  /// The material of the primitive that was hit.
  [[nodiscard]] FlatMaterial material_of(const Hit& hit) const {
    const MaterialRef ref = material_ref(hit);
    return ref.has_color() ? colored_material(ref) : materials[ref.index()];
  }
};

/// The surface that a ray hit in the scene.
inline Surface find_surface(const PreparedScene& scene, const Ray& ray, const Hit& hit) {
  const Geometry& geometry = scene.geometry;
  if (scene.is_sphere(hit)) return find_surface(geometry.sphere(hit.slot), ray, hit);
  if (geometry.is_plane(hit)) return find_surface(scene.plane(hit), ray, hit);
  return find_surface(geometry.capsule(hit.slot), ray, hit);
}

/// Prepares a scene for a picture of `width` x `height` pixels. Takes any values; an error if the
/// scene is invalid (validate()), if a side is outside 1 .. 65535, or if the scene has no camera
/// and cannot be fitted with one. Passes on exceptions of `parallel_for`. Instances become
/// primitives, or parts of the geometry (share_or_expand()). The geometry takes the place of the
/// scene's spheres: move the scene here if you no longer need it. scene.image, but for its fog,
/// and scene.render are ignored.
Result<PreparedScene> prepare(Scene scene, int width, int height,
                              const ParallelFor& parallel_for = serial_for,
                              Method method = Method::whitted);

/// Gives a scene without a camera the one that prepare() gives it. Arguments and errors are those
/// of prepare(). Instances may become primitives.
Status settle_camera(Scene& scene, int width, int height,
                     const ParallelFor& parallel_for = serial_for);

/// Gives a prepared scene another camera, for a picture of this size. All data that depend on them
/// are recomputed, so the scene equals one that was prepared with that camera. `notes` stay. Errors
/// are as for prepare(), and then the scene is unchanged. Throws std::bad_alloc. Precondition: no
/// other thread reads the scene in the meantime.
Status reframe(PreparedScene& scene, const Camera& camera, int width, int height);

}  // namespace boule
