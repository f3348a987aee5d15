#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "render/files/scene_file/loaded/scene_origin.h"

namespace boule {

/// Which spheres or capsules a .npy file holds: N x 4 numbers (centre, radius), or N x 3 and one
/// radius; of capsules N x 7 (a, b, radius), or N x 6 and one radius.
template <class Primitive>
struct NpyPrimitives {
  std::string path;
  std::optional<float> radius;  ///< above 0; required without a column of radii, refused with one
  MaterialRef material;         ///< of all of them
  bool is_scene = false;        ///< the file is the whole scene: no key can give a radius
  Vec3d origin{};               ///< subtracted from the points before they are rounded
};
using NpySpheres = NpyPrimitives<Sphere>;
using NpyCapsules = NpyPrimitives<Capsule>;

/// Appends the file's spheres: little-endian float32 or float64, C order, each number rounded to
/// float once. Sizes are checked before anything is allocated; a bad sphere is named by its row,
/// from 0 ("row 17"), the first one if there are several. On an error `spheres` is as it was. The
/// same for any threads. Passes on what `parallel_for` throws; the spheres may then be longer.
Status append_spheres(const NpySpheres& request, std::vector<Sphere>& spheres,
                      const ParallelFor& parallel_for = serial_for);
/// The same for capsules.
Status append_capsules(const NpyCapsules& request, std::vector<Capsule>& capsules,
                       const ParallelFor& parallel_for = serial_for);

/// The spheres of rows of four numbers of `width` bytes each, the first of which is row `first` of
/// its file, with centres counted from `origin`. An error as above.
Status decode_spheres(const unsigned char* rows, std::size_t width, std::uint64_t first,
                      const Vec3d& origin, std::span<Sphere> spheres,
                      const ParallelFor& parallel_for);

/// Where the file's spheres are, or the spheres around the ends of its capsules, before the origin
/// is subtracted and they are rounded. Nothing of a file that is refused.
SphereExtent extent_of(const NpySpheres& request, const ParallelFor& parallel_for = serial_for);
SphereExtent extent_of(const NpyCapsules& request, const ParallelFor& parallel_for = serial_for);

}  // namespace boule
