#include "bench/hard_errors.h"

#include <limits>

#include "bench/book_solvers.h"
#include "simd/build/geometry_builder.h"
#include "simd/build/stream_buffer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/oracle/hard_figures.h"

namespace boule::bench {
namespace {

using test::HardCase;

/// Pairs: ray i is aimed at sphere i % spheres.
struct Pairs {
  HardCase all;
  std::vector<std::optional<test::OracleHit>> truth;

  [[nodiscard]] const Sphere& sphere(std::size_t i) const {
    return all.spheres[i % all.spheres.size()];
  }
};

Pairs make_pairs(const test::HardCaseSpec& spec, std::size_t rays) {
  constexpr std::size_t rays_per_sphere = 64;
  Pairs pairs{make_hard_case(spec, (rays + rays_per_sphere - 1) / rays_per_sphere, rays), {}};
  for (std::size_t i = 0; i < rays; ++i) {
    Ray& ray = pairs.all.rays[i];
    ray.tmin = 0;  // textbooks' solvers know no other bounds
    ray.tmax = std::numeric_limits<float>::infinity();
    pairs.truth.push_back(test::oracle_hit(ray, pairs.sphere(i)));
  }
  return pairs;
}

HardErrors judge(const std::string& contender, const Pairs& pairs, const std::vector<double>& t) {
  test::HardFigures figures;
  for (std::size_t i = 0; i < t.size(); ++i)
    figures.add(pairs.all.rays[i], pairs.sphere(i), t[i], pairs.truth[i]);
  return {contender,
          figures.pairs,
          figures.hits,
          figures.wrong_decisions,
          figures.wrong_roots,
          figures.ulp_quantile(0.5),
          figures.ulp_quantile(0.99),
          figures.ulp_quantile(1),
          figures.max_residual};
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

/// The pairs as textbooks' solvers read them.
struct BookPairs {
  explicit BookPairs(const Pairs& pairs) {
    const std::size_t rays = pairs.all.rays.size();
    for (AlignedArray<float>* row : {&x, &y, &z, &ox, &oy, &oz, &dx, &dy, &dz, &t})
      row->resize(rays);
    r.resize(rays, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < rays; ++i) {
      const Sphere& sphere = pairs.sphere(i);
      const Ray& ray = pairs.all.rays[i];
      x[i] = sphere.center.x;
      y[i] = sphere.center.y;
      z[i] = sphere.center.z;
      r[i] = sphere.radius;
      ox[i] = static_cast<float>(ray.org.x);
      oy[i] = static_cast<float>(ray.org.y);
      oz[i] = static_cast<float>(ray.org.z);
      dx[i] = ray.dir.x;
      dy[i] = ray.dir.y;
      dz[i] = ray.dir.z;
    }
    data = {x.data(),  y.data(),  z.data(),  r.data(),  rays, ox.data(), oy.data(),
            oz.data(), dx.data(), dy.data(), dz.data(), rays, t.data()};
  }
  AlignedArray<float> x, y, z, r, ox, oy, oz, dx, dy, dz, t;
  BookData data{};
};

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

std::vector<HardErrors> hard_errors(const test::HardCaseSpec& spec, std::size_t rays, Isa isa) {
  const Pairs pairs = make_pairs(spec, rays);
  const KernelTable& kernels = *select_kernels(isa_name(isa)).value();
  std::vector<HardErrors> rows;
  rows.push_back(judge("robust", pairs, solve(pairs, kernels, Solver::robust)));
  rows.push_back(judge("fast", pairs, solve(pairs, kernels, Solver::fast)));
  BookPairs book(pairs);
  for (const BookSolver& solver : book_solvers(isa)) {
    solver.pairs(book.data);
    const float* const t = book.t.data();
    rows.push_back(judge(solver.name, pairs, std::vector<double>(t, t + rays)));
  }
  return rows;
}

}  // namespace boule::bench
