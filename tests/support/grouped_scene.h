#pragma once

#include "core/scene/scene.h"
#include "tests/support/test_scenes.h"

namespace boule::test {

/// The mixed scene with half of its objects in two groups, "inner" within "outer", which is shown
/// twice.
inline Scene grouped_scene() {
  Scene scene = mixed_scene(60, 40);
  Group inner{"inner", {scene.spheres[4], scene.spheres[5]}, {}, {}};
  Group outer{"outer", {scene.spheres[3]}, {{{0, -3, 0}, {0.1f, 1, 0}, 0}}, {}};
  scene.spheres.resize(3);
  outer.instances = {{1, {0.5f, 0.25f, 0}, {0, 90, 0}, 0.5f, {}}};
  scene.groups = {outer, inner};
  scene.instances = {{0, {-1, 0.5f, 0.25f}, {0, 0, 180}, 0.75f, {}},
                     {1, {0.5f, 0, 1}, {}, 1, 2u},
                     {0, {1, 1, -1}, {90, 0, 0}, 1, 1u}};
  return scene;
}

/// The same with a swarm of thousands of small spheres, of all materials and some in colours of
/// their own, that is shown 64 times, by itself and in pairs: enough to be shared.
inline Scene shared_scene() {
  Scene scene = grouped_scene();
  const auto swarm = static_cast<std::uint32_t>(scene.groups.size());
  Group spheres{"swarm", {}, {}, {}}, pair{"pair", {}, {}, {}};
  CaseRandom random(12);
  for (std::uint32_t i = 0; i < 2400; ++i) {
    const Vec3d at = random.direction() * random.uniform(0.1, 0.5);
    const MaterialRef plain = i % 7, colored = MaterialRef::colored(0, {200, 30, 90});
    spheres.spheres.push_back({vec_cast<float>(at), static_cast<float>(random.uniform(0.01, 0.03)),
                               i % 5 == 0 ? colored : plain});
  }
  for (const float x : {-0.5f, 0.5f})
    pair.instances.push_back({swarm, {x, 0, 0}, {0, 40 * x, 10}, 0.8f, {}});
  scene.groups.push_back(spheres);
  scene.groups.push_back(pair);
  for (std::uint32_t i = 0; i < 44; ++i) {
    Instance instance{swarm, {}, {}, 1, {}};
    if (i % 2 == 0 && i < 40) instance.group = swarm + 1;
    for (float* x : {&instance.translate.x, &instance.translate.y, &instance.translate.z})
      *x = static_cast<float>(random.uniform(-2, 2));
    for (float* x : {&instance.rotate.x, &instance.rotate.y, &instance.rotate.z})
      *x = static_cast<float>(random.uniform(-180, 180));
    instance.scale = static_cast<float>(random.uniform(0.3, 1.2));
    if (i % 6 == 0) instance.material = 2;
    scene.instances.push_back(instance);
  }
  return scene;
}

}  // namespace boule::test
