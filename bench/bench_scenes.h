#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/scene/camera.h"
#include "core/scene/light.h"
#include "core/scene/primitive.h"

namespace boule::bench {

/// What the benchmarks look at: spheres, no planes.
struct BenchScene {
  std::string name;
  std::vector<Sphere> spheres;
  PinholeCamera camera;
  PointLight light;
  float radius = 1;  ///< about what is seen, around the point that the camera looks at
};

/// The six scenes that figures are given for.
std::vector<std::string> scene_names();

/// uN: N random spheres in the unit cube that cover it four times over, r = sqrt(4 / (pi N)).
/// flakeD: the sphereflake of depth D, 0 to 6, without its floor. Or one of
/// particle_scenes.h, or a hard one (hard_scenes.h).
Result<BenchScene> make_scene(const std::string& name);

/// The number behind a scene's letters, if it is one from `low` to `high`.
std::optional<int> number_after(std::string_view prefix, std::string_view name, int low, int high);

}  // namespace boule::bench
