// Random numbers of every kernel table against the scalar path, bit for bit.
#include "core/math/sobol.h"
#include "simd/stream/aligned_array.h"
#include "tests/support/expect_same.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::sobol_kernels {
namespace {

constexpr std::size_t count = 1003;  // the last packet is not whole

class SobolKernels : public OnEachIsa {};

TEST_P(SobolKernels, EqualTheScalarPath) {
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

INSTANTIATE_TEST_SUITE_P(Tables, SobolKernels, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::sobol_kernels
