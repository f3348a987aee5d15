// Compiled once per ISA: runs every lane operation on plain arrays. No test code in here, so that
// no wide instruction can leak into a function shared with the test program.
#include "tests/simd/lanes/lanes_probe.h"

#include "simd/lanes/lanes.h"

namespace boule::BOULE_KERNEL_ISA {

namespace {

void probe_integers(const test::LaneInputs& in, test::LaneOutputs& out) {
  const Real a = load(in.a), b = load(in.b);
  const Bits i = load_integers(in.i), j = load_integers(in.j);
  store(out.counted, count_from(77));
  store(out.integer_sum, i + j);
  store(out.integer_product, i * j);
  store(out.integer_and, i & j);
  store(out.integer_or, i | j);
  store(out.integer_xor, i ^ j);
  store(out.left_shift, i << 5);
  store(out.right_shift, i >> 5);
  store(out.integer_select, select(a < b, i, j));
  store(out.signed_integers, i);
  out.integer_equal = bits(load_integers(out.signed_integers) == j);
  out.integer_less_equal = bits(i <= j);
  store(out.integer_as_wide, to_wide(i));
  store(out.truncated, to_bits(Real(-0.25F) * narrow(to_wide(i >> 8))));
  store(out.reversed, reverse_bits(i));
  out.set_bytes = bits(load_set(in.bytes));
}

void probe_compressed(const test::LaneInputs& in, test::LaneOutputs& out) {
  const Real a = load(in.a), b = load(in.b);
  const Wide x = load(in.x), y = load(in.y);
  const Bits i = load_integers(in.i), j = load_integers(in.j);
  store_chosen(out.chosen + 1, a, bits(a < b));
  store_chosen(out.chosen_integers + 1, i, bits(a < b));
  store_chosen(out.chosen_signed + 1, i, bits(a < b));
  store_chosen(out.chosen_set + 1, i == j, bits(a < b));
  store_chosen(out.wide_chosen + 1, x, bits(x < y));
  store_chosen_halves(out.chosen_halves + 1, abs(a), a < b);
  store_anywhere(out.anywhere + 1, i);
  store(out.from_anywhere, load_anywhere(out.anywhere + 1));
  store_anywhere(out.real_anywhere + 1, a);
  store(out.real_from_anywhere, load_anywhere(out.real_anywhere + 1));
  for (int k = 0; k < width; ++k) out.wide_anywhere[k + 1] = in.x[k];
  store(out.wide_from_anywhere, load_anywhere(out.wide_anywhere + 1));
  out.least_of_sixteen = index_of_least(in.sixteen);
}

void probe_arithmetic(const test::LaneInputs& in, test::LaneOutputs& out) {
  const Real a = load(in.a), b = load(in.b), c = load(in.c);
  const Wide x = load(in.x), y = load(in.y);
  store(out.add, a + b);
  store(out.sub, a - b);
  store(out.mul, a * b);
  store(out.div, a / b);
  store(out.sqrt, sqrt(a));
  store(out.abs, abs(a));
  store(out.fma, filter_fma(a, b, c));
  store(out.fnma, filter_fnma(a, b, c));
  store(out.select, select(a < b, a, c));
  store(out.narrow, narrow(x));
  store(out.wide_add, x + y);
  store(out.wide_sub, x - y);
  store(out.wide_mul, x * y);
  store(out.wide_div, x / y);
  store(out.wide_sqrt, sqrt(x));
  store(out.wide_abs, abs(x));
  store(out.wide_copysign, copysign(x, y));
  store(out.wide_select, select(x < y, x, y));
  store(out.widen, widen(a));
  store(out.exponent, biased_exponent(abs(x)));
  store(out.mantissa, mantissa(x));
  alignas(64) double exponents[width];
  for (int i = 0; i < width; ++i) exponents[i] = static_cast<double>(in.i[i] % 2046) - 1022;
  store(out.power_of_two, power_of_two(load(exponents)));
}

void probe_rows(const test::LaneInputs& in, test::LaneOutputs& out) {
  const Real a = load(in.a), b = load(in.b), c = load(in.c);
  store_rows(out.rows, {a, b, c, a + b});
  const float* rows[width];
  for (int i = 0; i < width; ++i) rows[i] = out.rows + 4 * (width - 1 - i);
  const Columns columns = load_rows(rows);
  store(out.columns[0], columns.x);
  store(out.columns[1], columns.y);
  store(out.columns[2], columns.z);
  store(out.columns[3], columns.w);
}

void probe_masks(const test::LaneInputs& in, test::LaneOutputs& out) {
  const Real a = load(in.a), b = load(in.b), c = load(in.c);
  const Wide x = load(in.x), y = load(in.y);
  out.less = bits(a < b);
  out.less_equal = bits(a <= b);
  out.equal = bits(a == b);
  out.wide_less = bits(x < y);
  out.wide_less_equal = bits(x <= y);
  out.wide_equal = bits(x == y);
  out.mask_and = bits((a < b) & (a < c));
  out.mask_or = bits((a < b) | (a < c));
  out.mask_not = bits(~(a < b));
  out.wide_and = bits((x < y) & (x <= y));
  out.wide_or = bits((x < y) | (x == y));
  out.wide_not = bits(~(x < y));
  out.mask_select = bits(select(a < b, a < c, b <= c));
  out.widened_mask = bits(widen(a < b));
  out.narrowed_mask = bits(narrow(x < y));
  out.uniform_true = bits(uniform(true));
  out.uniform_false = bits(uniform(false));
  out.any_less = any(a < b);
  out.all_less = all(a < b);
  out.any_none = any((a < b) & ~(a < b));
  out.all_all = all((x < y) | ~(x < y));
}

}  // namespace

void probe_lanes(const test::LaneInputs& in, test::LaneOutputs& out) {
  out.width = width;
  probe_arithmetic(in, out);
  probe_rows(in, out);
  probe_masks(in, out);
  probe_integers(in, out);
  probe_compressed(in, out);
}

}  // namespace boule::BOULE_KERNEL_ISA
