#include "render/files/particles/cell_images.h"

#include <algorithm>
#include <cmath>

#include "core/base/chunks.h"
#include "render/files/particles/cell_fractions.h"
#include "render/files/particles/particle_columns.h"

namespace boule {

Status wrap_into(const ParticleCell& cell, std::vector<Vec3d>& positions,
                 const ParallelFor& parallel_for) {
  const auto fractions = CellFractions::of(cell);
  if (!fractions) {
    return Diagnostic::about("wrap", "the vectors of the file's cell lie in a plane or a line");
  }
  const std::array<Vec3d, 3> vectors{cell.a, cell.b, cell.c};
  std::vector<std::size_t> wrong(chunks_of(positions.size()), no_particle);
  in_chunks(parallel_for, positions.size(),
            [&](std::size_t chunk, std::size_t begin, std::size_t end) {
              constexpr double farthest = 1e9;
              for (std::size_t i = begin; i < end; ++i) {
                Vec3d shift{};
                bool moves = false;
                for (std::size_t k = 0; k < 3; ++k) {
                  if (!cell.periodic[k] || vectors[k] == Vec3d{}) continue;
                  const double cells = fractions->cells(k, positions[i]);
                  if (!(std::fabs(cells) <= farthest)) wrong[chunk] = std::min(wrong[chunk], i);
                  moves = moves || cells != 0;
                  shift = shift + vectors[k] * cells;
                }
                if (moves) positions[i] = positions[i] - shift;
              }
            });
  const std::size_t first =
      wrong.empty() ? no_particle : *std::min_element(wrong.begin(), wrong.end());
  if (first == no_particle) return {};
  return Diagnostic::about("wrap", particle_text(first, positions.size()) +
                                       " is more than 1e9 cells away from the cell");
}

std::size_t CellImages::size() const {
  std::size_t size = 1;
  for (const int count : counts_) size *= static_cast<std::size_t>(count);
  return size;
}

Vec3d CellImages::shift(std::size_t image) const { return shift(place(image)); }

ImagePlace CellImages::place(std::size_t image) const {
  ImagePlace place{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto count = static_cast<std::size_t>(counts_[k]);
    place[k] = static_cast<std::int64_t>(image % count);
    image /= count;
  }
  return place;
}

Vec3d CellImages::shift(const ImagePlace& place) const {
  Vec3d shift{};
  const std::array<Vec3d, 3> vectors{cell_.a, cell_.b, cell_.c};
  for (std::size_t k = 0; k < 3; ++k) {
    if (place[k] != 0) shift = shift + vectors[k] * static_cast<double>(place[k]);
  }
  return shift;
}

}  // namespace boule
