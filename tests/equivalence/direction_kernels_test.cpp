// Random numbers and directions by them, of every kernel table against the scalar path, bit for
// bit.
#include <cmath>

#include "core/math/light_cone.h"
#include "core/math/sobol.h"
#include "core/math/warp.h"
#include "tests/support/case_random.h"
#include "tests/support/expect_same.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

constexpr std::size_t count = 1003;  // the last packet is not whole

/// A number in [0, 1), at times one of its ends.
double unit_number(CaseRandom& random, std::size_t i) {
  if (i % 17 == 0) return 0;
  if (i % 19 == 0) return 1 - 0x1p-32;
  return random.uniform(0, 1);
}

class Directions : public OnEachIsa {};

TEST_P(Directions, SobolPointsEqualTheScalarPath) {
  AlignedArray<std::uint32_t> sample(count), shuffle(count), seed_u(count), seed_v(count);
  AlignedArray<double> u(count), v(count);
  std::vector<UnitPair> expected;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t key = mix64(i);
    const auto set = static_cast<RandomSet>(i % 40);
    sample[i] =
        i % 3 == 0 ? static_cast<std::uint32_t>(mix64(i + 5)) : static_cast<std::uint32_t>(i);
    const SobolSeeds seeds = sobol_seeds(key, set);
    shuffle[i] = seeds.shuffle;
    seed_u[i] = seeds.u;
    seed_v[i] = seeds.v;
    expected.push_back(sobol_pair(key, set, sample[i]));
  }
  kernels->sobol_points(
      {sample.data(), shuffle.data(), seed_u.data(), seed_v.data(), u.data(), v.data(), count});
  for (std::size_t i = 0; i < count && !HasFailure(); ++i) {
    expect_same(u[i], expected[i].u);
    expect_same(v[i], expected[i].v);
  }
}

TEST_P(Directions, TurnsEqualTheScalarPath) {
  CaseRandom random(5);
  LocalDirectionBuffer turns;
  turns.resize(count);
  std::vector<Vec3d> expected;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d poles[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, -0.0}, {0, 1, 0}};
    const Vec3d axis = i % 7 == 0 ? poles[i % 4] : random.direction();
    const Angle from = warp_to_cosine(unit_number(random, i));
    const double around = i % 5 == 0 ? static_cast<double>(i % 9) / 8 : unit_number(random, i);
    turns.set(i, axis, from.cosine, from.sine, around);
    expected.push_back(direction_about(axis, from, around));
  }
  kernels->to_world(turns.view(count));
  for (std::size_t i = 0; i < count && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    expect_same(turns.direction(i), expected[i]);
  }
}

TEST_P(Directions, SoughtSpheresEqualTheScalarPath) {
  CaseRandom random(7);
  LightConeBuffer seek;
  seek.resize(count);
  struct Expected {
    Vec3d direction;
    double density;
    float tmax;
  };
  std::vector<Expected> expected;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d org = random.direction() * std::pow(10, random.uniform(-3, 9));
    const double radius = std::pow(10, random.uniform(-6, 6));
    // From within, from the surface, from near it, from where it is a point.
    const double away = i % 6 == 0   ? random.uniform(0, 1)
                        : i % 6 == 1 ? 1
                        : i % 6 == 2 ? 1 + 1e-9
                                     : 1 + std::pow(10, random.uniform(-6, 12));
    const Vec3d center = org + random.direction() * (radius * away);
    const UnitPair numbers{unit_number(random, i), unit_number(random, i + 1)};
    seek.set(i, org, center, radius, numbers.u, numbers.v);
    const LightCone cone(org, center, radius);
    const Vec3d direction = cone.direction(numbers);
    expected.push_back(
        {direction, cone.density(), static_cast<float>(cone.free_distance(direction))});
  }
  kernels->sample_cones(seek.view(count));
  std::size_t seen = 0;
  for (std::size_t i = 0; i < count && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    expect_same(seek.density(i), expected[i].density);
    if (!(expected[i].density > 0)) continue;
    ++seen;
    expect_same(seek.direction(i), expected[i].direction);
    EXPECT_EQ(seek.tmax(i), expected[i].tmax);
  }
  EXPECT_GT(seen, count / 2);
  EXPECT_LT(seen, count);
}

INSTANTIATE_TEST_SUITE_P(Tables, Directions, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
