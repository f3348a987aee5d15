// Throughput of ray-sphere and ray-plane tests: every ISA, solver and form against the plain scalar
// half-b loop and against the solvers of textbooks with as many lanes, in one run.
//
//   bench_intersect [--benchmark_filter=...]
//
// Repetitions are interleaved at random; the table at the end gives ratios of medians and of bests.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "bench/textbook/bench_data.h"
#include "bench/tools/ratio_reporter.h"
#include "simd/dispatch/dispatch.h"

namespace boule {

namespace bench {
namespace {

std::int64_t tests(const benchmark::State& state, const BenchData& data) {
  return static_cast<std::int64_t>(state.iterations()) *
         static_cast<std::int64_t>(data.rays.size() * (data.spheres.size() + data.planes.size()));
}

void run_kernel(benchmark::State& state, const KernelTable& kernels, const Query& query,
                BenchData& data) {
  const GeometryView geometry = data.geometry.view();
  const RayStream rays = data.rays.view();
  const HitStream hits = data.hits.view();
  for (auto _ : state) {
    kernels.closest_hit(geometry, rays, query, hits);
    benchmark::DoNotOptimize(hits.t);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(tests(state, data));
}

void run_book(benchmark::State& state, const BookSolver& solver, BenchData& data) {
  for (auto _ : state) {
    solver.nearest(data.book.data());
    benchmark::DoNotOptimize(data.book.data().t);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(tests(state, data));
}

/// A textbook's plain loop, compiled at -O3 for the base CPU.
void run_scalar_loop(benchmark::State& state, BenchData& data) {
  const BookData& d = data.book.data();
  for (auto _ : state) {
    for (std::size_t ray = 0; ray < d.rays; ++ray) {
      float best = std::numeric_limits<float>::infinity();
      for (std::size_t i = 0; i < d.spheres; ++i) {
        const float fx = d.center_x[i] - d.org_x[ray], fy = d.center_y[i] - d.org_y[ray];
        const float fz = d.center_z[i] - d.org_z[ray];
        const float b = fx * d.dir_x[ray] + fy * d.dir_y[ray] + fz * d.dir_z[ray];
        const float cc = fx * fx + fy * fy + fz * fz - d.radius[i] * d.radius[i];
        const float discriminant = b * b - cc;
        if (discriminant < 0) continue;
        const float half_chord = std::sqrt(discriminant);
        const float t = b - half_chord > 0 ? b - half_chord : b + half_chord;
        if (t > 0 && t < best) best = t;
      }
      d.t[ray] = best;
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(tests(state, data));
}

struct Named {
  const char* name;
  Query query;
};
const Named queries[] = {
    {"robust/packet", {Solver::robust, Form::packet, Coherence::none}},
    {"robust/single", {Solver::robust, Form::single, Coherence::none}},
    {"fast/packet", {Solver::fast, Form::packet, Coherence::none}},
};

void add(const std::string& name, auto run) { benchmark::RegisterBenchmark(name.c_str(), run); }

void register_book(const IsaInfo& info, const std::string& where, BenchData& data,
                   RatioReporter& reporter) {
  const std::string end = "/" + std::string(info.name) + where;
  for (const BookSolver& solver : book_solvers(info.isa)) {
    add(solver.name + end, [=, &data](auto& state) { run_book(state, solver, data); });
    if (solver.name != std::string("half_b")) reporter.compare(solver.name + end, "half_b" + end);
  }
}

void register_kernels(const std::string& kind, std::size_t n, RatioReporter& reporter) {
  BenchData* const data = &bench_data(kind, n);
  const std::string where = "/" + kind + "/" + std::to_string(n);
  const bool spheres = kind != "planes";
  if (spheres) add("scalar_loop" + where, [data](auto& state) { run_scalar_loop(state, *data); });
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    const KernelTable* const kernels = select_kernels(info.name).value();
    const std::string isa(info.name);
    if (spheres) register_book(info, where, *data, reporter);
    for (const Named& named : queries) {
      const Query query = named.query;
      const std::string name = isa + "/" + named.name + where;
      add(name, [=](auto& state) { run_kernel(state, *kernels, query, *data); });
      if (!spheres) reporter.compare(name, "scalar/robust/packet" + where);
      if (!spheres) continue;
      reporter.compare(name, "scalar_loop" + where);
      reporter.compare(name, "half_b/" + isa + where);
    }
  }
}

/// Checks that the contenders answer the same question: their hits agree to float's precision.
void check_answers(const std::string& kind, std::size_t n) {
  BenchData& data = bench_data(kind, n);
  const auto kernels = select_kernels("auto").value();
  kernels->closest_hit(data.geometry.view(), data.rays.view(), queries[0].query, data.hits.view());
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    for (const BookSolver& solver : book_solvers(info.isa)) {
      solver.nearest(data.book.data());
      std::size_t differ = 0;
      for (std::size_t i = 0; i < data.rays.size(); ++i) {
        const double t = data.hits.get(i).t, other = static_cast<double>(data.book.data().t[i]);
        differ += t == other || std::fabs(t - other) < 1e-3 ? 0U : 1U;
      }
      if (differ <= data.rays.size() / 100) continue;
      std::fprintf(stderr, "%s %s differs in %zu rays of %s\n", solver.name,
                   std::string(info.name).c_str(), differ, kind.c_str());
      std::exit(1);
    }
  }
}

}  // namespace
}  // namespace bench
}  // namespace boule

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  char repetitions[] = "--benchmark_repetitions=31", time[] = "--benchmark_min_time=0.01";
  char interleave[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, {repetitions, time, interleave});
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  boule::bench::RatioReporter reporter;
  for (const char* kind : {"sparse", "ordinary", "every"}) {
    boule::bench::check_answers(kind, 1000);
    boule::bench::register_kernels(kind, 1000, reporter);
  }
  boule::bench::register_kernels("planes", 64, reporter);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
