#include "bench/scenes/particle_scenes.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bench/scenes/random4.h"
#include "core/math/elementary.h"

namespace boule::bench {
namespace {

using elementary::pi;

std::array<double, 4> random_of(std::size_t item, std::uint32_t seed) {
  return random4(static_cast<std::uint32_t>(item), 0, seed);
}

Sphere sphere_at(const Vec3d& center, double radius) {
  return {vec_cast<float>(center), static_cast<float>(radius), 0};
}

/// A random point of the unit ball.
Vec3d point_in_ball(std::size_t item, std::uint32_t seed) {
  const auto u = random_of(item, seed);
  const double z = 2 * u[0] - 1, across = std::sqrt(1 - z * z), r = std::cbrt(u[2]);
  return Vec3d{across * std::cos(2 * pi * u[1]), across * std::sin(2 * pi * u[1]), z} * r;
}

/// The radius in angstrom of a ball of so many atoms, a tenth of one per cubic angstrom as in
/// proteins.
double globule_radius(std::size_t n) {
  constexpr double density = 0.1;
  return std::cbrt(3 * static_cast<double>(n) / (4 * pi * density));
}

/// Radii of H, C, N, O by their shares.
std::vector<Sphere> protein(std::size_t n) {
  constexpr std::size_t domains = 24;
  const double whole = globule_radius(n), unit = protein_angstrom(n);
  const double domain = whole / std::cbrt(double{domains});
  std::vector<Sphere> spheres(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d middle = point_in_ball(i % domains, 21) * whole;
    const Vec3d at = middle + point_in_ball(i, 22) * (1.2 * domain);
    const double kind = random_of(i, 23)[0];
    const double radius = kind < 0.5 ? 1.1 : kind < 0.82 ? 1.7 : kind < 0.91 ? 1.55 : 1.52;
    spheres[i] = sphere_at(at * unit, radius * unit);
  }
  return spheres;
}

/// On a grid of cells, moved within them, none reaching into its neighbour's cell.
std::vector<Sphere> ground(std::size_t n) {
  constexpr double planet = 100;
  const auto row = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  const double cell = 2.0 / static_cast<double>(row);
  std::vector<Sphere> spheres{sphere_at({0, 0, -planet}, planet)};
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const auto u = random_of(i, 24);
    const double radius = cell * (0.15 + 0.3 * u[0]), free = cell / 2 - radius;
    const double x = (static_cast<double>(i % row) + 0.5) * cell - 1 + free * (2 * u[1] - 1);
    const double y = (static_cast<double>(i / row) + 0.5) * cell - 1 + free * (2 * u[2] - 1);
    const double height = std::sqrt((planet + radius) * (planet + radius) - x * x - y * y);
    spheres.push_back(sphere_at({x, y, height - planet}, radius));
  }
  return spheres;
}

/// A normally distributed number (Box and Muller 1958), within three deviations.
double normal_number(const std::array<double, 4>& u) {
  const double z = std::sqrt(-2 * std::log(1 - u[0])) * std::cos(2 * pi * u[1]);
  return std::clamp(z, -3.0, 3.0);
}

std::vector<Sphere> grains(std::size_t n) {
  const double deviation = 4 * std::log(10.0) / 6;  // six of them are four decades
  const double squares = static_cast<double>(n) * pi * std::exp(2 * deviation * deviation);
  const double median = std::sqrt(4 / squares);
  std::vector<Sphere> spheres(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = random_of(i, 25);
    const double radius = median * std::exp(deviation * normal_number(random_of(i, 26)));
    spheres[i] = sphere_at({u[0] - 0.5, u[1] - 0.5, u[2] - 0.5}, radius);
  }
  return spheres;
}

std::vector<Sphere> ring(std::size_t n) {
  constexpr double inner = 0.5, outer = 1, thickness = 0.002, cover = 0.5;
  const double area = outer * outer - inner * inner;
  const double radius = std::sqrt(cover * area / static_cast<double>(n));
  std::vector<Sphere> spheres(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = random_of(i, 27);
    const double r = std::sqrt(inner * inner + area * u[0]), angle = 2 * pi * u[1];
    const Vec3d at{r * std::cos(angle), r * std::sin(angle), thickness * (u[2] - 0.5)};
    spheres[i] = sphere_at(at, radius * (0.5 + u[3]));
  }
  return spheres;
}

std::vector<Sphere> slab(std::size_t n) {
  const double radius = std::sqrt(4 / (pi * static_cast<double>(n)));
  std::vector<Sphere> spheres(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = random_of(i, 28);
    spheres[i] = sphere_at({u[0] - 0.5, u[1] - 0.5, 0.1 * (u[2] - 0.5)}, radius);
  }
  return spheres;
}

struct Kind {
  std::string_view letters;
  std::vector<Sphere> (*make)(std::size_t n);
  Vec3f eye, look_at;
  float fov, radius;
};

constexpr Kind kinds[] = {
    {"protein", protein, {0.9F, -1.1F, 0.5F}, {0, 0, 0}, 30, 0.5F},
    {"ground", ground, {0, -1.6F, 0.7F}, {0, -0.1F, 0}, 50, 1},
    {"grains", grains, {0.8F, -1.5F, 0.6F}, {0, 0, 0}, 35, 0.87F},
    {"ring", ring, {0, -2.2F, 0.0384F}, {0, 0, 0}, 56, 1},
    {"slab", slab, {0, -1, 0.6F}, {0, 0, 0}, 40, 0.71F},
};

}  // namespace

double protein_angstrom(std::size_t n) { return 1 / (3 * globule_radius(n)); }

std::optional<BenchScene> make_particle_scene(const std::string& name) {
  for (const Kind& kind : kinds) {
    const auto n = number_after(kind.letters, name, 10, 10'000'000);
    if (!n) continue;
    BenchScene scene;
    scene.name = name;
    scene.spheres = kind.make(static_cast<std::size_t>(*n));
    scene.camera.pose = {kind.eye, kind.look_at, {0, 0, 1}};
    scene.camera.fov = kind.fov;
    scene.light.position = {-1, -1.5F, 3};
    scene.radius = kind.radius;
    return scene;
  }
  return std::nullopt;
}

}  // namespace boule::bench
