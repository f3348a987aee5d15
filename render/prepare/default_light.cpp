#include "render/prepare/default_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/geometry.h"
#include "core/scene/instances.h"

namespace boule {
namespace {

/// Together a little more than 1, so that what faces both is nearly as bright as its colour.
constexpr float key_intensity = 0.95F, fill_intensity = 0.15F;

/// Whether a background counts as light. A constant one and an image do so for path tracing only.
bool is_light(const Background& background, Method method) {
  if (const auto* gradient = std::get_if<GradientBackground>(&background)) {
    return !is_black(gradient->bottom) || !is_black(gradient->top);
  }
  if (method == Method::whitted) return false;
  if (const auto* constant = std::get_if<ConstantBackground>(&background)) {
    return !is_black(constant->color);
  }
  const auto& pixels = std::get<EnvironmentBackground>(background).pixels;
  return !std::all_of(pixels.begin(), pixels.end(), is_black);
}

/// Whether any object gives light. Looks at the objects only if a material gives light, which is so
/// in few scenes.
bool has_emitter(const Scene& scene) {
  std::vector<bool> emits;
  for (const NamedMaterial& named : scene.materials) {
    const auto* emissive = std::get_if<Emissive>(&named.material);
    emits.push_back(emissive != nullptr && !is_black(emissive->radiance));
  }
  if (std::find(emits.begin(), emits.end(), true) == emits.end()) return false;
  const auto gives = [&emits](const auto& object) -> bool {
    return emits[object.material.index()];
  };
  const auto any_gives = [&gives](const auto& objects) {
    return std::any_of(objects.begin(), objects.end(), gives);
  };
  bool found =
      any_gives(scene.packed ? scene.packed->emissive : scene.spheres) || any_gives(scene.planes);
  visit_shown_groups(scene, [&](const ShownGroup& shown) {
    if (found) return;
    found = shown.material ? emits[*shown.material] : any_gives(scene.groups[shown.group].spheres);
  });
  return found;
}

}  // namespace

bool lacks_light(const Scene& scene, Method method) {
  return scene.lights.empty() && !is_light(scene.background, method) && !has_emitter(scene);
}

const char* light_note(const Scene& scene, Method method) {
  const bool unused =
      method == Method::whitted && std::holds_alternative<EnvironmentBackground>(scene.background);
  return unused ? "no light in the scene, and by method whitted its environment is none: lit from "
                  "the upper left, and weakly from the eye"
                : "no light in the scene: lit from the upper left, and weakly from the eye";
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
