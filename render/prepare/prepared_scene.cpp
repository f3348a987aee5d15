#include "render/prepare/prepared_scene.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/float_environment.h"
#include "core/math/geometry.h"
#include "core/optics/cameras.h"
#include "core/scene/instances.h"
#include "core/scene/scene_check.h"
#include "render/prepare/default_camera.h"
#include "render/prepare/default_light.h"
#include "render/prepare/fold_spheres.h"
#include "render/prepare/placed_lights.h"
#include "render/prepare/scene_geometry.h"
#include "render/prepare/view_notes.h"
#include "simd/abi/stream.h"

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

bool has_own_colors(const Scene& scene, const ParallelFor& parallel_for) {
  const auto colored = [](const auto& primitive) { return primitive.material.has_color(); };
  const auto any_colored = [&](SphereRun spheres) {
    return fold_spheres(
               spheres, parallel_for, char{0},
               [&](char& some, const Sphere& sphere) { some |= colored(sphere) ? 1 : 0; },
               [](char& some, char other) { some |= other; }) != 0;
  };
  bool others_colored = false;
  each_other_kind([&](auto kind) {
    others_colored |= std::any_of(kind.of(scene).begin(), kind.of(scene).end(), colored);
  });
  return (scene.packed && scene.packed->has_own_colors) || others_colored ||
         any_colored(scene.spheres) ||
         std::any_of(scene.groups.begin(), scene.groups.end(),
                     [&](const Group& group) { return any_colored(group.spheres); });
}

std::vector<MaterialRef> materials_of(const std::vector<Capsule>& capsules) {
  std::vector<MaterialRef> materials;
  materials.reserve(capsules.size());
  for (const Capsule& capsule : capsules) materials.push_back(capsule.material);
  return materials;
}

bool is_emitter(const NamedMaterial& named) {
  return std::holds_alternative<Emissive>(named.material);
}

/// Of capsules that shine, for path tracing.
constexpr const char* shining_note =
    "capsules that shine are no lights to sample: paths find their light by chance alone, with "
    "much noise";

bool has_shining_capsules(const Scene& scene) {
  return std::any_of(scene.capsules.begin(), scene.capsules.end(), [&](const Capsule& capsule) {
    return is_emitter(scene.materials[capsule.material.index()]);
  });
}

/// The spheres that give light, for path tracing.
std::vector<Sphere> emissive_spheres(const Scene& scene) {
  if (scene.packed) return scene.packed->emissive;
  std::vector<Sphere> emissive;
  if (std::none_of(scene.materials.begin(), scene.materials.end(), is_emitter)) return emissive;
  const auto is_emissive = [&](const Sphere& s) {
    return is_emitter(scene.materials[s.material.index()]);
  };
  const auto copy_emissive = [&](const std::vector<Sphere>& spheres, std::vector<Sphere>& to) {
    std::copy_if(spheres.begin(), spheres.end(), std::back_inserter(to), is_emissive);
  };
  copy_emissive(scene.spheres, emissive);
  std::vector<std::vector<Sphere>> in_groups(scene.groups.size());
  for (std::size_t i = 0; i < scene.groups.size(); ++i)
    copy_emissive(scene.groups[i].spheres, in_groups[i]);
  visit_shown_groups(scene, [&](const ShownGroup& shown) {
    const bool all = shown.material && is_emitter(scene.materials[*shown.material]);
    if (shown.material && !all) return;
    for (const Sphere& one : all ? scene.groups[shown.group].spheres : in_groups[shown.group])
      emissive.push_back(transformed(one, shown.transform, shown.material));
  });
  return emissive;
}

/// Of spheres that shine and are cut.
constexpr const char* cut_light_note =
    "spheres that shine and are cut by a clip plane are no lights to sample: paths find their "
    "light by chance alone, with much noise";

/// Gives the clip planes the ids behind those of the scene's planes. Returns how many they are.
std::size_t add_clip_planes(Scene& scene) {
  for (const Clip& clip : scene.clips) scene.planes.push_back({clip.point, clip.normal, {}});
  return scene.clips.size();
}

/// Takes the ghosts out of a scene; null if there are none.
Result<std::shared_ptr<const Ghosts>> prepare_ghosts(Scene& scene,
                                                     const ParallelFor& parallel_for) {
  const std::shared_ptr<const Ghosts> none;
  if (!may_have_ghosts(scene)) return none;
  Scene films;
  auto taken = take_ghosts(scene, films);
  if (!taken) return taken.error();
  if (films.spheres.empty() && films.capsules.empty()) return none;
  films.clips = scene.clips;
  const std::size_t clips = add_clip_planes(films);
  PreparedScene prepared{.geometry = geometry_of(films, std::nullopt, parallel_for),
                         .planes = std::move(films.planes),
                         .clips = clips,
                         .of_capsules = materials_of(films.capsules),
                         .plain_materials = plain_materials(scene)};
  taken.value().scene = std::make_shared<const PreparedScene>(std::move(prepared));
  return std::make_shared<const Ghosts>(std::move(taken).value());
}

/// What the rays through the centre of the camera's lens have in common, or all primary rays of a
/// camera without a lens.
Coherence central_coherence(CameraKind kind) {
  return coherence_of(kind == CameraKind::thin_lens ? CommonPart::origin : common_part(kind));
}

/// Gives a scene without a camera one that frames its objects. An error where none can.
Status add_camera(Scene& scene, int width, int height, const ParallelFor& parallel_for,
                  std::vector<std::string>& notes) {
  if (scene.camera) return {};
  const auto [camera, leaves_out] = choose_camera(scene, width, height, parallel_for);
  scene.camera = camera;
  if (const auto problem = find_problem(*scene.camera)) {
    return Diagnostic::about("camera",
                             "the scene has no camera, and its objects cannot be framed: camera." +
                                 problem->field + " " + problem->message);
  }
  if (count_primitives(scene).total() > 0)
    notes.emplace_back(std::string(camera_note) + (leaves_out ? left_out_note : ""));
  return {};
}

EnvironmentLight environment_light(const Scene& scene, Method method) {
  const auto* image = std::get_if<EnvironmentBackground>(&scene.background);
  return image && method == Method::path ? EnvironmentLight(*image) : EnvironmentLight();
}

Status check_size(int width, int height) {
  if (auto done = check_range("image.size", width, rule::image_side); !done) return done;
  return check_range("image.size", height, rule::image_side);
}

}  // namespace

std::uint32_t PreparedScene::primitive_id(const Hit& hit) const {
  const auto id = static_cast<std::uint32_t>(hit.id);
  const auto cuts = static_cast<std::uint32_t>(clips);
  if (!ghosts) return is_capsule(hit) ? id - cuts : id;
  if (is_sphere(hit)) return ghosts->sphere_ids[id];
  const std::uint32_t first_plane = ghosts->spheres;
  if (geometry.is_plane(hit))
    return first_plane + id - static_cast<std::uint32_t>(geometry.sphere_count());
  const std::uint32_t first_capsule =
      first_plane + static_cast<std::uint32_t>(geometry.plane_count()) - cuts;
  return first_capsule + ghosts->capsule_ids[capsule_number(hit)];
}

bool PreparedScene::is_cut(const Sphere& sphere) const {
  const std::span<const Plane> all = clip_planes();
  return std::any_of(all.begin(), all.end(), [&sphere](const Plane& plane) {
    const Vec3d normal = vec_cast<double>(plane.normal);
    const Vec3d from = vec_cast<double>(sphere.center) - vec_cast<double>(plane.point);
    return dot(from, normal) > -double{sphere.radius} * length(normal);
  });
}

Status reframe(PreparedScene& scene, const Camera& camera, int width, int height) {
  const FloatEnvironment floats;
  if (auto done = check_size(width, height); !done) return done;
  if (const auto problem = find_problem(camera))
    return Diagnostic::about("camera." + problem->field, problem->message);
  std::vector<Light> lights = scene.lit_by_default ? default_lights(camera) : scene.own_lights;
  if (auto done = place_lights(lights, camera); !done) return done;
  LensOptics lens = build_lens(camera, width, height);
  Camera own = camera;
  if (scene.method == Method::path)
    scene.area_lights = AreaLights(lights, scene.emissive_spheres, scene.plain_materials);
  scene.lights = std::move(lights);
  scene.camera = std::move(own);
  scene.lens = std::move(lens);
  // The view points to numbers in `distortion` and `lens`, which stay where they are when these
  // move.
  scene.camera_view =
      build_camera(scene.camera, width, height,
                   scene.distortion.st.empty() ? nullptr : &scene.distortion, &scene.lens);
  scene.coherence = coherence_of(common_part(scene.camera_view.kind));
  scene.central_coherence = central_coherence(scene.camera_view.kind);
  return {};
}

Status settle_camera(Scene& scene, int width, int height, const ParallelFor& parallel_for) {
  const FloatEnvironment floats;
  if (auto done = check_size(width, height); !done) return done;
  if (auto done = validate_in_parallel(scene, parallel_for); !done) return done;
  if (scene.camera) return {};
  share_or_expand(scene);
  std::vector<std::string> notes;
  return add_camera(scene, width, height, parallel_for, notes);
}

Result<PreparedScene> prepare(Scene scene, int width, int height, const ParallelFor& parallel_for,
                              Method method) {
  const FloatEnvironment floats;
  if (auto done = check_size(width, height); !done) return done.error();
  if (auto done = validate_in_parallel(scene, parallel_for); !done) return done.error();
  const auto groups = share_or_expand(scene);
  std::vector<std::string> notes;
  if (auto done = add_camera(scene, width, height, parallel_for, notes); !done) return done.error();
  const bool lit_by_default = lacks_light(scene, method);
  if (lit_by_default) notes.emplace_back(light_note(scene, method));
  if (method == Method::path && has_shining_capsules(scene)) notes.emplace_back(shining_note);
  EnvironmentLight environment = environment_light(scene, method);
  const bool own_colors = has_own_colors(scene, parallel_for);
  std::vector<Sphere> emissive = emissive_spheres(scene);
  std::optional<SphereBounds> bounds;
  if (scene.image.fog > 0) bounds = bounds_without_outliers(scene);
  const std::vector<Sphere> sample = sample_spheres(scene, groups);
  auto ghosts = prepare_ghosts(scene, parallel_for);
  if (!ghosts) return ghosts.error();
  const std::size_t clips = add_clip_planes(scene);
  PreparedScene prepared{.geometry = geometry_of(scene, groups, parallel_for),
                         .planes = std::move(scene.planes),  // only now: the geometry has read them
                         .clips = clips,
                         .of_capsules = materials_of(scene.capsules),
                         .materials = flatten_all(scene, method),
                         .plain_materials = plain_materials(scene),
                         .has_own_colors = own_colors,
                         .method = method,
                         .ambient = scene.ambient,
                         .emissive_spheres = std::move(emissive),
                         .own_lights = std::move(scene.lights),
                         .lit_by_default = lit_by_default,
                         .background = std::move(scene.background),
                         .backdrop = scene.backdrop,
                         .environment = std::move(environment),
                         .distortion = std::move(scene.distortion).value_or(DistortionMap{}),
                         .bounds = bounds,
                         .outline_groups = std::move(scene.outline_groups),
                         .ghosts = std::move(ghosts).value(),
                         .notes = std::move(notes)};
  const auto is_cut = [&prepared](const Sphere& sphere) { return prepared.is_cut(sphere); };
  if (std::erase_if(prepared.emissive_spheres, is_cut) > 0 && method == Method::path)
    prepared.notes.emplace_back(cut_light_note);
  if (auto done = reframe(prepared, *scene.camera, width, height); !done) return done.error();
  for (std::string& note : view_notes(prepared.camera_view, width, height, sample))
    prepared.notes.push_back(std::move(note));
  return prepared;
}

}  // namespace boule
