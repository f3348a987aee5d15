#include "core/scene/group.h"

namespace boule {

Similarity transform_of(const Instance& instance) {
  Similarity transform = rotation(vec_cast<double>(instance.rotate));
  transform.scale = static_cast<double>(instance.scale);
  transform.shift = vec_cast<double>(instance.translate);
  return transform;
}

Sphere transformed(const Sphere& sphere, const Similarity& transform,
                   std::optional<std::uint32_t> material) {
  return {vec_cast<float>(transform.apply(vec_cast<double>(sphere.center))),
          static_cast<float>(transform.scale * static_cast<double>(sphere.radius)),
          material ? MaterialRef(*material) : sphere.material};
}

Plane transformed(const Plane& plane, const Similarity& transform,
                  std::optional<std::uint32_t> material) {
  return {vec_cast<float>(transform.apply(vec_cast<double>(plane.point))),
          vec_cast<float>(transform.rotate(vec_cast<double>(plane.normal))),
          material ? MaterialRef(*material) : plane.material};
}

Capsule transformed(const Capsule& capsule, const Similarity& transform,
                    std::optional<std::uint32_t> material) {
  return {vec_cast<float>(transform.apply(vec_cast<double>(capsule.a))),
          vec_cast<float>(transform.apply(vec_cast<double>(capsule.b))),
          static_cast<float>(transform.scale * static_cast<double>(capsule.radius)),
          material ? MaterialRef(*material) : capsule.material};
}

}  // namespace boule
