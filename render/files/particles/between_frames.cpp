#include "render/files/particles/between_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/scene/number_text.h"
#include "render/files/particles/cell_fractions.h"

namespace boule {
namespace {

constexpr double mix(double a, double b, double share) { return a + (b - a) * share; }
Vec3d mix(const Vec3d& a, const Vec3d& b, double share) { return a + (b - a) * share; }

Diagnostic other_particles(const std::string& what) {
  return Diagnostic::about("file",
                           what + ": to interpolate, all frames must have the same particles");
}

/// The rows of the next frame that have the particles of the first; none: the same rows.
Result<std::vector<std::size_t>> rows_of_next(const ParticleFrame& first,
                                              const ParticleFrame& next) {
  std::vector<std::size_t> rows;
  if (first.size() != next.size()) {
    return other_particles("a frame has " + std::to_string(first.size()) +
                           " particles, the next one " + std::to_string(next.size()));
  }
  const NumberColumn* const ids = find_number_column(first, "id");
  const NumberColumn* const others = find_number_column(next, "id");
  if (ids == nullptr || others == nullptr || ids->values == others->values) return rows;
  std::unordered_map<double, std::size_t> places;
  for (std::size_t i = 0; i < others->values.size(); ++i) {
    const double id = others->values[i];
    if (!places.emplace(id, i).second)
      return other_particles("a frame has the id " + number_text(id, 17) + " twice");
  }
  for (const double id : ids->values) {
    const auto found = places.find(id);
    if (found == places.end())
      return other_particles("the next frame has no id " + number_text(id, 17));
    rows.push_back(found->second);
  }
  return rows;
}

/// Moves positions within a periodic cell.
class CellMotion {
 public:
  static std::optional<CellMotion> of(const ParticleFrame& first, const ParticleFrame& next,
                                      double share) {
    if (!first.cell || !next.cell) return std::nullopt;
    const auto from = CellFractions::of(*first.cell), to = CellFractions::of(*next.cell);
    if (!from || !to) return std::nullopt;
    return CellMotion(*from, *to, *first.cell, *next.cell, share);
  }

  [[nodiscard]] const ParticleCell& cell() const { return cell_; }

  [[nodiscard]] Vec3d operator()(const Vec3d& a, const Vec3d& b) const {
    const auto vectors = vectors_of(cell_), of_next = vectors_of(next_);
    Vec3d end = b, back{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double first = from_.fraction(k, a), last = to_.fraction(k, b);
      const double cells = cell_.periodic[k] ? std::nearbyint(first - last) : 0;
      if (cells == 0) continue;
      end = end + of_next[k] * cells;
      if (has_changed_over(first, last, cells)) back = back + vectors[k] * cells;
    }
    return mix(a, end, share_) - back;
  }

 private:
  CellMotion(CellFractions from, CellFractions to, const ParticleCell& first,
             const ParticleCell& next, double share)
      : from_(from), to_(to), share_(share), cell_(first), next_(next) {
    for (Vec3d ParticleCell::*const vector :
         {&ParticleCell::a, &ParticleCell::b, &ParticleCell::c, &ParticleCell::origin})
      cell_.*vector = mix(first.*vector, next.*vector, share);
  }

  static std::array<Vec3d, 3> vectors_of(const ParticleCell& cell) {
    return {cell.a, cell.b, cell.c};
  }

  /// Whether a particle is already in the image in which it ends, `cells` from the one in which it
  /// begins.
  [[nodiscard]] bool has_changed_over(double first, double last, double cells) const {
    const auto is_inside = [](double fraction) { return fraction >= 0 && fraction <= 1; };
    if (!is_inside(first) || !is_inside(last)) return share_ >= 0.5;
    return !is_inside(mix(first, last + cells, share_));
  }

  CellFractions from_, to_;
  double share_;
  ParticleCell cell_, next_;
};

bool are_whole(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double number) { return number == std::nearbyint(number); });
}

/// Where one of the numbers is missing, the first stays.
void move_numbers(std::vector<double>& from, const std::vector<double>& to,
                  const std::vector<std::size_t>& rows, double share) {
  if (from.size() != to.size() || (are_whole(from) && are_whole(to))) return;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double moved = mix(from[i], to[rows.empty() ? i : rows[i]], share);
    if (!std::isnan(moved)) from[i] = moved;
  }
}

}  // namespace

Result<ParticleFrame> between_frames(ParticleFrame first, const ParticleFrame& next, double share) {
  const auto found = rows_of_next(first, next);
  if (!found) return found.error();
  const std::vector<std::size_t>& rows = found.value();
  const auto motion = CellMotion::of(first, next, share);
  for (std::size_t i = 0; i < first.size(); ++i) {
    Vec3d& position = first.positions[i];
    const Vec3d& end = next.positions[rows.empty() ? i : rows[i]];
    position = motion ? (*motion)(position, end) : mix(position, end, share);
  }
  if (motion) first.cell = motion->cell();
  for (NumberColumn& column : first.numbers) {
    const NumberColumn* const other = find_number_column(next, column.name);
    if (other != nullptr) move_numbers(column.values, other->values, rows, share);
  }
  if (first.time && next.time) first.time = mix(*first.time, *next.time, share);
  return first;
}

}  // namespace boule
