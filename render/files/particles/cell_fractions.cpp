#include "render/files/particles/cell_fractions.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

std::optional<CellFractions> CellFractions::of(const ParticleCell& cell) {
  const auto vectors = full_vectors(cell);
  if (!vectors) return std::nullopt;
  CellFractions fractions;
  fractions.origin_ = cell.origin;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& own = (*vectors)[i];
    // Across the two others, and as long as fractions of the own vector.
    const Vec3d normal = cross(unit_of((*vectors)[(i + 1) % 3]), unit_of((*vectors)[(i + 2) % 3]));
    const double height = dot(normal, own);
    constexpr double flattest = 1e-10;
    if (!(std::fabs(height) > flattest * long_length(own))) return std::nullopt;
    fractions.rows_[i] = normal * (1 / height);
  }
  return fractions;
}

}  // namespace boule
