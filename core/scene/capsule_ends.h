#pragma once

#include <array>
#include <functional>

#include "core/scene/instances.h"
#include "core/scene/primitive.h"
#include "core/scene/scene.h"

namespace boule {

/// The spheres around the ends of a capsule, which reach in every direction as far as it does.
inline std::array<Sphere, 2> end_spheres(const Capsule& capsule) {
  return {Sphere{capsule.a, capsule.radius, capsule.material},
          Sphere{capsule.b, capsule.radius, capsule.material}};
}

/// Calls the function with those of all capsules that a valid scene shows, those of its instances
/// included, a run of them at a time. Throws std::bad_alloc; exceptions of the function propagate.
void visit_end_spheres(const Scene& scene, const std::function<void(SphereRun)>& function);

}  // namespace boule
