#include "render/prepare/prepared_scene.h"

#include <utility>

#include "core/base/float_environment.h"
#include "core/scene/instances.h"
#include "render/prepare/default_view.h"

namespace boule {
namespace {

std::vector<FlatMaterial> flatten_all(const Scene& scene, Method method) {
  std::vector<FlatMaterial> flat;
  flat.reserve(scene.materials.size());
  for (const NamedMaterial& named : scene.materials) {
    flat.push_back(method == Method::path ? flatten_for_paths(named.material)
                                          : flatten(named.material, scene.ambient));
  }
  return flat;
}

Coherence primary_coherence(CameraKind kind) {
  switch (kind) {
    case CameraKind::parallel:
      return Coherence::common_direction;
    case CameraKind::thin_lens:
    case CameraKind::lens:
      return Coherence::none;
    case CameraKind::perspective:
    case CameraKind::equidistant:
      break;
  }
  return Coherence::common_origin;
}

/// Of the rays through a lens' centre, for those cameras that have one.
Coherence central_coherence(CameraKind kind) {
  return kind == CameraKind::thin_lens ? Coherence::common_origin : primary_coherence(kind);
}

}  // namespace

Result<PreparedScene> prepare(Scene scene, int width, int height, const ParallelFor& parallel_for,
                              Method method) {
  const FloatEnvironment floats;
  if (auto bad = check_range("image.size", width, 1, max_image_side)) return *bad;
  if (auto bad = check_range("image.size", height, 1, max_image_side)) return *bad;
  if (auto bad = validate(scene)) return *bad;
  expand_instances(scene);
  std::vector<std::string> notes;
  const Camera camera = scene.camera ? *scene.camera : default_camera(scene, width, height);
  if (!scene.camera) {
    if (const auto problem = find_problem(camera)) {
      return Diagnostic{"the scene has no camera, and its objects cannot be framed: camera." +
                            problem->field + " " + problem->message,
                        "camera",
                        {},
                        0,
                        0};
    }
    const bool framed = !scene.spheres.empty() || !scene.planes.empty();
    if (framed) notes.emplace_back("no camera in the scene: framed on the objects");
  }
  if (lacks_light(scene, method)) {
    scene.lights.emplace_back(light_at_eye(camera));
    notes.emplace_back(light_note(scene, method));
  }
  const auto* image = std::get_if<EnvironmentBackground>(&scene.background);
  EnvironmentLight environment =
      image && method == Method::path ? EnvironmentLight(*image) : EnvironmentLight();
  AreaLights area_lights = method == Method::path ? AreaLights(scene) : AreaLights();
  DistortionMap distortion = std::move(scene.distortion).value_or(DistortionMap{});
  LensStack lens = build_lens(camera, width, height);
  // The numbers stay where they are when their vectors move.
  const CameraView view =
      build_camera(camera, width, height, distortion.st.empty() ? nullptr : &distortion, &lens);
  return PreparedScene{
      .geometry = Geometry(scene.spheres, scene.planes, Structure::automatic, parallel_for),
      .spheres = std::move(scene.spheres),  // the geometry above has read them: in this order
      .planes = std::move(scene.planes),
      .materials = flatten_all(scene, method),
      .lights = std::move(scene.lights),
      .area_lights = std::move(area_lights),
      .background = std::move(scene.background),
      .environment = std::move(environment),
      .camera = camera,
      .distortion = std::move(distortion),
      .lens = std::move(lens),
      .camera_view = view,
      .coherence = primary_coherence(view.kind),
      .central_coherence = central_coherence(view.kind),
      .notes = std::move(notes)};
}

}  // namespace boule
