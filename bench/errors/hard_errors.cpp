#include "bench/errors/hard_errors.h"

#include <limits>
#include <utility>

#include "bench/textbook/book_arrays.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {
namespace {

using test::HardCase;

struct Pairs {
  HardCase all;
  std::vector<std::optional<test::OracleHit>> truth;

  [[nodiscard]] const Sphere& sphere(std::size_t i) const {
    return all.spheres[i % all.spheres.size()];
  }
};

Pairs judged_pairs(HardCase all) {
  Pairs pairs{std::move(all), {}};
  for (std::size_t i = 0; i < pairs.all.rays.size(); ++i) {
    Ray& ray = pairs.all.rays[i];
    ray.tmin = 0;  // the only bounds that textbooks' solvers have
    ray.tmax = std::numeric_limits<float>::infinity();
    pairs.truth.push_back(test::oracle_hit(ray, pairs.sphere(i)));
  }
  return pairs;
}

HardErrors judge(const std::string& contender, const Pairs& pairs, const std::vector<double>& t) {
  test::HardFigures figures;
  for (std::size_t i = 0; i < t.size(); ++i)
    figures.add(pairs.all.rays[i], pairs.sphere(i), t[i], pairs.truth[i]);
  return {contender, figures};
}

/// Each sphere by itself, with all rays that are aimed at it.
std::vector<double> solve(const Pairs& pairs, const KernelTable& kernels, Solver solver) {
  const std::size_t rays = pairs.all.rays.size(), spheres = pairs.all.spheres.size();
  std::vector<double> t(rays);
  for (std::size_t k = 0; k < spheres; ++k) {
    const Geometry geometry({pairs.all.spheres[k]}, {});
    const std::size_t count = (rays - k + spheres - 1) / spheres;
    RayBuffer stream(count);
    HitBuffer hits(count);
    for (std::size_t i = 0; i < count; ++i) stream.set(i, pairs.all.rays[k + i * spheres]);
    kernels.closest_hit(geometry.view(), stream.view(), {solver, Form::packet, Coherence::none},
                        hits.view());
    for (std::size_t i = 0; i < count; ++i) t[k + i * spheres] = hits.get(i).t;
  }
  return t;
}

}  // namespace

std::vector<test::HardCaseSpec> sphere_cases() {
  std::vector<test::HardCaseSpec> specs;
  for (const test::HardCaseSpec& spec : test::hard_case_specs()) {
    const std::string row = spec.row;
    const bool special = row == "S12";
    if (row[0] == 'S' && !special && !test::leaves_surfaces(spec)) specs.push_back(spec);
  }
  return specs;
}

std::vector<HardErrors> errors_of(HardCase all, Isa isa) {
  const Pairs pairs = judged_pairs(std::move(all));
  const std::size_t rays = pairs.all.rays.size();
  const KernelTable& kernels = *select_kernels(isa_name(isa)).value();
  std::vector<HardErrors> rows;
  rows.push_back(judge("robust", pairs, solve(pairs, kernels, Solver::robust)));
  rows.push_back(judge("fast", pairs, solve(pairs, kernels, Solver::fast)));
  BookArrays book(rays, rays);
  for (std::size_t i = 0; i < rays; ++i) {
    book.set(i, pairs.sphere(i));
    book.set(i, pairs.all.rays[i]);
  }
  for (const BookSolver& solver : book_solvers(isa)) {
    solver.pairs(book.data());
    const float* const t = book.data().t;
    rows.push_back(judge(solver.name, pairs, std::vector<double>(t, t + rays)));
  }
  return rows;
}

std::vector<HardErrors> hard_errors(const test::HardCaseSpec& spec, std::size_t rays, Isa isa) {
  constexpr std::size_t rays_per_sphere = 64;
  return errors_of(make_hard_case(spec, (rays + rays_per_sphere - 1) / rays_per_sphere, rays), isa);
}

}  // namespace boule::bench
