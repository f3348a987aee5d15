#include "bench/peers/referee.h"

#include <time.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "bench/peers/boule_peer.h"
#include "bench/peers/contender.h"
#include "bench/peers/double_tree.h"
#include "bench/peers/embree/embree_peer.h"
#include "bench/peers/judge.h"
#include "bench/peers/one_solve.h"
#include "bench/scenes/camera_rays.h"
#include "render/frame/scheduler.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

/// A contender and its rates so far, in Mray/s.
struct Entrant {
  std::unique_ptr<Contender> contender;
  std::vector<double> rates;
  std::size_t mismatches = 0;
  std::optional<OracleVerdict> oracle = {};

  [[nodiscard]] double best() const { return *std::max_element(rates.begin(), rates.end()); }
  [[nodiscard]] double median() const {
    std::vector<double> sorted = rates;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t middle = sorted.size() / 2;
    if (sorted.size() % 2 == 1) return sorted[middle];
    return (sorted[middle - 1] + sorted[middle]) / 2;
  }
};

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds that one pass over all rays takes: CPU time of the one thread, or wall clock. A pass
/// goes before it that is not timed: it would pay for what the contender before drove out of the
/// caches, and that is little where the one before reads the same copy of the rays, as Embree's do.
double time_pass(Contender& contender, const Workload& workload, unsigned threads) {
  const std::size_t size = workload.rays->size(), block_rays = block_size(workload);
  contender.prepare();
  contender.trace(0, size);
  contender.prepare();
  const clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  const double begin = seconds_of(clock);
  if (threads == 1) {
    contender.trace(0, size);
  } else {
    Scheduler scheduler(threads);
    scheduler.parallel_for()((size + block_rays - 1) / block_rays, [&](std::size_t block) {
      contender.trace(block * block_rays, std::min(size, (block + 1) * block_rays));
    });
  }
  return seconds_of(clock) - begin;
}

/// The best rate so far of Embree's contenders, or of Boule's, with the same instruction set.
double best_beside(const Entrant& entrant, const std::vector<Entrant>& all) {
  const Contender::Info& own = entrant.contender->info();
  double best = 0;
  for (const Entrant& e : all) {
    const Contender::Info& info = e.contender->info();
    const bool beside = info.embree == own.embree && info.isa == own.isa;
    if (beside && !e.rates.empty()) best = std::max(best, e.best());
  }
  return best;
}

bool is_out(const Entrant& entrant, const std::vector<Entrant>& all) {
  if (entrant.rates.empty()) return false;
  const double handicap = entrant.rates.size() == 1 ? 4 : 2;
  return entrant.best() * handicap < best_beside(entrant, all);
}

void run_one(Entrant& entrant, const Workload& workload, unsigned threads) {
  const std::size_t size = workload.rays->size();
  const double seconds = time_pass(*entrant.contender, workload, threads);
  entrant.rates.push_back(1e-6 * static_cast<double>(size) / seconds);
}

void judge_one(Entrant& entrant, const Judge& judge, OracleJudge& oracle, Answers& answers) {
  entrant.contender->answer(answers);
  const auto wrong = judge.mismatches(answers, entrant.contender->info().exact);
  entrant.mismatches = wrong.size();
  entrant.oracle = oracle.judge(answers, wrong);
}

/// In every repetition the contenders come in another order: of those that share a copy of the
/// rays, the later ones find it in the caches.
void run_all(std::vector<Entrant>& entrants, const Workload& workload, const Judge& judge,
             OracleJudge& oracle, const RefereeSettings& settings) {
  constexpr int fewest = 3;
  Answers answers;
  std::vector<std::size_t> order(entrants.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::minstd_rand random(1);
  const double begin = seconds_of(CLOCK_MONOTONIC);
  for (int repetition = 0; repetition < settings.repetitions; ++repetition) {
    const bool late = seconds_of(CLOCK_MONOTONIC) - begin > settings.patience;
    if (late && repetition >= fewest) return;
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t at : order) {
      Entrant& entrant = entrants[at];
      if (is_out(entrant, entrants)) continue;
      run_one(entrant, workload, settings.threads);
      if (repetition == 0) judge_one(entrant, judge, oracle, answers);
    }
  }
}

/// The best median of Embree's contenders, all or those of an instruction set; 0: there are none.
double best_embree(const std::vector<Entrant>& entrants, const std::string& isa = {}) {
  double best = 0;
  for (const Entrant& e : entrants) {
    const Contender::Info& info = e.contender->info();
    if (info.embree && (isa.empty() || info.isa == isa)) best = std::max(best, e.median());
  }
  return best;
}

std::vector<Row> make_rows(const std::vector<Entrant>& entrants, const Workload& workload) {
  const double best = best_embree(entrants);
  std::vector<Row> rows;
  for (const Entrant& e : entrants) {
    const Contender::Info& info = e.contender->info();
    Row row;
    row.scene = workload.scene->name;
    row.rays = name_of(workload.kind);
    row.contender = info.name;
    row.isa = info.isa;
    row.width = info.width;
    row.solver = info.solver;
    row.median = e.median();
    row.min = *std::min_element(e.rates.begin(), e.rates.end());
    row.max = e.best();
    row.repetitions = static_cast<int>(e.rates.size());
    row.ratio_to_best_embree = row.median / best;
    const double best_within = best_embree(entrants, info.isa);
    row.ratio_within_isa = best_within > 0 ? row.median / best_within : 0;
    row.mismatches = e.mismatches;
    row.oracle = e.oracle;
    row.exact = info.exact;
    rows.push_back(row);
  }
  return rows;
}

/// One scene and all that works on it.
class Arena {
 public:
  Arena(const RefereeSettings& settings, BenchScene scene)
      : settings_(settings),
        scene_(std::move(scene)),
        tree_(scene_),
        boule_(scene_, settings.isas),
        primary_(primary_rays(scene_, settings.side)),
        primary_judge_({&scene_, RayKind::primary, &primary_}, tree_, parallel_for_) {
    for (const std::string& isa : settings.embree_isas)
      embrees_.push_back(
          std::make_unique<EmbreePeer>(scene_, isa == "avx512" ? Isa::avx512 : Isa::avx2));
  }

  /// Runs all contenders on one kind of rays. No rows where the scene has no such rays.
  std::vector<Row> compare(RayKind kind, Check& check) {
    if (kind == RayKind::primary) {
      return compare({&scene_, kind, &primary_}, primary_judge_, check);
    }
    RayBuffer rays =
        make_rays(kind, scene_, {settings_.side, &primary_, &primary_judge_.truth().hits});
    const Workload workload = {&scene_, kind, &rays};
    if (rays.size() == 0) return {};
    return compare(workload, {workload, tree_, parallel_for_}, check);
  }

 private:
  std::vector<Row> compare(const Workload& workload, const Judge& judge, Check& check) {
    const std::size_t primitives = scene_.spheres.size() + scene_.capsules.size();
    const std::size_t samples =
        std::min({reference_samples, most_reference_tests / primitives, workload.rays->size()});
    check = {scene_.name, name_of(workload.kind), workload.rays->size(), samples,
             judge.differ_from_reference(samples, parallel_for_)};
    const std::vector<std::string> isas = embree_isas();
    if (settings_.threads == 1 && !isas.empty())
      check.one_solve = one_solve_rate(workload, isas.back());
    std::vector<Entrant> entrants;
    for (const auto& embree : embrees_) {
      for (auto& contender : embree->contenders(workload))
        entrants.push_back({std::move(contender), {}});
    }
    for (auto& contender : boule_.contenders(workload))
      entrants.push_back({std::move(contender), {}});
    OracleJudge oracle(workload, tree_);
    run_all(entrants, workload, judge, oracle, settings_);
    return make_rows(entrants, workload);
  }

  const RefereeSettings& settings_;
  BenchScene scene_;
  Scheduler scheduler_{0};
  ParallelFor parallel_for_ = scheduler_.parallel_for();
  DoubleTree tree_;
  std::vector<std::unique_ptr<EmbreePeer>> embrees_;
  BoulePeer boule_;
  RayBuffer primary_;
  Judge primary_judge_;
};

}  // namespace

std::vector<std::string> embree_isas() {
  std::vector<std::string> names;
  for (const IsaInfo& info : list_isas()) {
    const bool wanted = info.isa == Isa::avx2 || info.isa == Isa::avx512;
    if (wanted && info.supported) names.emplace_back(info.name);
  }
  return names;
}

Result<Results> compare(const RefereeSettings& settings,
                        const std::function<void(const Check&, const std::vector<Row>&)>& report) {
  Results results;
  for (const std::string& name : settings.scenes) {
    Result<BenchScene> scene = make_scene(name);
    if (!scene) return scene.error();
    Arena arena(settings, std::move(scene).value());
    for (const RayKind kind : settings.kinds) {
      Check check;
      const std::vector<Row> rows = arena.compare(kind, check);
      if (rows.empty()) continue;
      report(check, rows);
      results.checks.push_back(check);
      results.rows.insert(results.rows.end(), rows.begin(), rows.end());
    }
  }
  return results;
}

}  // namespace boule::bench
