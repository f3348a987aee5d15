#pragma once

#include "core/scene/scene.h"
#include "tests/support/test_scenes.h"

namespace boule::test {

/// The mixed scene with capsules of all its materials in place of most of its spheres: some cross
/// each other, one has no length, one stands in the floor, one is thin.
inline Scene capsule_scene(int width, int height) {
  Scene scene = mixed_scene(width, height);
  scene.spheres.resize(3);
  scene.capsules = {
      {{-2.4F, 0.5F, -1}, {-1.2F, 2.4F, -2}, 0.35F, 0},
      {{1.2F, 0.5F, 0.5F}, {2.4F, 1.6F, -0.5F}, 0.4F, 3},
      {{1.2F, 1.6F, 0}, {2.4F, 0.5F, 0}, 0.2F, 2},
      {{0.8F, 0.3F, 2}, {0.8F, 0.3F, 2}, 0.3F, 1},
      {{-0.9F, -0.5F, 1.8F}, {-0.9F, 0.9F, 1.8F}, 0.25F, 5},
      {{-0.4F, 2.6F, -1}, {0.9F, 2.6F, -1}, 0.2F, 4},
      {{-3, 0.1F, 2.5F}, {3, 0.2F, 2.5F}, 0.02F, MaterialRef::colored(0, {9, 90, 200})}};
  return scene;
}

}  // namespace boule::test
