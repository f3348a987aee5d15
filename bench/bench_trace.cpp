// Throughput of the parts of a trace: rays per second of the camera and of nearest hits by each way
// of finding them, spheres per second of the build. Names: what/isa/solver/scene/n,
// camera/isa, build/scene/n, refit/scene/n, moved/how/share: rays through 100,000 spheres that have
// moved by this share of their distance, in a tree that was refitted or in a new one; `cost` is
// tree_cost() in that before.
//
//   bench_trace [--benchmark_filter='bundle/avx2/robust/u/100000']
//
// scan: no tree · single, packet: one form on the tree, no promise · bundle: primary rays declared
// to have one origin. 256 x 256 primary rays in streams of 16384. A figure by itself says little:
// compare two builds by their instructions (valgrind --tool=callgrind), peers by bench_peers.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench/scenes/bench_scenes.h"
#include "bench/scenes/camera_rays.h"
#include "core/optics/camera_builder.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"

namespace boule::bench {
namespace {

constexpr int side = 256;                                    // pixels
constexpr std::size_t stream_size = fitting_stream_size(0);  // rays, as the renderer has them

/// One scene in one structure, and the rays that are traced through it.
struct Trace {
  BenchScene scene;
  Geometry geometry;
  RayBuffer rays;
  HitBuffer hits;

  Trace(BenchScene what, Structure structure)
      : scene(std::move(what)),
        geometry(scene.spheres, {}, structure),
        rays(primary_rays(scene, side)),
        hits(rays.size()) {
    if (!scene.capsules.empty()) geometry.add_capsules(scene.capsules);
  }
};

/// The experiment's data, made at the first call and kept.
Trace& trace_of(const std::string& scene, Structure structure) {
  static std::map<std::pair<std::string, Structure>, std::unique_ptr<Trace>> made;
  auto& trace = made[{scene, structure}];
  if (!trace) trace = std::make_unique<Trace>(make_scene(scene).value(), structure);
  return *trace;
}

struct Experiment {
  const char* name;
  Structure structure;
  Form form;
  Coherence coherence;
};

void run_trace(benchmark::State& state, Trace& trace, const KernelTable& kernels,
               const Query& query) {
  const RayStream rays = trace.rays.view();
  const HitStream hits = trace.hits.view();
  for (auto _ : state) {
    for (std::size_t first = 0; first < rays.size; first += stream_size) {
      const RayStream part = boule::part(rays, first, std::min(stream_size, rays.size - first));
      kernels.closest_hit(trace.geometry.view(), part, query, boule::part(hits, first, part.size));
    }
    benchmark::DoNotOptimize(hits.t);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size));
}

void run_camera(benchmark::State& state, const KernelTable& kernels) {
  const BenchScene scene = make_scene("u1").value();
  const CameraView camera = build_camera(scene.camera, side, side);
  SampleBuffer samples = pixel_centers(side);
  samples.resize(stream_size);
  RayBuffer rays(stream_size, CommonPart::origin);
  for (auto _ : state) {
    kernels.primary_rays(camera, samples.view(), rays.view());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stream_size));
}

void run_build(benchmark::State& state, const std::string& name) {
  const BenchScene scene = make_scene(name).value();
  for (auto _ : state) {
    const Geometry geometry(scene.spheres, {});
    benchmark::DoNotOptimize(geometry.view());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.spheres.size()));
}

/// The spheres of a scene uN, each moved along every axis by up to this share of their distance.
std::vector<Sphere> moved(std::vector<Sphere> spheres, double share) {
  const double step = share / std::cbrt(static_cast<double>(spheres.size()));
  std::mt19937 random(1);
  const auto draw = [&] { return static_cast<float>(step * (random() * 0x1p-31 - 1)); };
  for (Sphere& sphere : spheres) {
    for (float* const x : {&sphere.center.x, &sphere.center.y, &sphere.center.z}) *x += draw();
  }
  return spheres;
}

void run_refit(benchmark::State& state, const std::string& name) {
  const BenchScene scene = make_scene(name).value();
  const std::vector<Sphere> places[] = {moved(scene.spheres, 0.1), scene.spheres};
  Geometry geometry(scene.spheres, {});
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(geometry.refit(places[next ^= 1]));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.spheres.size()));
}

void run_moved(benchmark::State& state, double share, bool refits) {
  Trace trace(make_scene("u100000").value(), Structure::bvh);
  const double before = trace.geometry.cost();
  const std::vector<Sphere> spheres = moved(trace.scene.spheres, share);
  if (refits) {
    trace.geometry.refit(spheres);
  } else {
    trace.geometry = Geometry(spheres, {}, Structure::bvh);
  }
  state.counters["cost"] = trace.geometry.cost() / before;
  run_trace(state, trace, *select_kernels("auto").value(), {});
}

void add(const std::string& name, auto run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
}

/// One experiment of one ISA on scene `kind` of size n, by both solvers; bundles know one only.
void add_trace(const Experiment& experiment, const IsaInfo& info, const std::string& kind,
               const std::string& n) {
  for (const Solver solver : {Solver::robust, Solver::fast}) {
    if (solver == Solver::fast && experiment.coherence != Coherence::none) continue;
    const KernelTable* const kernels = select_kernels(info.name).value();
    const Query query = {solver, experiment.form, experiment.coherence};
    const std::string name = std::string(experiment.name) + "/" + std::string(info.name) +
                             (solver == Solver::fast ? "/fast/" : "/robust/") + kind + "/" + n;
    add(name, [=, structure = experiment.structure](auto& state) {
      run_trace(state, trace_of(kind + n, structure), *kernels, query);
    });
  }
}

void add_all(const IsaInfo& info) {
  const Experiment scan = {"scan", Structure::scan, Form::packet, Coherence::none};
  const Experiment on_tree[] = {
      {"bundle", Structure::bvh, Form::automatic, Coherence::common_origin},
      {"single", Structure::bvh, Form::single, Coherence::none},
      {"flight", Structure::bvh, Form::flight, Coherence::none},
      {"set", Structure::bvh, Form::set, Coherence::none},
      {"packet", Structure::bvh, Form::packet, Coherence::none}};
  for (const char* n : {"16", "64", "256", "1000"}) add_trace(scan, info, "u", n);
  for (const Experiment& experiment : on_tree) {
    for (const char* n : {"16", "64", "256", "1000", "100000"}) add_trace(experiment, info, "u", n);
    add_trace(experiment, info, "flake", "4");
    if (experiment.form == Form::single) continue;
    for (const char* kind : {"u", "cell"}) add_trace(experiment, info, kind, "1000000");
  }
  const KernelTable* const kernels = select_kernels(info.name).value();
  add("camera/" + std::string(info.name), [=](auto& state) { run_camera(state, *kernels); });
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  using namespace boule::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const boule::IsaInfo& info : boule::list_isas()) {
    if (info.supported) add_all(info);
  }
  for (const std::string n : {"1000", "100000", "1000000"}) {
    add("build/u/" + n, [n](auto& state) { run_build(state, "u" + n); });
  }
  add("refit/u/1000000", [](auto& state) { run_refit(state, "u1000000"); });
  for (const char* share : {"0.1", "0.3", "0.5", "1", "2"}) {
    for (const bool refits : {true, false}) {
      add(std::string(refits ? "moved/refit/" : "moved/new/") + share,
          [=](auto& state) { run_moved(state, std::stod(share), refits); });
    }
  }
  add("build/flake/6", [](auto& state) { run_build(state, "flake6"); });
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
