#include "bench/scenes/stick_scenes.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "bench/scenes/particle_scenes.h"
#include "core/math/geometry.h"

namespace boule::bench {
namespace {

constexpr double shortest = 1, longest = 2.5, thickness = 0.15;  // of bonds, in angstrom
constexpr double ball_size = 0.25;                               // of an atom's radius
constexpr float edge_radius = 0.002F;                            // of the cell's edges

struct Pair {
  double squared_distance;
  std::size_t a, b;
};

/// Atoms in cubes of a given side, in lists.
class Grid {
 public:
  /// For points of -0.5 .. 0.5.
  Grid(double side, std::size_t atoms)
      : cells_(static_cast<std::size_t>(1 / side) + 3),
        side_(side),
        newest_(cells_ * cells_ * cells_, none),
        next_(atoms, none) {}

  /// Calls visit(other) for every atom that was added before, up to a cube's side away, and for
  /// others a little further away; then adds the atom.
  template <class Visit>
  void add(std::size_t atom, const Vec3d& at, const Visit& visit) {
    const std::size_t x = cell(at.x), y = cell(at.y), z = cell(at.z);
    for (std::size_t i = x - 1; i <= x + 1; ++i) {
      for (std::size_t j = y - 1; j <= y + 1; ++j) {
        for (std::size_t k = z - 1; k <= z + 1; ++k) {
          for (std::size_t other = list(i, j, k); other != none; other = next_[other]) visit(other);
        }
      }
    }
    next_[atom] = list(x, y, z);
    list(x, y, z) = atom;
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};

  [[nodiscard]] std::size_t cell(double place) const {
    return static_cast<std::size_t>((place + 0.5) / side_) + 1;
  }
  std::size_t& list(std::size_t i, std::size_t j, std::size_t k) {
    return newest_[(i * cells_ + j) * cells_ + k];
  }

  std::size_t cells_;
  double side_;
  std::vector<std::size_t> newest_;  ///< the last atom that each cube got
  std::vector<std::size_t> next_;    ///< the one before
};

/// All pairs of atoms that a bond can join.
std::vector<Pair> near_pairs(const std::vector<Sphere>& atoms, double angstrom) {
  Grid grid(longest * angstrom, atoms.size());
  const double low = shortest * angstrom, high = longest * angstrom;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const Vec3d at = vec_cast<double>(atoms[i].center);
    grid.add(i, at, [&](std::size_t other) {
      const Vec3d between = vec_cast<double>(atoms[other].center) - at;
      const double squared = dot(between, between);
      if (squared >= low * low && squared <= high * high) pairs.push_back({squared, other, i});
    });
  }
  return pairs;
}

std::vector<Capsule> bonds(const std::vector<Sphere>& atoms, double angstrom) {
  std::vector<Pair> pairs = near_pairs(atoms, angstrom);
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
    return std::tie(p.squared_distance, p.a, p.b) < std::tie(q.squared_distance, q.a, q.b);
  });
  pairs.resize(std::min(pairs.size(), atoms.size() * 51 / 50));
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& p, const Pair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  std::vector<Capsule> capsules;
  for (const Pair& pair : pairs) {
    const auto radius = static_cast<float>(thickness * angstrom);
    capsules.push_back({atoms[pair.a].center, atoms[pair.b].center, radius, {}});
  }
  return capsules;
}

BenchScene balls_and_sticks(const std::string& name, int n) {
  BenchScene scene = make_particle_scene("protein" + std::to_string(n)).value();
  scene.name = name;
  scene.capsules = bonds(scene.spheres, protein_angstrom(static_cast<std::size_t>(n)));
  for (Sphere& atom : scene.spheres) atom.radius *= static_cast<float>(ball_size);
  return scene;
}

BenchScene in_a_cell(const std::string& name, int n) {
  BenchScene scene = make_scene("u" + std::to_string(n)).value();
  scene.name = name;
  constexpr float low = 0.25F, high = 0.75F;
  for (const float u : {low, high}) {
    for (const float v : {low, high}) {
      scene.capsules.push_back({{low, u, v}, {high, u, v}, edge_radius, {}});
      scene.capsules.push_back({{u, low, v}, {u, high, v}, edge_radius, {}});
      scene.capsules.push_back({{u, v, low}, {u, v, high}, edge_radius, {}});
    }
  }
  return scene;
}

}  // namespace

std::optional<BenchScene> make_stick_scene(const std::string& name) {
  if (const auto n = number_after("sticks", name, 24, 1'000'000)) return balls_and_sticks(name, *n);
  if (const auto n = number_after("cell", name, 1, most_random)) return in_a_cell(name, *n);
  return std::nullopt;
}

}  // namespace boule::bench
