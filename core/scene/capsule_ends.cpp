#include "core/scene/capsule_ends.h"

#include <cstddef>
#include <vector>

namespace boule {

void visit_end_spheres(const Scene& scene, const std::function<void(SphereRun)>& function) {
  constexpr std::size_t most_together = 4096;
  std::vector<Sphere> some;
  const auto add = [&](const Capsule& capsule) {
    for (const Sphere& end : end_spheres(capsule)) some.push_back(end);
    if (some.size() < most_together) return;
    function(some);
    some.clear();
  };
  for (const Capsule& capsule : scene.capsules) add(capsule);
  visit_shown(scene, add);
  if (!some.empty()) function(some);
}

}  // namespace boule
