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

}  // namespace boule::test
