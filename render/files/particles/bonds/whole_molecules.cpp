#include "render/files/particles/bonds/whole_molecules.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "render/files/particles/cell_fractions.h"
#include "render/files/particles/cell_images.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

ImagePlace sum(const ImagePlace& a, const ImagePlace& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
ImagePlace difference(const ImagePlace& a, const ImagePlace& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
ImagePlace place_of(const Bond& bond) { return {bond.image[0], bond.image[1], bond.image[2]}; }

/// Which particles are of one molecule, and how many vectors of the cell each moves so that it is
/// next to the others. A molecule is known by its first particle.
class Molecules {
 public:
  explicit Molecules(std::size_t count) : parents_(count), steps_(count), endless_(count) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  struct Member {
    std::uint32_t first = 0;  ///< of its molecule
    ImagePlace steps{};       ///< of the particle, if the first one stays
  };

  Member find(std::uint32_t particle) {
    ImagePlace steps{};
    while (parents_[particle] != particle) {
      const std::uint32_t parent = parents_[particle];
      steps_[particle] = sum(steps_[particle], steps_[parent]);  // none of the first one
      parents_[particle] = parents_[parent];
      steps = sum(steps, steps_[particle]);
      particle = parents_[particle];
    }
    return {particle, steps};
  }

  void join(const Bond& bond) {
    const Member a = find(bond.a), b = find(bond.b);
    const ImagePlace way = difference(sum(a.steps, place_of(bond)), b.steps);
    if (a.first == b.first) {
      if (way != ImagePlace{}) endless_[a.first] = 1;
      return;
    }
    const auto [low, high] = std::minmax(a.first, b.first);
    parents_[high] = low;
    steps_[high] = high == b.first ? way : difference({}, way);
    endless_[low] |= endless_[high];
  }

  [[nodiscard]] bool is_endless(std::uint32_t first) const { return endless_[first] != 0; }

 private:
  std::vector<std::uint32_t> parents_;  ///< earlier ones of the same molecule, or itself
  std::vector<ImagePlace> steps_;       ///< if the parent stays
  std::vector<std::uint8_t> endless_;   ///< of first particles
};

/// How many vectors of the cell each molecule moves back, by its first particle, so that the mean
/// of its positions lies in the cell. Precondition: members are moved together.
std::vector<ImagePlace> steps_into(const ParticleCell& cell, const CellFractions& fractions,
                                   const std::vector<Vec3d>& positions, Molecules& molecules) {
  std::vector<Vec3d> means(positions.size());
  std::vector<std::uint32_t> counts(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const std::uint32_t first = molecules.find(i).first;
    means[first] = means[first] + (positions[i] - positions[first]);
    ++counts[first];
  }
  const std::array<Vec3d, 3> vectors{cell.a, cell.b, cell.c};
  std::vector<ImagePlace> steps(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    if (counts[i] == 0 || molecules.is_endless(i)) continue;
    const Vec3d mean = positions[i] + means[i] * (1.0 / counts[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!cell.periodic[k] || vectors[k] == Vec3d{}) continue;
      constexpr double farthest = 1e9;
      const double cells = fractions.cells(k, mean);
      if (std::fabs(cells) <= farthest) steps[i][k] = -static_cast<std::int64_t>(cells);
    }
  }
  return steps;
}

}  // namespace

Result<std::size_t> join_molecules(const ParticleCell& cell, bool into_cell,
                                   std::vector<Vec3d>& positions, std::vector<Bond>& bonds) {
  const auto fractions = CellFractions::of(cell);
  if (!fractions) {
    return Diagnostic::about("unwrap", "the vectors of the file's cell lie in a plane or a line");
  }
  constexpr std::uint64_t of_particle = 3 * sizeof(ImagePlace);
  if (auto done = check_memory(of_particle * positions.size(), "whole molecules need", "unwrap");
      !done) {
    return done.error();
  }
  Molecules molecules(positions.size());
  for (const Bond& bond : bonds) molecules.join(bond);
  const CellImages places(cell, {1, 1, 1});
  const auto move = [&](std::uint32_t i, const ImagePlace& steps) {
    if (steps != ImagePlace{}) positions[i] = positions[i] + places.shift(steps);
  };
  std::size_t endless = 0;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const auto [first, steps] = molecules.find(i);
    if (!molecules.is_endless(first)) move(i, steps);
    if (first == i && molecules.is_endless(i)) ++endless;
  }
  for (Bond& bond : bonds) {
    if (!molecules.is_endless(molecules.find(bond.a).first)) bond.image = {};
  }
  if (!into_cell) return endless;
  const auto steps = steps_into(cell, *fractions, positions, molecules);
  for (std::uint32_t i = 0; i < positions.size(); ++i) move(i, steps[molecules.find(i).first]);
  return endless;
}

}  // namespace boule
