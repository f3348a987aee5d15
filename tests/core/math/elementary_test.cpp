#include "core/math/elementary.h"

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <random>
#include <string>

#include <gtest/gtest.h>

// Every bound that elementary.h states, measured against MPFR with 160 bits.

namespace boule {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest_normal = std::numeric_limits<double>::min();
constexpr double below_half_pi = 0x1.921fb54442d18p0;  // the last double before pi / 2

/// An MPFR number that frees itself.
class Exact {
 public:
  explicit Exact(double value = 0) {
    mpfr_init2(value_, 160);
    mpfr_set_d(value_, value, MPFR_RNDN);
  }
  ~Exact() { mpfr_clear(value_); }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

/// |got - exact| in units of the last place of `exact`, a normal double.
double error_in_ulp(double got, Exact& exact) {
  const auto exponent = mpfr_get_exp(exact.get());
  Exact difference;
  mpfr_sub_d(difference.get(), exact.get(), got, MPFR_RNDN);
  mpfr_mul_2si(difference.get(), difference.get(), 53 - exponent, MPFR_RNDN);
  return std::fabs(mpfr_get_d(difference.get(), MPFR_RNDN));
}

/// A function with one argument more than it may need, and the same by MPFR.
struct Function {
  const char* name;
  double (*ours)(double x, double y);
  void (*exact)(Exact& result, Exact& x, Exact& y);
};

const Function exp_function{
    "exp", [](double x, double) { return elementary::exp(x); },
    [](Exact& result, Exact& x, Exact&) { mpfr_exp(result.get(), x.get(), MPFR_RNDN); }};
const Function pow_function{
    "pow", [](double x, double y) { return elementary::pow(x, y); },
    [](Exact& result, Exact& x, Exact& y) { mpfr_pow(result.get(), x.get(), y.get(), MPFR_RNDN); }};
const Function pow_for_float_function{
    "pow_for_float", [](double x, double y) { return elementary::pow_for_float(x, y); },
    [](Exact& result, Exact& x, Exact& y) { mpfr_pow(result.get(), x.get(), y.get(), MPFR_RNDN); }};
const Function tan_function{
    "tan", [](double x, double) { return elementary::tan_acute(x); },
    [](Exact& result, Exact& x, Exact&) { mpfr_tan(result.get(), x.get(), MPFR_RNDN); }};

const Function sine_function{
    "sine_ratio", [](double x, double) { return x * elementary::sine_ratio(x * x); },
    [](Exact& result, Exact& x, Exact&) { mpfr_sin(result.get(), x.get(), MPFR_RNDN); }};

double uniform(std::mt19937_64& bits, double low, double high) {
  return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
}

/// A family of arguments, and the error in ulp no normal result may reach.
struct Sweep {
  std::string name;
  Function function;
  double bound;
  std::function<void(std::mt19937_64& bits, double& x, double& y)> draw;
};

std::ostream& operator<<(std::ostream& out, const Sweep& sweep) { return out << sweep.name; }

TEST(ElementaryCosine, StaysBelowItsBound) {
  std::mt19937_64 bits(20240608);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = uniform(bits, -below_half_pi, below_half_pi);
    Exact exact_x(x), exact;
    mpfr_cos(exact.get(), exact_x.get(), MPFR_RNDN);
    Exact error;
    mpfr_sub_d(error.get(), exact.get(), elementary::cosine(x * x), MPFR_RNDN);
    worst = std::max(worst, std::fabs(mpfr_get_d(error.get(), MPFR_RNDN)));
  }
  EXPECT_LT(worst, 0x1p-52);
  EXPECT_EQ(elementary::cosine(0.0), 1);
  EXPECT_EQ(elementary::sine_ratio(0.0), 1);
}

class ElementarySweep : public testing::TestWithParam<Sweep> {};

TEST_P(ElementarySweep, StaysBelowItsBound) {
  const Sweep& sweep = GetParam();
  std::mt19937_64 bits(20240607);
  double worst = 0, worst_x = 0, worst_y = 0;
  int measured = 0;
  for (int i = 0; i < 100000; ++i) {
    double x = 0, y = 0;
    sweep.draw(bits, x, y);
    Exact exact_x(x), exact_y(y), exact;
    sweep.function.exact(exact, exact_x, exact_y);
    const double rounded = mpfr_get_d(exact.get(), MPFR_RNDN);
    const double got = sweep.function.ours(x, y);
    if (rounded == inf || got == inf) {
      ASSERT_EQ(got, rounded) << sweep.function.name << "(" << x << ", " << y << ")";
      continue;
    }
    if (rounded < smallest_normal) {
      // One unit of the denormals: they are rounded twice.
      ASSERT_LE(std::fabs(got - rounded), 0x1p-1074) << x << ", " << y;
      continue;
    }
    ++measured;
    const double error = error_in_ulp(got, exact);
    if (error > worst) {
      worst = error;
      worst_x = x;
      worst_y = y;
    }
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_GT(measured, 1000);
  EXPECT_LT(worst, sweep.bound) << std::hexfloat << worst_x << ", " << worst_y;
}

const Sweep sweeps[] = {
    {"ExpWholeRange", exp_function, 1,
     [](std::mt19937_64& bits, double& x, double&) { x = uniform(bits, -746, 710); }},
    {"ExpNearOne", exp_function, 1,
     [](std::mt19937_64& bits, double& x, double&) { x = uniform(bits, -2, 2); }},
    {"ExpTiny", exp_function, 1,
     [](std::mt19937_64& bits, double& x, double&) {
       x = std::ldexp(uniform(bits, -1, 1), -static_cast<int>(bits() % 1074));
     }},
    {"ExpDenormalResults", exp_function, 1,
     [](std::mt19937_64& bits, double& x, double&) { x = uniform(bits, -746, -708); }},
    {"Sine", sine_function, 3,
     [](std::mt19937_64& bits, double& x, double&) { x = uniform(bits, 0, below_half_pi); }},
    {"SineTiny", sine_function, 3,
     [](std::mt19937_64& bits, double& x, double&) {
       x = std::ldexp(uniform(bits, 0.5, 1), -static_cast<int>(bits() % 60));
     }},
    {"PowHighlight", pow_for_float_function, 0x1p15,  // what shading asks for
     [](std::mt19937_64& bits, double& x, double& y) {
       x = uniform(bits, 0, 1);
       y = uniform(bits, 0, 1) * std::min(200.0, -200 / std::log2(x));
     }},
    {"PowSharpHighlight", pow_for_float_function, 0x1p15,
     [](std::mt19937_64& bits, double& x, double& y) {
       x = 1 - std::exp(uniform(bits, -36, -1));
       y = uniform(bits, 0, 1) * -200 / std::log2(x);
     }},
    {"PowSmallBase", pow_for_float_function, 0x1p15,
     [](std::mt19937_64& bits, double& x, double& y) {
       x = std::exp(uniform(bits, -708, 0));
       y = uniform(bits, 0, 1) * -200 / std::log2(x);
     }},
    {"PowGamma", pow_function, 1,  // what tone asks for
     [](std::mt19937_64& bits, double& x, double& y) {
       x = uniform(bits, 0, 1);
       y = bits() % 2 == 0 ? 1 / 2.4 : 2.4;
     }},
    {"PowNearOne", pow_function, 1,
     [](std::mt19937_64& bits, double& x, double& y) {
       const double side = bits() % 2 == 0 ? 1 : -1;
       x = 1 + side * std::exp(uniform(bits, -36, -1));
       y = uniform(bits, -1, 1) * 708 / std::log(x);
     }},
    {"PowWholeRange", pow_function, 1,
     [](std::mt19937_64& bits, double& x, double& y) {
       x = std::exp(uniform(bits, -708, 709));
       y = uniform(bits, -1, 1) * 720 / std::log(x);
     }},
    {"PowDenormalBase", pow_function, 1,
     [](std::mt19937_64& bits, double& x, double& y) {
       x = std::exp(uniform(bits, -744, -708));
       y = uniform(bits, -1.1, 1.1);
     }},
    {"TanWholeRange", tan_function, 4,
     [](std::mt19937_64& bits, double& x, double&) { x = uniform(bits, 0, below_half_pi); }},
    {"TanTiny", tan_function, 4,
     [](std::mt19937_64& bits, double& x, double&) { x = std::exp(uniform(bits, -740, 0.45)); }},
    {"TanSteep", tan_function, 4,
     [](std::mt19937_64& bits, double& x, double&) {
       x = below_half_pi - std::exp(uniform(bits, -36, 0));
     }},
};
INSTANTIATE_TEST_SUITE_P(Mpfr, ElementarySweep, testing::ValuesIn(sweeps),
                         [](const auto& sweep) { return sweep.param.name; });

TEST(Elementary, PowForFloatAtTheEdges) {
  EXPECT_EQ(elementary::pow_for_float(1, 1e38), 1);
  EXPECT_EQ(elementary::pow_for_float(0.3, 0), 1);
  EXPECT_EQ(elementary::pow_for_float(0x1p-1074, 0), 1);
  EXPECT_EQ(elementary::pow_for_float(0x1p-1074, 0.5), 0);
  EXPECT_EQ(elementary::pow_for_float(0.5, 1e38), 0);
  EXPECT_EQ(elementary::pow_for_float(0.5, 3), 0.125);
  EXPECT_EQ(elementary::pow_for_float(1 - 0x1p-53, 1), 1 - 0x1p-53);
}

TEST(Elementary, ExpAtTheEdges) {
  EXPECT_EQ(elementary::exp(0.0), 1);
  EXPECT_EQ(elementary::exp(-0.0), 1);
  EXPECT_EQ(elementary::exp(0x1p-1074), 1);
  EXPECT_EQ(elementary::exp(1.0), 0x1.5bf0a8b145769p1);
  EXPECT_EQ(elementary::exp(inf), inf);
  EXPECT_EQ(elementary::exp(1e308), inf);
  EXPECT_EQ(elementary::exp(0x1.62e42fefa39fp9), inf);  // just above log of the greatest double
  EXPECT_EQ(elementary::exp(0x1.62e42fefa39efp9), 0x1.fffffffffff2ap1023);
  EXPECT_EQ(elementary::exp(-inf), 0);
  EXPECT_EQ(elementary::exp(-1e308), 0);
  EXPECT_EQ(elementary::exp(-0x1.74910d52d3051p9), 0x1p-1074);  // rounds to the least double
  EXPECT_EQ(elementary::exp(-0x1.74910d52d3052p9), 0);          // rounds to nothing
  EXPECT_TRUE(std::isnan(elementary::exp(nan)));
}

struct PowCase {
  double x, y, expected;
};

TEST(Elementary, PowIsExactWhereDocumented) {
  constexpr double least = 0x1p-1074, most = std::numeric_limits<double>::max();
  const PowCase cases[] = {
      {0, 0, 1},         {inf, 0, 1},        {5, 0, 1},           {5, -0.0, 1},
      {1, inf, 1},       {1, -inf, 1},       {1, most, 1},        {0, 3, 0},
      {-0.0, 3, 0},      {0, inf, 0},        {0, -3, inf},        {0, -inf, inf},
      {inf, 2, inf},     {inf, -2, 0},       {inf, inf, inf},     {inf, -inf, 0},
      {2, inf, inf},     {2, -inf, 0},       {0.5, inf, 0},       {0.5, -inf, inf},
      {most, 2, inf},    {most, -2, 0},      {least, 2, 0},       {least, -1, inf},
      {1.5, 1e300, inf}, {1.5, -1e300, 0},   {0.5, 1e300, 0},     {0.5, -1e300, inf},
      {2, 10, 1024},     {2, -1, 0.5},       {2, 1023, 0x1p1023}, {2, 1024, inf},
      {2, -1074, least}, {2, -1076, 0},      {4, 0.5, 2},         {3, 1, 3},
      {10, 3, 1000},     {0.25, 1.5, 0.125}, {7, least, 1},       {least, 1, least}};
  for (const PowCase& c : cases) {
    EXPECT_EQ(elementary::pow(c.x, c.y), c.expected) << "pow(" << c.x << ", " << c.y << ")";
  }
}

TEST(Elementary, PowOutsideItsDomainIsNaN) {
  EXPECT_TRUE(std::isnan(elementary::pow(-1.0, 2.0)));
  EXPECT_TRUE(std::isnan(elementary::pow(-inf, 1.0)));
  EXPECT_TRUE(std::isnan(elementary::pow(nan, 0.0)));
  EXPECT_TRUE(std::isnan(elementary::pow(nan, 1.0)));
  EXPECT_TRUE(std::isnan(elementary::pow(2.0, nan)));
  EXPECT_TRUE(std::isnan(elementary::pow(1.0, nan)));
}

TEST(Elementary, TanAtTheEdges) {
  EXPECT_EQ(elementary::tan_acute(0), 0);
  EXPECT_EQ(elementary::tan_acute(0x1p-1074), 0x1p-1074);
  EXPECT_EQ(elementary::tan_acute(1e-300), 1e-300);
  EXPECT_EQ(elementary::tan_acute(below_half_pi), 0x1.d02967c31cdb5p53);  // 1.633e16
  EXPECT_NEAR(elementary::tan_acute(elementary::pi / 4), 1, 0x1p-53);     // half a right angle
}

/// What a later reader of a curve relies on: a greater argument never gives a smaller value beyond
/// the error; here on steps much wider than the error, so strictly.
TEST(Elementary, FunctionsAreStrictlyMonotone) {
  for (double x = -700; x < 700; x += 0.37) {
    ASSERT_LT(elementary::exp(x), elementary::exp(x + 1e-10)) << x;
  }
  for (double x = 0.01; x < 50; x += 0.013) {
    ASSERT_LT(elementary::pow(x, 2.2), elementary::pow(x * (1 + 1e-12), 2.2)) << x;
    ASSERT_GT(elementary::pow(x, -2.2), elementary::pow(x * (1 + 1e-12), -2.2)) << x;
  }
  for (double x = 0; x < 1.57; x += 0.0007) {
    ASSERT_LT(elementary::tan_acute(x), elementary::tan_acute(x + 1e-12)) << x;
  }
}

TEST(Elementary, TanIsContinuousWhereTheFormulaChanges) {
  double x = elementary::pi / 4 - 200 * 0x1p-53;
  for (int i = 0; i < 400; ++i) {
    const double next = std::nextafter(x, 2.0);
    // A step of x is 2 x 2^-53 there, which the slope of 2 makes at most 2 ulp; errors of 4 each.
    ASSERT_NEAR(elementary::tan_acute(next), elementary::tan_acute(x), 10 * 0x1p-52) << i;
    x = next;
  }
}

}  // namespace
}  // namespace boule
