// The errors of our solvers and of textbooks' solvers on the hard cases, in three columns: wrong
// decisions and roots, ulp of t, distance from the surface. First spheres, then capsules, beside
// Embree's round linear curves. The oracle of 1400 bits is the truth; bench_intersect measures the
// speed of the same code. Textbooks' solvers of spheres return t as a float, even those that
// compute it in double: where both roots round to neighbouring floats, the wrong root may be the
// nearer one.
//
//   bench_errors [rays per case, 2000]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "bench/errors/capsule_errors.h"
#include "bench/errors/hard_errors.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

void print_head(const char* residual_unit) {
  std::printf("%-9s %-24s %7s %7s | %9s %9s %9s | %11s\n", "case", "solver", "wrong", "wrong",
              "ulp of t", "", "", "residual,");
  std::printf("%-9s %-24s %7s %7s | %9s %9s %9s | %11s\n", "", "", "hit/mis", "roots", "p50", "p99",
              "max", residual_unit);
}

/// The sums and maxima over all cases.
struct Sum {
  std::size_t pairs = 0, wrong_decisions = 0, wrong_roots = 0;
  double worst_p99 = 0, residual = 0;
};

using Sums = std::map<std::string, Sum>;

/// A line for each contender in one case.
void print_case(const std::string& name, std::vector<HardErrors> rows, Sums& sums) {
  for (auto& [contender, figures] : rows) {
    const double p99 = figures.ulp_quantile(0.99), residual = figures.max_residual;
    std::printf("%-9s %-24s %7zu %7zu | %9.3g %9.3g %9.3g | %11.3g\n", name.c_str(),
                contender.c_str(), figures.wrong_decisions, figures.wrong_roots,
                figures.ulp_quantile(0.5), p99, figures.ulp_quantile(1), residual);
    Sum& sum = sums[contender];
    sum.pairs += figures.pairs;
    sum.wrong_decisions += figures.wrong_decisions;
    sum.wrong_roots += figures.wrong_roots;
    sum.worst_p99 = std::max(sum.worst_p99, p99);
    sum.residual = std::max(sum.residual, residual);
  }
}

void print_sums(const Sums& sums) {
  std::printf("\n%-24s %9s %9s %9s | %11s | %11s\n", "all cases", "pairs", "hit/mis", "roots",
              "worst p99", "residual");
  for (const auto& [name, sum] : sums) {
    std::printf("%-24s %9zu %9zu %9zu | %11.3g | %11.3g\n", name.c_str(), sum.pairs,
                sum.wrong_decisions, sum.wrong_roots, sum.worst_p99, sum.residual);
  }
}

void run(std::size_t rays) {
  const Isa isa = select_kernels("auto").value()->isa;
  Sums spheres, capsules;
  print_head("u max(F, r)");
  for (const test::HardCaseSpec& spec : sphere_cases())
    print_case(name_of(spec), hard_errors(spec, rays, isa), spheres);
  print_sums(spheres);
  std::printf("\n");
  print_head("u max(F,L,r)");
  for (const test::CapsuleCaseSpec& spec : test::capsule_case_specs())
    print_case(name_of(spec), capsule_errors(spec, rays), capsules);
  print_sums(capsules);
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  char* end = nullptr;
  const unsigned long rays = argc > 1 ? std::strtoul(argv[1], &end, 10) : 2000;
  if (argc > 2 || rays == 0 || (end != nullptr && *end != '\0')) {
    std::fprintf(stderr, "usage: bench_errors [rays per case, 2000]\n");
    return 2;
  }
  boule::bench::run(rays);
  return 0;
}
