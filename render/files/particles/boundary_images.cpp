#include "render/files/particles/boundary_images.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/chunks.h"
#include "core/scene/scene.h"
#include "render/files/file/sphere_room.h"
#include "render/files/particles/cell_fractions.h"
#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"

namespace boule {

Result<BoundaryImages> BoundaryImages::find(const ParticleCell& cell,
                                            const std::array<int, 3>& counts,
                                            const std::vector<Vec3d>& positions,
                                            const ParallelFor& parallel_for) {
  const auto fractions = CellFractions::of(cell);
  if (!fractions) {
    return Diagnostic::about("boundary", "the vectors of the file's cell lie in a plane or a line");
  }
  const std::array<Vec3d, 3> vectors{cell.a, cell.b, cell.c};
  BoundaryImages found;
  found.counts_ = counts;
  found.faces_.resize(positions.size());
  in_chunks(parallel_for, positions.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      unsigned faces = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!cell.periodic[k] || vectors[k] == Vec3d{}) continue;
        const double at = fractions->fraction(k, positions[i]);
        if (std::fabs(at) <= tolerance) faces |= unsigned{before} << k;
        if (std::fabs(at - 1) <= tolerance) faces |= unsigned{behind} << k;
      }
      found.faces_[i] = static_cast<std::uint8_t>(faces);
    }
  });
  found.size_ = found.count();
  if (found.size_ > max_primitives) {
    return Diagnostic::about("boundary",
                             "more than " + std::to_string(max_primitives) + " spheres");
  }
  if (auto done = check_memory(bytes_of_spheres(found.size_),
                               std::to_string(found.size_) + " spheres need", "boundary");
      !done) {
    return done.error();
  }
  return found;
}

ImagePlace BoundaryImages::first_of(std::uint8_t faces) const {
  ImagePlace first{};
  for (std::size_t k = 0; k < 3; ++k) first[k] = (faces & (behind << k)) != 0 ? -1 : 0;
  return first;
}

ImagePlace BoundaryImages::last_of(std::uint8_t faces) const {
  ImagePlace last{};
  for (std::size_t k = 0; k < 3; ++k) last[k] = counts_[k] - ((faces & (before << k)) != 0 ? 0 : 1);
  return last;
}

bool BoundaryImages::is_of_cell(const ImagePlace& place) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (place[k] < 0 || place[k] >= counts_[k]) return false;
  }
  return true;
}

/// How many images there are.
std::size_t BoundaryImages::count() const {
  std::size_t count = 0;
  for (const std::uint8_t faces : faces_) {
    if (faces == 0) continue;
    const ImagePlace first = first_of(faces), last = last_of(faces);
    std::size_t shown = 1, of_cell = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      shown *= static_cast<std::size_t>(last[k] - first[k] + 1);
      of_cell *= static_cast<std::size_t>(counts_[k]);
    }
    count += shown - of_cell;
  }
  return count;
}

}  // namespace boule
