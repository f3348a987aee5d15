#include "bench/textbook/solver_speeds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bench/scenes/bench_scenes.h"
#include "bench/scenes/camera_rays.h"
#include "bench/textbook/book_arrays.h"
#include "bench/tools/thread_seconds.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"

namespace boule::bench {
namespace {

constexpr std::size_t stream_size = 1024;
constexpr std::size_t most_scanned = 2000;  // spheres

/// One scene in one structure, its rays, and room for the contenders' answers.
struct Arena {
  BenchScene scene;
  Structure structure;
  Geometry geometry;
  RayBuffer rays;
  HitBuffer hits, truth;
  BookArrays book;

  Arena(const BenchScene& what, Structure how, int side)
      : scene(what),
        structure(how),
        geometry(scene.spheres, {}, structure),
        rays(primary_rays(scene, side)),
        hits(rays.size()),
        truth(rays.size()),
        book(scene.spheres.size(), rays.size()) {
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) book.set(i, scene.spheres[i]);
    for (std::size_t i = 0; i < rays.size(); ++i) book.set(i, rays.get(i));
    if (structure == Structure::bvh) book.set(geometry.view());
  }
};

/// Calls part(first, size) for one stream after the other.
void for_each_stream(std::size_t rays, const auto& part) {
  for (std::size_t first = 0; first < rays; first += stream_size)
    part(first, std::min(stream_size, rays - first));
}

void run_kernel(Arena& arena, const KernelTable& kernels, const Query& query, HitBuffer& answers) {
  const GeometryView geometry = arena.geometry.view();
  const RayStream rays = arena.rays.view();
  const HitStream hits = answers.view();
  for_each_stream(rays.size, [&](std::size_t first, std::size_t size) {
    kernels.closest_hit(geometry, boule::part(rays, first, size), query,
                        boule::part(hits, first, size));
  });
}

void run_book(Arena& arena, const BookSolver& solver) {
  for_each_stream(arena.rays.size(), [&](std::size_t first, std::size_t size) {
    const BookData part = part_of(arena.book.data(), first, size);
    arena.structure == Structure::bvh ? solver.traverse(part) : solver.nearest(part);
  });
}

struct Contender {
  std::string isa, solver;
  std::function<void()> run;
  std::function<double(std::size_t)> t;  ///< what it has answered for a ray, or infinity
  std::vector<double> mrays_per_s;
};

const std::pair<const char*, Query> ours[] = {
    {"bundle", {Solver::robust, Form::automatic, Coherence::common_origin}},
    {"robust", {Solver::robust, Form::packet, Coherence::none}},
    {"fast", {Solver::fast, Form::packet, Coherence::none}},
};

std::vector<Contender> make_contenders(Arena& arena) {
  std::vector<Contender> all;
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    const KernelTable* const kernels = select_kernels(info.name).value();
    const std::string isa(info.name);
    for (const auto& [name, query] : ours) {
      all.push_back(
          {isa,
           name,
           [kernels, query = query, &arena] { run_kernel(arena, *kernels, query, arena.hits); },
           [&arena](std::size_t i) { return arena.hits.get(i).t; },
           {}});
    }
    for (const BookSolver& solver : book_solvers(info.isa)) {
      all.push_back(
          {isa,
           solver.name,
           [&arena, &solver] { run_book(arena, solver); },
           [&arena](std::size_t i) { return static_cast<double>(arena.book.data().t[i]); },
           {}});
    }
  }
  return all;
}

/// Runs every contender once more, beginning with a different one each time.
void take_turns(std::vector<Contender>& contenders, std::size_t turn, std::size_t rays) {
  for (std::size_t k = 0; k < contenders.size(); ++k) {
    Contender& contender = contenders[(turn + k) % contenders.size()];
    const double begin = thread_seconds();
    contender.run();
    const double seconds = thread_seconds() - begin;
    contender.mrays_per_s.push_back(1e-6 * static_cast<double>(rays) / seconds);
  }
}

std::size_t count_differing(const Contender& contender, const Arena& arena) {
  std::size_t differ = 0;
  for (std::size_t i = 0; i < arena.rays.size(); ++i) {
    const double t = contender.t(i), truth = arena.truth.get(i).t;
    const bool same = t == truth || std::fabs(t - truth) <= 1e-3 * truth;
    differ += same && std::isinf(t) == std::isinf(truth) ? 0 : 1;
  }
  return differ;
}

SolverSpeed summarize(Contender& contender, const Arena& arena) {
  std::vector<double>& speeds = contender.mrays_per_s;
  std::sort(speeds.begin(), speeds.end());
  contender.run();
  return {arena.scene.name,
          arena.structure == Structure::bvh ? "bvh" : "scan",
          contender.isa,
          contender.solver,
          speeds[speeds.size() / 2],
          speeds.front(),
          speeds.back(),
          arena.rays.size(),
          count_differing(contender, arena)};
}

std::vector<SolverSpeed> measure(Arena& arena, int repetitions) {
  run_kernel(arena, *select_kernels("auto").value(), ours[1].second, arena.truth);
  std::vector<Contender> contenders = make_contenders(arena);
  take_turns(contenders, 0, arena.rays.size());  // to warm up
  for (Contender& contender : contenders) contender.mrays_per_s.clear();
  for (int turn = 0; turn < repetitions; ++turn)
    take_turns(contenders, static_cast<std::size_t>(turn), arena.rays.size());
  std::vector<SolverSpeed> speeds;
  for (Contender& contender : contenders) speeds.push_back(summarize(contender, arena));
  return speeds;
}

}  // namespace

std::vector<SolverSpeed> measure_solver_speeds(const std::vector<std::string>& scenes,
                                               int repetitions, int side) {
  std::vector<SolverSpeed> all;
  for (const std::string& name : scenes) {
    const Result<BenchScene> scene = make_scene(name);
    if (!scene) throw std::runtime_error(scene.error().message);
    for (const Structure structure : {Structure::scan, Structure::bvh}) {
      if (structure == Structure::scan && scene.value().spheres.size() > most_scanned) continue;
      Arena arena(scene.value(), structure, side);
      const std::vector<SolverSpeed> speeds = measure(arena, repetitions);
      all.insert(all.end(), speeds.begin(), speeds.end());
    }
  }
  return all;
}

}  // namespace boule::bench
