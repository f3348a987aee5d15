#include "render/prepare/prepared_scene.h"

#include <algorithm>
#include <utility>

#include "core/base/float_environment.h"
#include "core/optics/cameras.h"
#include "core/scene/instances.h"
#include "render/prepare/default_camera.h"
#include "render/prepare/default_light.h"
#include "render/prepare/placed_lights.h"

namespace boule {
namespace {

std::vector<FlatMaterial> flatten_all(const Scene& scene, Method method) {
  std::vector<FlatMaterial> flat;
  flat.reserve(scene.materials.size());
  for (const NamedMaterial& named : scene.materials) {
    flat.push_back(flatten(named.material, scene.ambient, method));
  }
  return flat;
}

std::vector<Material> plain_materials(const Scene& scene) {
  std::vector<Material> plain;
  plain.reserve(scene.materials.size());
  for (const NamedMaterial& named : scene.materials) plain.push_back(named.material);
  return plain;
}

bool has_own_colors(const Scene& scene) {
  const auto colored = [](const auto& primitive) { return primitive.material.has_color(); };
  return std::any_of(scene.spheres.begin(), scene.spheres.end(), colored) ||
         std::any_of(scene.planes.begin(), scene.planes.end(), colored);
}

Coherence primary_coherence(CameraKind kind) {
  switch (visit_camera(kind, [](auto formula) { return decltype(formula)::common; })) {
    case CommonPart::origin:
      return Coherence::common_origin;
    case CommonPart::direction:
      return Coherence::common_direction;
    case CommonPart::none:
      break;
  }
  return Coherence::none;
}

/// What the rays through the centre of the camera's lens have in common, or all primary rays of a
/// camera without a lens.
Coherence central_coherence(CameraKind kind) {
  return kind == CameraKind::thin_lens ? Coherence::common_origin : primary_coherence(kind);
}

/// Gives a scene without a camera one that frames its objects. An error where none can.
Status add_camera(Scene& scene, int width, int height, std::vector<std::string>& notes) {
  if (scene.camera) return std::nullopt;
  scene.camera = default_camera(scene, width, height);
  if (const auto problem = find_problem(*scene.camera)) {
    return Diagnostic::about("camera",
                             "the scene has no camera, and its objects cannot be framed: camera." +
                                 problem->field + " " + problem->message);
  }
  if (!scene.spheres.empty() || !scene.planes.empty()) notes.emplace_back(camera_note);
  return std::nullopt;
}

void add_light(Scene& scene, Method method, std::vector<std::string>& notes) {
  if (!lacks_light(scene, method)) return;
  notes.emplace_back(light_note(scene, method));
  scene.lights = default_lights(*scene.camera);
}

EnvironmentLight environment_light(const Scene& scene, Method method) {
  const auto* image = std::get_if<EnvironmentBackground>(&scene.background);
  return image && method == Method::path ? EnvironmentLight(*image) : EnvironmentLight();
}

}  // namespace

Result<PreparedScene> prepare(Scene scene, int width, int height, const ParallelFor& parallel_for,
                              Method method) {
  const FloatEnvironment floats;
  if (auto bad = check_range("image.size", width, rule::image_side)) return *bad;
  if (auto bad = check_range("image.size", height, rule::image_side)) return *bad;
  if (auto bad = validate(scene)) return *bad;
  expand_instances(scene);
  std::vector<std::string> notes;
  if (auto bad = add_camera(scene, width, height, notes)) return *bad;
  if (auto bad = place_lights(scene.lights, *scene.camera)) return *bad;
  add_light(scene, method, notes);
  EnvironmentLight environment = environment_light(scene, method);
  AreaLights area_lights = method == Method::path ? AreaLights(scene) : AreaLights();
  DistortionMap distortion = std::move(scene.distortion).value_or(DistortionMap{});
  LensOptics lens = build_lens(*scene.camera, width, height);
  const bool own_colors = has_own_colors(scene);
  // The view points to numbers in `distortion` and `lens`, which stay where they are when these
  // move.
  const CameraView view = build_camera(*scene.camera, width, height,
                                       distortion.st.empty() ? nullptr : &distortion, &lens);
  return PreparedScene{
      .geometry = Geometry(scene.spheres, scene.planes, Structure::automatic, parallel_for),
      .spheres = std::move(scene.spheres),  // only now: the geometry has read them
      .planes = std::move(scene.planes),
      .materials = flatten_all(scene, method),
      .plain_materials = plain_materials(scene),
      .has_own_colors = own_colors,
      .method = method,
      .ambient = scene.ambient,
      .lights = std::move(scene.lights),
      .area_lights = std::move(area_lights),
      .background = std::move(scene.background),
      .backdrop = scene.backdrop,
      .environment = std::move(environment),
      .camera = std::move(*scene.camera),
      .distortion = std::move(distortion),
      .lens = std::move(lens),
      .camera_view = view,
      .coherence = primary_coherence(view.kind),
      .central_coherence = central_coherence(view.kind),
      .notes = std::move(notes)};
}

}  // namespace boule
