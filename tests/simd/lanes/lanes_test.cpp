// Every lane operation of every ISA against plain C++, bit for bit, special values included.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "simd/dispatch/cpu.h"
#include "tests/simd/lanes/lanes_probe.h"
#include "tests/support/case_random.h"

namespace boule {

namespace scalar {
void probe_lanes(const test::LaneInputs& in, test::LaneOutputs& out);
}
namespace sse42 {
void probe_lanes(const test::LaneInputs& in, test::LaneOutputs& out);
}
namespace avx2 {
void probe_lanes(const test::LaneInputs& in, test::LaneOutputs& out);
}
namespace avx512 {
void probe_lanes(const test::LaneInputs& in, test::LaneOutputs& out);
}
namespace neon {
void probe_lanes(const test::LaneInputs& in, test::LaneOutputs& out);
}

namespace test {
namespace {

struct Probe {
  Isa isa;
  const char* name;
  int width;
  bool fused;  ///< filter_fma rounds once
  void (*run)(const LaneInputs&, LaneOutputs&);
};
void PrintTo(const Probe& probe, std::ostream* out) { *out << probe.name; }

const Probe probes[] = {
    {Isa::scalar, "scalar", 1, false, scalar::probe_lanes},
#ifdef BOULE_HAS_SSE42
    {Isa::sse42, "sse42", 4, false, sse42::probe_lanes},
#endif
#ifdef BOULE_HAS_AVX2
    {Isa::avx2, "avx2", 8, true, avx2::probe_lanes},
#endif
#ifdef BOULE_HAS_AVX512
    {Isa::avx512, "avx512", 16, true, avx512::probe_lanes},
#endif
#ifdef BOULE_HAS_NEON
    {Isa::neon, "neon", 4, true, neon::probe_lanes},
#endif
};

/// Equal bits; any NaN equals any NaN, whose payload no ISA promises.
testing::AssertionResult same(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return testing::AssertionSuccess();
  if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << a << " is not " << b;
}
testing::AssertionResult same(float a, float b) {
  return same(static_cast<double>(a), static_cast<double>(b));
}

template <class T>
T draw(CaseRandom& random) {
  using limits = std::numeric_limits<T>;
  const T special[] = {T(0),
                       -T(0),
                       limits::infinity(),
                       -limits::infinity(),
                       limits::quiet_NaN(),
                       limits::denorm_min(),
                       limits::max(),
                       limits::min(),
                       T(1)};
  if (random.chance(0.3)) return special[random.below(9)];
  const double magnitude = std::exp2(random.uniform(-40, 40));
  return static_cast<T>(random.sign() * magnitude);
}

std::uint32_t draw_integer(CaseRandom& random) {
  constexpr std::uint32_t special[] = {0, 1, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};
  if (random.chance(0.3)) return special[random.below(6)];
  return static_cast<std::uint32_t>(random.uniform(0, 0x1p32)) >> random.below(32);
}

LaneInputs draw_inputs(CaseRandom& random) {
  LaneInputs in{};
  for (int i = 0; i < most_lanes; ++i) {
    in.a[i] = draw<float>(random);
    in.b[i] = random.chance(0.2) ? in.a[i] : draw<float>(random);
    in.c[i] = draw<float>(random);
    in.x[i] = draw<double>(random);
    in.y[i] = random.chance(0.2) ? in.x[i] : draw<double>(random);
    in.i[i] = draw_integer(random);
    in.j[i] = random.chance(0.2) ? in.i[i] : draw_integer(random);
    in.bytes[i] = static_cast<std::uint8_t>(random.chance(0.5) ? 0 : 1 + random.below(255));
  }
  for (std::uint16_t& number : in.sixteen) {
    number = static_cast<std::uint16_t>(draw_integer(random) >> 16);
  }
  return in;
}

class Lanes : public testing::TestWithParam<Probe> {
 protected:
  void SetUp() override {
    if (!cpu_supports(GetParam().isa)) GTEST_SKIP() << "this CPU has no " << GetParam().name;
  }
  /// Calls check(in, out, lane) for many draws and every lane.
  template <class Check>
  void for_all_lanes(const Check& check) {
    CaseRandom random(11);
    for (int round = 0; round < 3000; ++round) {
      const LaneInputs in = draw_inputs(random);
      LaneOutputs out{};
      GetParam().run(in, out);
      ASSERT_EQ(out.width, GetParam().width);
      for (int i = 0; i < out.width; ++i) check(in, out, i);
      if (HasFatalFailure()) return;
    }
  }
};

bool bit(unsigned mask, int lane) { return ((mask >> lane) & 1U) != 0; }

TEST_P(Lanes, FloatArithmetic) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    const float a = in.a[i], b = in.b[i], c = in.c[i];
    ASSERT_TRUE(same(out.add[i], a + b));
    ASSERT_TRUE(same(out.sub[i], a - b));
    ASSERT_TRUE(same(out.mul[i], a * b));
    ASSERT_TRUE(same(out.div[i], a / b));
    ASSERT_TRUE(same(out.sqrt[i], std::sqrt(a)));
    ASSERT_TRUE(same(out.abs[i], std::fabs(a)));
    ASSERT_TRUE(same(out.select[i], a < b ? a : c));
  });
}

TEST_P(Lanes, DoubleArithmetic) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    const double x = in.x[i], y = in.y[i];
    ASSERT_TRUE(same(out.wide_add[i], x + y));
    ASSERT_TRUE(same(out.wide_sub[i], x - y));
    ASSERT_TRUE(same(out.wide_mul[i], x * y));
    ASSERT_TRUE(same(out.wide_div[i], x / y));
    ASSERT_TRUE(same(out.wide_sqrt[i], std::sqrt(x)));
    ASSERT_TRUE(same(out.wide_abs[i], std::fabs(x)));
    ASSERT_TRUE(same(out.wide_copysign[i], std::copysign(x, y)));
    ASSERT_TRUE(same(out.wide_select[i], x < y ? x : y));
  });
}

TEST_P(Lanes, PartsOfDoubles) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    const double x = in.x[i];
    ASSERT_TRUE(same(out.power_of_two[i], std::ldexp(1, static_cast<int>(in.i[i] % 2046) - 1022)));
    if (!std::isnormal(x)) return;
    int exponent = 0;
    const double half = std::frexp(std::fabs(x), &exponent);
    ASSERT_TRUE(same(out.exponent[i], exponent - 1 + 1023));
    ASSERT_TRUE(same(out.mantissa[i], 2 * half));
  });
}

TEST_P(Lanes, FilterFmaIsFusedWhereSupported) {
  const bool fused = GetParam().fused;
  for_all_lanes([fused](const LaneInputs& in, const LaneOutputs& out, int i) {
    const float a = in.a[i], b = in.b[i], c = in.c[i];
    ASSERT_TRUE(same(out.fma[i], fused ? std::fma(a, b, c) : a * b + c));
    ASSERT_TRUE(same(out.fnma[i], fused ? std::fma(-a, b, c) : c - a * b));
  });
}

TEST_P(Lanes, Conversions) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    ASSERT_TRUE(same(out.widen[i], static_cast<double>(in.a[i])));
    ASSERT_TRUE(same(out.narrow[i], static_cast<float>(in.x[i])));
  });
}

TEST_P(Lanes, RowsAndColumns) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    const float row[4] = {in.a[i], in.b[i], in.c[i], out.add[i]};
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(same(out.rows[4 * i + k], row[k]));
      ASSERT_TRUE(same(out.columns[k][out.width - 1 - i], row[k]));
    }
  });
}

TEST_P(Lanes, Integers) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int k) {
    const std::uint32_t i = in.i[k], j = in.j[k];
    ASSERT_EQ(static_cast<std::int32_t>(out.truncated[k]), -static_cast<std::int32_t>(i >> 10));
    ASSERT_EQ(out.counted[k], 77U + static_cast<std::uint32_t>(k));
    ASSERT_EQ(out.integer_sum[k], i + j);
    ASSERT_EQ(out.integer_product[k], i * j);
    ASSERT_EQ(out.integer_and[k], i & j);
    ASSERT_EQ(out.integer_or[k], i | j);
    ASSERT_EQ(out.integer_xor[k], i ^ j);
    ASSERT_EQ(out.left_shift[k], i << 5);
    ASSERT_EQ(out.right_shift[k], i >> 5);
    ASSERT_EQ(out.integer_select[k], in.a[k] < in.b[k] ? i : j);
    ASSERT_EQ(out.signed_integers[k], static_cast<std::int32_t>(i));
    ASSERT_EQ(bit(out.integer_equal, k), i == j);
    ASSERT_EQ(bit(out.integer_less_equal, k), i <= j);
    ASSERT_EQ(out.integer_as_wide[k], static_cast<double>(i));
    for (int digit = 0; digit < 32; ++digit)
      ASSERT_EQ(out.reversed[k] >> digit & 1U, i >> (31 - digit) & 1U);
    ASSERT_EQ(bit(out.set_bytes, k), in.bytes[k] != 0);
    ASSERT_EQ(out.anywhere[k + 1], i);
    ASSERT_EQ(out.from_anywhere[k], i);
    ASSERT_TRUE(same(out.real_anywhere[k + 1], in.a[k]));
    ASSERT_TRUE(same(out.real_from_anywhere[k], in.a[k]));
    ASSERT_TRUE(same(out.wide_from_anywhere[k], in.x[k]));
  });
}

TEST_P(Lanes, ChosenLanesComeInOrder) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    if (i > 0) return;  // all at once
    int next = 1;
    for (int k = 0; k < out.width; ++k) {
      if (!(in.a[k] < in.b[k])) continue;
      ASSERT_TRUE(same(out.chosen[next], in.a[k]));
      ASSERT_EQ(out.chosen_integers[next], in.i[k]);
      ASSERT_EQ(out.chosen_signed[next], static_cast<std::int32_t>(in.i[k]));
      ASSERT_EQ(out.chosen_set[next], in.i[k] == in.j[k] ? 1 : 0);
      const auto whole = std::bit_cast<std::uint32_t>(std::fabs(in.a[k]));
      ASSERT_EQ(out.chosen_halves[next], whole >> 15);
      ++next;
    }
    for (; next <= out.width; ++next) ASSERT_EQ(out.chosen_halves[next], 0xffff);
    next = 1;
    for (int k = 0; k < out.width; ++k) {
      if (!(in.x[k] < in.y[k])) continue;
      ASSERT_TRUE(same(out.wide_chosen[next++], in.x[k]));
    }
  });
}

TEST_P(Lanes, LeastOfSixteen) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int) {
    ASSERT_LT(out.least_of_sixteen, 16U);
    const std::uint16_t least = in.sixteen[out.least_of_sixteen];
    ASSERT_EQ(least, *std::min_element(std::begin(in.sixteen), std::end(in.sixteen)));
  });
}

TEST_P(Lanes, ComparisonsAreOrdered) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    const float a = in.a[i], b = in.b[i];
    const double x = in.x[i], y = in.y[i];
    ASSERT_EQ(bit(out.less, i), a < b);
    ASSERT_EQ(bit(out.less_equal, i), a <= b);
    ASSERT_EQ(bit(out.equal, i), a == b);
    ASSERT_EQ(bit(out.mask_select, i), a < b ? a < in.c[i] : b <= in.c[i]);
    ASSERT_EQ(bit(out.wide_less, i), x < y);
    ASSERT_EQ(bit(out.wide_less_equal, i), x <= y);
    ASSERT_EQ(bit(out.wide_equal, i), x == y);
  });
}

TEST_P(Lanes, Masks) {
  for_all_lanes([](const LaneInputs& in, const LaneOutputs& out, int i) {
    const float a = in.a[i], b = in.b[i], c = in.c[i];
    const double x = in.x[i], y = in.y[i];
    ASSERT_EQ(bit(out.mask_and, i), a < b && a < c);
    ASSERT_EQ(bit(out.mask_or, i), a < b || a < c);
    ASSERT_EQ(bit(out.mask_not, i), !(a < b));
    ASSERT_EQ(bit(out.wide_and, i), x < y);
    ASSERT_EQ(bit(out.wide_or, i), x <= y);
    ASSERT_EQ(bit(out.wide_not, i), !(x < y));
    ASSERT_EQ(bit(out.widened_mask, i), a < b);
    ASSERT_EQ(bit(out.narrowed_mask, i), x < y);
    ASSERT_TRUE(bit(out.uniform_true, i));
    ASSERT_FALSE(bit(out.uniform_false, i));
    const unsigned full = (1U << out.width) - 1;
    ASSERT_EQ(out.any_less, out.less != 0);
    ASSERT_EQ(out.all_less, out.less == full);
    ASSERT_FALSE(out.any_none);
    ASSERT_TRUE(out.all_all);
    ASSERT_EQ(out.mask_not | out.less, full);
  });
}

INSTANTIATE_TEST_SUITE_P(Tables, Lanes, testing::ValuesIn(probes),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace test
}  // namespace boule
