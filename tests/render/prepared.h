#pragma once

#include <utility>
#include <vector>

#include "render/prepare/prepared_scene.h"
#include "tests/support/test_scenes.h"

namespace boule::test {

/// A prepared scene of these primitives, which are matte.
inline PreparedScene prepared(std::vector<Sphere> spheres, std::vector<Plane> planes) {
  Scene scene = empty_scene(4, 4);
  add_material(scene, Matte{});
  scene.spheres = std::move(spheres);
  scene.planes = std::move(planes);
  return prepare(scene, 4, 4).value();
}

}  // namespace boule::test
