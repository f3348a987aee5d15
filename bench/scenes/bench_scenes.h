#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/scene/camera.h"
#include "core/scene/light.h"
#include "core/scene/primitive.h"

namespace boule::bench {

/// What the benchmarks look at: spheres and capsules, no planes. Ids: the spheres, then the
/// capsules.
struct BenchScene {
  std::string name;
  std::vector<Sphere> spheres;
  std::vector<Capsule> capsules;
  PinholeCamera camera;
  PointLight light;
  float radius = 1;  ///< about what is seen, around the point that the camera looks at
};

/// visit(primitive) for the sphere or capsule with this id. Precondition, unchecked: it exists.
template <class Visit>
auto with_primitive(const BenchScene& scene, std::int32_t id, const Visit& visit) {
  const auto i = static_cast<std::size_t>(id);
  if (i < scene.spheres.size()) return visit(scene.spheres[i]);
  return visit(scene.capsules[i - scene.spheres.size()]);
}

/// The six scenes that figures are given for.
std::vector<std::string> scene_names();

inline constexpr int most_random = 10'000'000;  ///< spheres of a scene uN

/// uN: N random spheres in the unit cube that cover it four times over, r = sqrt(4 / (pi N)).
/// flakeD: the sphereflake of depth D, 0 to 6, without its floor. Or one of
/// particle_scenes.h, stick_scenes.h or hard_scenes.h.
Result<BenchScene> make_scene(const std::string& name);

/// The number behind a scene's letters, if it is one from `low` to `high`.
std::optional<int> number_after(std::string_view prefix, std::string_view name, int low, int high);

}  // namespace boule::bench
