#include "render/renderer/scene_memory.h"

#include <cstdint>
#include <string>

#include "core/scene/instances.h"
#include "render/frame/memory.h"

namespace boule {
namespace {

constexpr std::uint64_t tree_bytes = 25;  // of a sphere

}  // namespace

Status check_scene_memory(const Scene& scene) {
  if (scene.instances.empty()) return std::nullopt;
  const PrimitiveCount count = count_primitives(scene);
  const std::uint64_t needed =
      count.spheres * (sizeof(Sphere) + tree_bytes) + count.planes * sizeof(Plane);
  const std::uint64_t available = available_memory();
  if (needed <= available) return std::nullopt;
  constexpr std::uint64_t mebibyte = 1024 * 1024;
  return Diagnostic{std::to_string(count.total()) +
                        " spheres and planes, with those of the "
                        "instances, need " +
                        std::to_string(needed / mebibyte) + " MiB of memory at least, there are " +
                        std::to_string(available / mebibyte),
                    "instance",
                    {},
                    0,
                    0};
}

}  // namespace boule
