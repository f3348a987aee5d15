#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "render/files/scene_file/loaded/scene_origin.h"

namespace boule {

/// Which spheres a .npy file holds: N x 4 numbers (centre, radius), or N x 3 and one radius.
struct NpySpheres {
  std::string path;
  std::optional<float> radius;  ///< above 0; required for N x 3, refused for N x 4
  MaterialRef material;         ///< of all of them
  bool is_scene = false;        ///< the file is the whole scene: no key can give a radius
  Vec3d origin{};               ///< subtracted from the centres before they are rounded
};

/// Appends the file's spheres: little-endian float32 or float64, C order, each number rounded to
/// float once. Sizes are checked before anything is allocated; a bad sphere is named by its row,
/// from 0 ("row 17"), the first one if there are several. On an error `spheres` is as it was. The
/// same for any threads. Passes on what `parallel_for` throws; the spheres may then be longer.
Status append_spheres(const NpySpheres& request, std::vector<Sphere>& spheres,
                      const ParallelFor& parallel_for = serial_for);

/// Where the file's spheres are, before the origin is subtracted and they are rounded. Nothing of a
/// file that append_spheres() refuses.
SphereExtent extent_of(const NpySpheres& request, const ParallelFor& parallel_for = serial_for);

}  // namespace boule
