#include "render/files/particles/cell_images.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/chunks.h"
#include "render/files/particles/particle_columns.h"

namespace boule {
namespace {

bool is_zero(const Vec3d& v) { return v == Vec3d{}; }

double long_length(const Vec3d& v) { return std::hypot(v.x, v.y, v.z); }

Vec3d unit_of(const Vec3d& v) { return v * (1 / long_length(v)); }

/// A direction across v.
Vec3d across(const Vec3d& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  const Vec3d axis = x <= y && x <= z ? Vec3d{1, 0, 0} : y <= z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  return unit_of(cross(unit_of(v), axis));
}

/// The vectors of the cell, with some direction for those of length 0. Nothing if all are 0.
std::optional<std::array<Vec3d, 3>> full_vectors(const ParticleCell& cell) {
  std::array<Vec3d, 3> vectors{cell.a, cell.b, cell.c};
  const auto first = std::find_if_not(vectors.begin(), vectors.end(), is_zero);
  if (first == vectors.end()) return std::nullopt;
  for (Vec3d& vector : vectors) {
    if (!is_zero(vector)) continue;
    const Vec3d* other = nullptr;  // one more that is not 0
    for (const Vec3d& one : vectors) {
      if (!is_zero(one) && &one != &*first) other = &one;
    }
    vector = other == nullptr ? across(*first) : unit_of(cross(unit_of(*first), unit_of(*other)));
  }
  return vectors;
}

/// From positions to fractions of the cell's vectors.
class Fractions {
 public:
  /// Nothing if the vectors lie in a plane.
  static std::optional<Fractions> of(const ParticleCell& cell) {
    const auto vectors = full_vectors(cell);
    if (!vectors) return std::nullopt;
    Fractions fractions;
    fractions.origin_ = cell.origin;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d& own = (*vectors)[i];
      // Across the two others, and as long as fractions of the own vector.
      const Vec3d normal =
          cross(unit_of((*vectors)[(i + 1) % 3]), unit_of((*vectors)[(i + 2) % 3]));
      const double height = dot(normal, own);
      constexpr double flattest = 1e-10;
      if (!(std::fabs(height) > flattest * long_length(own))) return std::nullopt;
      fractions.rows_[i] = normal * (1 / height);
    }
    return fractions;
  }

  /// How many whole vectors i a position is away from the cell.
  [[nodiscard]] double cells(std::size_t i, const Vec3d& position) const {
    return std::floor(dot(rows_[i], position - origin_));
  }

 private:
  std::array<Vec3d, 3> rows_{};
  Vec3d origin_;
};

}  // namespace

Status wrap_into(const ParticleCell& cell, std::vector<Vec3d>& positions,
                 const ParallelFor& parallel_for) {
  const auto fractions = Fractions::of(cell);
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
                  if (!cell.periodic[k] || is_zero(vectors[k])) continue;
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

Vec3d CellImages::shift(std::size_t image) const {
  Vec3d shift{};
  const std::array<Vec3d, 3> vectors{cell_.a, cell_.b, cell_.c};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto count = static_cast<std::size_t>(counts_[k]);
    if (image % count > 0) shift = shift + vectors[k] * static_cast<double>(image % count);
    image /= count;
  }
  return shift;
}

}  // namespace boule
