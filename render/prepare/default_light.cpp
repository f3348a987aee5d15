#include "render/prepare/default_light.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "core/math/geometry.h"
#include "core/scene/instances.h"
#include "render/prepare/flat_material.h"

namespace boule {
namespace {

/// Together a little more than 1, so that what faces both is nearly as bright as its colour.
constexpr float key_intensity = 0.95F, fill_intensity = 0.15F;

bool shines(const GradientBackground& background) {
  return !is_black(background.bottom) || !is_black(background.top);
}
bool shines(const ConstantBackground& background) { return !is_black(background.color); }
bool shines(const EnvironmentBackground& background) {
  const auto& pixels = background.pixels;
  return !std::all_of(pixels.begin(), pixels.end(), is_black);
}

/// Whether a background gives light to paths.
bool is_light(const Background& background) {
  return std::visit([](const auto& kind) { return shines(kind); }, background);
}

bool has_gradient(const Scene& scene) {
  const auto* gradient = std::get_if<GradientBackground>(&scene.background);
  return gradient != nullptr && shines(*gradient);
}

bool gives_light(const Material& material) {
  const auto* emissive = std::get_if<Emissive>(&material);
  return emissive != nullptr && !is_black(emissive->radiance);
}

/// Whether a material, in white, is black where no light comes from a light.
bool needs_light(const Material& material) {
  const FlatMaterial flat = flatten(recolored(material, gray(1)), Color{});
  return is_black(flat.constant) && !is_black(flat.diffuse);
}

/// Whether any object has a material that is `wanted`; of packed spheres the emissive ones are
/// asked alone. Looks at the objects only if there is such a material.
template <class Wanted>
bool any_object(const Scene& scene, const Wanted& wanted) {
  std::vector<bool> is_wanted;
  for (const NamedMaterial& named : scene.materials) is_wanted.push_back(wanted(named.material));
  if (std::find(is_wanted.begin(), is_wanted.end(), true) == is_wanted.end()) return false;
  const auto any = [&is_wanted](const auto& objects) {
    return std::any_of(objects.begin(), objects.end(), [&](const auto& object) -> bool {
      return is_wanted[object.material.index()];
    });
  };
  bool found = any(scene.packed ? scene.packed->emissive : scene.spheres);
  each_other_kind([&](auto kind) { found = found || any(kind.of(scene)); });
  visit_shown_groups(scene, [&](const ShownGroup& shown) {
    if (found) return;
    found = shown.material ? is_wanted[*shown.material] : any(scene.groups[shown.group].spheres);
  });
  return found;
}

bool has_emitter(const Scene& scene) { return any_object(scene, gives_light); }

}  // namespace

bool lacks_light(const Scene& scene, Method method) {
  if (!scene.lights.empty()) return false;
  if (method == Method::path) return !is_light(scene.background) && !has_emitter(scene);
  if (!has_gradient(scene) && !has_emitter(scene)) return true;
  // Those are seen, but by Whitted's method light nothing: what is matte would be black.
  return is_black(scene.ambient) && (scene.packed || any_object(scene, needs_light));
}

std::string light_note(const Scene& scene, Method method) {
  std::string text = "no light in the scene";
  if (method == Method::whitted) {
    const char* const unused = std::holds_alternative<EnvironmentBackground>(scene.background)
                                   ? "its environment is"
                               : has_gradient(scene) ? "its gradient is"
                               : has_emitter(scene)  ? "its emissive objects are"
                                                     : nullptr;
    if (unused != nullptr) text += std::string(", and by method whitted ") + unused + " none";
  }
  return text + ": lit from the upper left, and weakly from the eye";
}

std::vector<Light> default_lights(const Camera& camera) {
  const CameraPose pose = std::visit([](const auto& any) { return any.pose; }, camera);
  const Vec3d forward = view_direction(pose);
  const Vec3d right = normalize(cross(forward, vec_cast<double>(pose.up)));
  const Vec3d up = cross(right, forward);
  // Chosen by eye: 45 degrees from the view, as far to the side as up.
  const Vec3d travels = normalize(forward + (right - up) * std::sqrt(0.5));
  return {DirectionalLight{vec_cast<float>(travels), gray(key_intensity)},
          PointLight{pose.eye, gray(fill_intensity), Falloff::none}};
}

}  // namespace boule
