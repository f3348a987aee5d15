#include "render/files/particles/bonds/bond_finder.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "core/base/chunks.h"
#include "core/math/geometry.h"
#include "render/files/particles/cell_fractions.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

using CellSteps = std::array<std::int32_t, 3>;  ///< whole vectors of the cell

/// The vectors along which a cell repeats.
class Period {
 public:
  explicit Period(const std::optional<ParticleCell>& cell) {
    if (!cell) return;
    fractions_ = CellFractions::of(*cell);
    vectors_ = {cell->a, cell->b, cell->c};
    for (std::size_t k = 0; k < 3; ++k) {
      repeats_[k] = fractions_ && cell->periodic[k] && vectors_[k] != Vec3d{};
    }
  }

  [[nodiscard]] bool any() const { return repeats_[0] || repeats_[1] || repeats_[2]; }
  [[nodiscard]] bool along(std::size_t k) const { return repeats_[k]; }
  [[nodiscard]] const CellFractions& fractions() const { return *fractions_; }

  /// How many vectors a position is away from the cell; 0 where that is too far to be told.
  [[nodiscard]] CellSteps steps_to(const Vec3d& position) const {
    CellSteps steps{};
    constexpr double farthest = 1e9;
    for (std::size_t k = 0; k < 3; ++k) {
      const double cells = repeats_[k] ? fractions_->cells(k, position) : 0;
      if (std::fabs(cells) <= farthest) steps[k] = static_cast<std::int32_t>(cells);
    }
    return steps;
  }

  [[nodiscard]] Vec3d shift(const CellSteps& steps) const {
    Vec3d shift{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (steps[k] != 0) shift = shift + vectors_[k] * static_cast<double>(steps[k]);
    }
    return shift;
  }

 private:
  std::optional<CellFractions> fractions_;
  std::array<Vec3d, 3> vectors_{};
  std::array<bool, 3> repeats_{};
};

CellSteps operator+(const CellSteps& a, const CellSteps& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
CellSteps operator-(const CellSteps& a) { return {-a[0], -a[1], -a[2]}; }

/// A particle, or an image of one near the cell.
struct BondPoint {
  Vec3d at;  ///< particles are moved into the cell
  std::uint32_t particle = 0;
  CellSteps image{};  ///< from where the frame has the particle
};

/// Points by small cubes, in a table of as many lists as there are points: a list may hold those of
/// several cubes.
class PointTable {
 public:
  PointTable(const std::vector<BondPoint>& points, double width) : width_(width) {
    mask_ = std::bit_ceil(points.size() | 1) - 1;
    starts_.resize(mask_ + 2);
    std::vector<std::uint32_t> lists(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      lists[i] = static_cast<std::uint32_t>(list_of(cube_of(points[i].at)));
      ++starts_[lists[i] + 1];
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    points_.resize(points.size());
    std::vector<std::uint64_t> ends(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) points_[ends[lists[i]]++] = points[i];
  }

  /// Calls visit(point) for each point of the cubes around, those in reach among them.
  template <class Visit>
  void around(const Vec3d& at, const Visit& visit) const {
    std::array<std::size_t, 27> lists{};
    const Cube middle = cube_of(at);
    std::size_t count = 0;
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          lists[count++] = list_of({middle[0] + x, middle[1] + y, middle[2] + z});
        }
      }
    }
    std::sort(lists.begin(), lists.end());
    const auto* const end = std::unique(lists.begin(), lists.end());
    for (const auto* list = lists.begin(); list != end; ++list) {
      for (std::uint64_t i = starts_[*list]; i < starts_[*list + 1]; ++i) visit(points_[i]);
    }
  }

 private:
  using Cube = std::array<std::int64_t, 3>;

  [[nodiscard]] Cube cube_of(const Vec3d& at) const {
    constexpr double farthest = 0x1p40;  // what is beyond shares the outermost cubes
    const auto place = [&](double x) {
      return static_cast<std::int64_t>(std::floor(std::clamp(x / width_, -farthest, farthest)));
    };
    return {place(at.x), place(at.y), place(at.z)};
  }

  [[nodiscard]] std::size_t list_of(const Cube& cube) const {
    std::uint64_t hash = 0;
    for (const std::int64_t place : cube) {
      hash = (hash ^ static_cast<std::uint64_t>(place)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 32;
    }
    return hash & mask_;
  }

  double width_;
  std::size_t mask_ = 0;
  std::vector<std::uint64_t> starts_;
  std::vector<BondPoint> points_;
};

struct FoundBond {
  Bond bond;
  double square;  ///< of its length
};

class BondFinder {
 public:
  BondFinder(const std::vector<Vec3d>& positions, const Period& period, const BondSearch& search)
      : positions_(positions), period_(period), search_(search) {}

  Result<std::vector<Bond>> run(std::uint64_t most, const ParallelFor& parallel_for) {
    const double reach = longest();
    if (!(reach > 0)) return std::vector<Bond>();
    if (auto done = make_points(reach); !done) return done.error();
    // Wider than what is reached, so that rounding never hides a neighbour.
    const PointTable table(std::exchange(points_, {}), reach * (1 + 0x1p-20));
    std::vector<std::vector<FoundBond>> parts(chunks_of(positions_.size()));
    std::atomic<std::uint64_t> count = 0;
    in_chunks(parallel_for, positions_.size(),
              [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end && count <= most; ++i) {
                  const std::size_t before = parts[chunk].size();
                  add_bonds_of(static_cast<std::uint32_t>(i), table, parts[chunk]);
                  count += parts[chunk].size() - before;
                }
              });
    if (count > most) {
      return Diagnostic::about("bonds", "there are more than " + std::to_string(most) +
                                            " bonds, for which there is no memory");
    }
    return chosen(parts, count);
  }

 private:
  [[nodiscard]] double longest() const {
    double most = 0;
    for (std::size_t i = 0; i < positions_.size(); ++i) most = std::max(most, search_.reach[i]);
    return most > 0 ? 2 * most + search_.tolerance : 0;
  }

  /// The particles that may have bonds, and their images in reach of the cell.
  Status make_points(double reach) {
    std::array<double, 3> margin{};
    double images = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!period_.along(k)) continue;
      margin[k] = reach * period_.fractions().steepness(k) * (1 + 0x1p-20) + 0x1p-30;
      images *= 1 + 2 * margin[k];
    }
    const double bytes = images * static_cast<double>(positions_.size()) * 2 * sizeof(BondPoint);
    constexpr double most = 0x1p62;
    if (auto done = check_memory(static_cast<std::uint64_t>(std::min(bytes, most)),
                                 "looking for bonds needs", "bonds");
        !done) {
      return done;
    }
    points_.reserve(positions_.size());
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      if (search_.reach[i] > 0) add_point(static_cast<std::uint32_t>(i), margin);
    }
    return {};
  }

  void add_point(std::uint32_t i, const std::array<double, 3>& margin) {
    const Vec3d& position = positions_[i];
    const CellSteps home = -period_.steps_to(position);
    CellSteps first{}, last{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!period_.along(k)) continue;
      const double at = std::clamp(period_.fractions().fraction(k, position) + home[k], 0.0, 1.0);
      first[k] = static_cast<std::int32_t>(std::ceil(-margin[k] - at));
      last[k] = static_cast<std::int32_t>(std::floor(1 + margin[k] - at));
    }
    for (std::int32_t x = std::min(first[0], 0); x <= std::max(last[0], 0); ++x) {
      for (std::int32_t y = std::min(first[1], 0); y <= std::max(last[1], 0); ++y) {
        for (std::int32_t z = std::min(first[2], 0); z <= std::max(last[2], 0); ++z) {
          const CellSteps image = home + CellSteps{x, y, z};
          points_.push_back({position + period_.shift(image), i, image});
        }
      }
    }
  }

  /// Those of a particle with later ones, and with its own images on one side.
  void add_bonds_of(std::uint32_t i, const PointTable& table, std::vector<FoundBond>& found) const {
    const double own = search_.reach[i] + search_.tolerance;
    if (!(search_.reach[i] > 0)) return;
    const double least = search_.nearest * search_.nearest;
    const CellSteps steps = period_.steps_to(positions_[i]);
    const Vec3d at = positions_[i] + period_.shift(-steps);
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    table.around(at, [&](const BondPoint& other) {
      if (other.particle < i) return;
      const Vec3d way = other.at - at;
      const double square = dot(way, way), reach = own + search_.reach[other.particle];
      if (!(square > least && square < reach * reach)) return;
      const CellSteps image = other.image + steps;
      if (other.particle == i && !(image > CellSteps{})) return;
      if (are_known(i, other.particle) || is_spent(i) || is_spent(other.particle)) return;
      found.push_back({{i, other.particle, image}, square});
    });
    std::sort(found.begin() + first, found.end(), [](const FoundBond& p, const FoundBond& q) {
      return std::tie(p.bond.b, p.bond.image) < std::tie(q.bond.b, q.bond.image);
    });
  }

  [[nodiscard]] bool are_known(std::uint32_t a, std::uint32_t b) const {
    return !search_.known.empty() && search_.known[a] != 0 && search_.known[b] != 0;
  }

  /// Its one bond is known.
  [[nodiscard]] bool is_spent(std::uint32_t i) const { return is_single(i) && are_known(i, i); }

  [[nodiscard]] bool is_single(std::uint32_t i) const {
    return !search_.single.empty() && search_.single[i] != 0;
  }

  /// The bonds in one list, those that single particles do not keep left out.
  [[nodiscard]] std::vector<Bond> chosen(std::vector<std::vector<FoundBond>>& parts,
                                         std::uint64_t count) const {
    std::vector<const FoundBond*> nearest(search_.single.empty() ? 0 : positions_.size());
    const auto offer = [&](std::uint32_t i, std::uint32_t other, const FoundBond& bond) {
      const FoundBond*& best = nearest[i];
      const auto rank = [&](std::uint32_t to, const FoundBond& one) {
        return std::pair(is_single(to), one.square);
      };
      if (best == nullptr ||
          rank(other, bond) < rank(best->bond.a == i ? best->bond.b : best->bond.a, *best)) {
        best = &bond;
      }
    };
    for (const auto& part : parts) {
      for (const FoundBond& one : part) {
        if (is_single(one.bond.a)) offer(one.bond.a, one.bond.b, one);
        if (is_single(one.bond.b)) offer(one.bond.b, one.bond.a, one);
      }
    }
    std::vector<Bond> bonds;
    bonds.reserve(count);
    for (auto& part : parts) {
      for (const FoundBond& one : part) {
        const auto keeps = [&](std::uint32_t i) { return !is_single(i) || nearest[i] == &one; };
        if (keeps(one.bond.a) && keeps(one.bond.b)) bonds.push_back(one.bond);
      }
    }
    return bonds;
  }

  const std::vector<Vec3d>& positions_;
  const Period& period_;
  const BondSearch& search_;
  std::vector<BondPoint> points_;
};

/// The image of `to` that is nearest to `from`; the one that the frame has, where others are no
/// nearer.
CellSteps nearest_image(const Vec3d& from, const Vec3d& to, const Period& period) {
  const Vec3d way = to - from;
  CellSteps near{};
  constexpr double farthest = 1e9;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!period.along(k)) continue;
    const double cells = period.fractions().fraction(k, to) - period.fractions().fraction(k, from);
    if (std::fabs(cells) <= farthest) near[k] = -static_cast<std::int32_t>(std::floor(cells + 0.5));
  }
  CellSteps best{};
  double least = dot(way, way);
  for (std::int32_t i = 0; i < 27; ++i) {
    CellSteps steps{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
    for (std::size_t k = 0; k < 3; ++k) steps[k] = period.along(k) ? steps[k] + near[k] : 0;
    const Vec3d moved = way + period.shift(steps);
    const double square = dot(moved, moved);
    if (!(square < least)) continue;
    least = square;
    best = steps;
  }
  return best;
}

}  // namespace

Result<std::vector<Bond>> find_bonds(const std::vector<Vec3d>& positions,
                                     const std::optional<ParticleCell>& cell,
                                     const BondSearch& search, std::uint64_t most,
                                     const ParallelFor& parallel_for) {
  const Period period(cell);
  return BondFinder(positions, period, search).run(most, parallel_for);
}

std::vector<Bond> nearest_images(const std::vector<ParticleBond>& bonds,
                                 const std::vector<Vec3d>& positions,
                                 const std::optional<ParticleCell>& cell) {
  const Period period(cell);
  std::vector<Bond> all;
  all.reserve(bonds.size());
  for (const auto& [a, b] : bonds) {
    const CellSteps image =
        period.any() ? nearest_image(positions[a], positions[b], period) : CellSteps{};
    all.push_back({a, b, image});
  }
  return all;
}

}  // namespace boule
