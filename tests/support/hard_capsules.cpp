#include "tests/support/hard_capsules.h"

#include <cmath>
#include <string_view>

#include "tests/support/hard_rows.h"

namespace boule::test {
namespace {

constexpr CapsuleCaseSpec capsule_specs[] = {
    {"C0", 0},   {"C1", 2},   {"C1", 4},  {"C1", 7},  {"C2", 1},  {"C2", 3},  {"C2", 5},
    {"C2", 7},   {"C2", 9},   {"C2", 12}, {"C2", 20}, {"C3", 2},  {"C3", 4},  {"C3", 6},
    {"C4", 2},   {"C4", 4},   {"C4", 6},  {"C5", 4},  {"C5", 12}, {"C5", 20}, {"C5", 24},
    {"C6", 4},   {"C6", 12},  {"C6", 24}, {"C7", 0},  {"C7", 8},  {"C7", 20}, {"C8", 0},
    {"C9", -18}, {"C9", -12}, {"C9", 12}, {"C9", 17}, {"C10", 3}, {"C10", 5}, {"C10", 7}};

/// The frame of a capsule: its axis, and its length.
struct Axis {
  Vec3d a, unit;
  double length;

  explicit Axis(const Capsule& capsule) : a(vec_cast<double>(capsule.a)) {
    const Vec3d u = vec_cast<double>(capsule.b) - a;
    length = std::sqrt(dot(u, u));
    unit = length > 0 ? u * (1 / length) : Vec3d{0, 0, 1};
  }
};

bool is(const CapsuleCaseSpec& spec, std::string_view row) { return spec.row == row; }

/// Along one of the directions whose multiples are floats: rays can then be nearly parallel.
Vec3d even_direction(CaseRandom& random) {
  constexpr Vec3d directions[] = {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 2, 1}, {-1, 2, 2}};
  return directions[random.below(5)];
}

Capsule draw_capsule(CaseRandom& random, const CapsuleCaseSpec& spec) {
  const double scale = is(spec, "C9") ? power_of_ten(spec.k) : 1;
  const auto radius = static_cast<float>(random.uniform(0.5, 2) * scale);
  double length = random.decade(-1, 1.3) * double{radius};
  if (is(spec, "C3")) length = power_of_ten(spec.k) * double{radius};
  if (is(spec, "C4")) length = power_of_ten(-spec.k) * double{radius};
  if (is(spec, "C8")) length = 0;
  const double away = is(spec, "C10") ? power_of_ten(spec.k) : 5 * scale;
  Vec3f a = far_point(random, away);
  Vec3d along = random.direction() * length;
  if (is(spec, "C2")) {
    a = {std::round(a.x), std::round(a.y), std::round(a.z)};
    along = even_direction(random) * std::exp2(random.below(10) - 3);
  }
  return {a, vec_cast<float>(vec_cast<double>(a) + along), radius, {}};
}

/// A ray that comes through a point near the surface, or near the axis, from a distance.
Ray aim_at(CaseRandom& random, const Capsule& capsule, const CapsuleCaseSpec& spec) {
  const Axis axis(capsule);
  const double r = capsule.radius;
  const Vec3d side = random.perpendicular(axis.unit);
  double s = random.uniform(-0.2, 1.2);
  if (is(spec, "C6")) s = (random.chance(0.5) ? 1.0 : 0.0) + random.sign() * std::exp2(-spec.k);
  double away = random.uniform(0, 1.2);
  if (is(spec, "C5")) away = 1 + random.sign() * std::exp2(-spec.k);
  const Vec3d target = axis.a + axis.unit * (s * axis.length) + side * (away * r);
  Vec3d dir = random.direction();
  if (is(spec, "C5")) {  // along the surface, across the axis
    const double turn = random.uniform(0.2, 1);
    dir = normalize(cross(axis.unit, side) * turn + axis.unit * random.uniform(-1, 1));
  }
  double distance = random.uniform(3, 30) * r;
  if (is(spec, "C1")) distance = power_of_ten(spec.k) * r;
  if (is(spec, "C3")) distance = random.decade(0, spec.k) * r;
  Ray ray;
  ray.org = rounded(target - dir * distance);
  const double speed = random.chance(0.5) ? 1.0 : std::exp2(random.below(6) - 3);
  ray.dir = vec_cast<float>(dir * speed);
  if (random.chance(0.2)) ray.tmin = static_cast<float>(random.uniform(0, 1.2) * distance / speed);
  if (random.chance(0.2)) ray.tmax = static_cast<float>(random.uniform(0, 2) * distance / speed);
  return ray;
}

/// A ray along the tube: the axis is a small whole multiple of a direction, and the sine is exact.
Ray aim_along(CaseRandom& random, const Capsule& capsule, int k) {
  const Axis axis(capsule);
  const Vec3d side = random.perpendicular(axis.unit);
  const Vec3d lean = random.perpendicular(axis.unit);
  const Vec3d dir = axis.unit * random.sign() + lean * power_of_ten(-k);
  // Where the lean is below a float's unit, it can show only in components that are 0 otherwise.
  const double away = random.chance(0.5)
                          ? random.uniform(0, 1.05)
                          : 1 - random.uniform(0.1, 3) * power_of_ten(k < 10 ? -k : -10);
  const Vec3d target = axis.a + axis.unit * (random.uniform() * axis.length) +
                       side * (away * double{capsule.radius});
  Ray ray;
  ray.dir = vec_cast<float>(dir);
  ray.org = target - vec_cast<double>(ray.dir) * random.decade(-1, 3);
  return ray;
}

Ray start_within(CaseRandom& random, const Capsule& capsule, int k) {
  const Axis axis(capsule);
  const Vec3d side = random.perpendicular(axis.unit);
  const double off =
      k == 0 ? random.below(2) * random.uniform(0, 1.1) : 1 + random.sign() * std::exp2(-k);
  Ray ray;
  ray.org = rounded(axis.a + axis.unit * (random.uniform() * axis.length) +
                    side * (off * double{capsule.radius}));
  ray.dir = vec_cast<float>(random.direction());
  return ray;
}

Ray draw_ray(CaseRandom& random, const Capsule& capsule, const CapsuleCaseSpec& spec) {
  if (is(spec, "C2")) return aim_along(random, capsule, spec.k);
  if (is(spec, "C7")) return start_within(random, capsule, spec.k);
  return aim_at(random, capsule, spec);
}

std::uint64_t seed_of(const CapsuleCaseSpec& spec) {
  auto seed = static_cast<std::uint64_t>(spec.k + 1000);
  for (const char letter : std::string_view(spec.row))
    seed = seed * 257 + static_cast<std::uint64_t>(letter);
  return seed;
}

}  // namespace

std::string name_of(const CapsuleCaseSpec& spec) {
  if (spec.k < 0) return std::string(spec.row) + "_km" + std::to_string(-spec.k);
  return std::string(spec.row) + "_k" + std::to_string(spec.k);
}

std::span<const CapsuleCaseSpec> capsule_case_specs() { return capsule_specs; }

CapsuleCase make_capsule_case(const CapsuleCaseSpec& spec, std::size_t capsules, std::size_t rays) {
  CapsuleCase all;
  for (std::size_t i = 0; i < capsules; ++i) {
    CaseRandom random(seed_of(spec), i);
    all.capsules.push_back(draw_capsule(random, spec));
  }
  for (std::size_t i = 0; i < rays; ++i) {
    CaseRandom random(seed_of(spec), std::uint64_t{1} << 56U | i);
    all.rays.push_back(draw_ray(random, all.capsules[i % capsules], spec));
  }
  return all;
}

}  // namespace boule::test
