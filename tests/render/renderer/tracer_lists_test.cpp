// All that rays cross, judged by long double; and the ends of rays, compared in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/reference.h"
#include "render/renderer/tracer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/ray_clouds.h"
#include "tests/render/renderer/overlapping_spheres.h"

namespace boule::test::tracer_lists {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Tracer make_tracer(const Scene& scene, const TraceOptions& options = {}) {
  return Tracer::create(scene, options).value();
}

struct Crossing {
  double t;
  std::int32_t id;
  bool entering;

  bool operator==(const Crossing&) const = default;
};

std::vector<std::vector<Crossing>> crossings(Tracer& tracer, const std::vector<Ray>& rays,
                                             std::optional<std::size_t> limit = {}) {
  const Crossings all = tracer.all_hits(rays, limit).value();
  EXPECT_EQ(all.offset.size(), rays.size() + 1);
  std::vector<std::vector<Crossing>> lists(rays.size());
  for (std::size_t k = 0; k < rays.size(); ++k) {
    for (auto i = static_cast<std::size_t>(all.offset[k]);
         i < static_cast<std::size_t>(all.offset[k + 1]); ++i)
      lists[k].push_back({all.t[i], all.id[i], all.entering[i] != 0});
  }
  return lists;
}

/// Whether a number is so close to an end that the rounding of t decides.
bool is_at(long double t, double end, double scale) {
  return std::fabs(t - static_cast<long double>(end)) < 1e-9L * scale;
}

TEST(TracerLists, CrossingsAreThoseOfLongDouble) {
  for (const SphereCase& scene : sphere_cases()) {
    Tracer tracer = make_tracer(objects(scene.spheres));
    const std::vector<Ray> rays = rays_of(scene, 300);
    const auto found = crossings(tracer, rays);
    const double scale = scene.name == "far" ? 4000 : 4;
    std::size_t checked = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      std::map<std::pair<std::int32_t, bool>, double> by_id;
      for (const Crossing& one : found[k]) by_id[{one.id, one.entering}] = one.t;
      ASSERT_EQ(by_id.size(), found[k].size()) << scene.name << " ray " << k;
      for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const LongChord chord = long_chord(rays[k], scene.spheres[i]);
        if (chord.unsure) continue;
        for (const bool entering : {true, false}) {
          const long double t = entering ? chord.enter : chord.leave;
          if (is_at(t, rays[k].tmin, scale) || is_at(t, rays[k].tmax, scale)) continue;
          const bool expected = chord.met && t > static_cast<long double>(rays[k].tmin) &&
                                t <= static_cast<long double>(rays[k].tmax);
          const auto at = by_id.find({static_cast<std::int32_t>(i), entering});
          ASSERT_EQ(at != by_id.end(), expected) << scene.name << " ray " << k << " id " << i;
          if (!expected) continue;
          ASSERT_LE(std::fabs(static_cast<double>(t) - at->second), 1e-9 * scale);
          ++checked;
        }
      }
    }
    EXPECT_GT(checked, 1000U) << scene.name;
  }
}

TEST(TracerLists, CrossingsComeInOrder) {
  for (const SphereCase& scene : sphere_cases()) {
    Tracer tracer = make_tracer(objects(scene.spheres, {{{0, 0, 0}, {0, 1, 0}}}));
    for (const auto& list : crossings(tracer, rays_of(scene, 300))) {
      for (std::size_t i = 1; i < list.size(); ++i) {
        const auto key = [](const Crossing& c) { return std::tuple(c.t, c.id, !c.entering); };
        ASSERT_LT(key(list[i - 1]), key(list[i])) << scene.name;
      }
    }
  }
}

TEST(TracerLists, TangentsPlanesAndTiesAreExact) {
  const Scene scene = objects({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 2, 0}, 1}},
                              {{{0, 0, 1}, {0, 0, 1}}, {{0, 0, -4}, {0, 0, -1}}});
  Tracer tracer = make_tracer(scene);
  const auto found = crossings(tracer, {Ray{{0, 1, 5}, {0, 0, -1}}, Ray{{0, 0, 5}, {0, 0, -1}}});
  const std::vector<Crossing> tangent = {
      {4, 3, true}, {5, 0, true}, {5, 1, true}, {5, 2, true}, {9, 4, false}};
  EXPECT_EQ(found[0], tangent);
  const std::vector<Crossing> through = {{4, 0, true},  {4, 1, true},  {4, 3, true},
                                         {6, 0, false}, {6, 1, false}, {9, 4, false}};
  EXPECT_EQ(found[1], through);
}

TEST(TracerLists, LimitKeepsTheFirst) {
  const SphereCase scene = sphere_cases()[0];
  Tracer tracer = make_tracer(objects(scene.spheres));
  const std::vector<Ray> rays = rays_of(scene, 2000);
  const auto all = crossings(tracer, rays);
  for (const std::size_t limit : {0U, 1U, 5U}) {
    const auto some = crossings(tracer, rays, limit);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const auto kept = static_cast<std::ptrdiff_t>(std::min(limit, all[k].size()));
      ASSERT_EQ(some[k], std::vector<Crossing>(all[k].begin(), all[k].begin() + kept));
    }
  }
  std::vector<TracedHit> hits(rays.size());
  ASSERT_TRUE(tracer.closest(rays, hits));
  for (std::size_t k = 0; k < rays.size(); ++k) {
    ASSERT_EQ(hits[k].id, all[k].empty() ? no_primitive : all[k][0].id);
    if (all[k].empty()) continue;
    ASSERT_EQ(hits[k].t, all[k][0].t);
    ASSERT_EQ(hits[k].entering, all[k][0].entering) << k;
  }
}

/// From hit to hit by tmin = t, every t appears once, as in the list; and each ray that ends at the
/// next one, or just before it, sees so.
TEST(TracerLists, NextHitsAreThoseOfTheList) {
  for (const SphereCase& scene : sphere_cases()) {
    for (const Solver solver : {Solver::robust, Solver::reference}) {
      Tracer tracer = make_tracer(objects(scene.spheres), {.solver = solver});
      std::vector<Ray> rays = rays_of(scene, 200);
      const auto lists = crossings(tracer, rays);
      for (int step = 0; step < 30; ++step) {
        std::vector<TracedHit> hits(rays.size());
        std::vector<std::uint8_t> met(rays.size()), before(rays.size()), until(rays.size());
        ASSERT_TRUE(tracer.closest(rays, hits));
        ASSERT_TRUE(tracer.any(rays, met));
        std::vector<Ray> shorter = rays, exact = rays;
        for (std::size_t k = 0; k < rays.size(); ++k) {
          const auto next = std::find_if(lists[k].begin(), lists[k].end(),
                                         [&](const Crossing& c) { return c.t > rays[k].tmin; });
          const bool expected = next != lists[k].end();
          ASSERT_EQ(hits[k].id, expected ? next->id : no_primitive) << scene.name << " ray " << k;
          ASSERT_EQ(met[k], expected ? 1 : 0) << scene.name << " ray " << k;
          const double t = expected ? next->t : inf;
          ASSERT_EQ(hits[k].t, t);
          if (expected) {
            ASSERT_EQ(hits[k].entering, next->entering);
            shorter[k].tmax = std::nextafter(t, -inf);
            exact[k].tmax = t;
          }
          rays[k].tmin = t;
        }
        ASSERT_TRUE(tracer.any(shorter, before));
        ASSERT_TRUE(tracer.any(exact, until));
        EXPECT_EQ(std::count(before.begin(), before.end(), 1), 0) << scene.name;
        EXPECT_EQ(until, met) << scene.name;
        ASSERT_TRUE(tracer.closest(shorter, hits));
        for (const TracedHit& hit : hits) ASSERT_EQ(hit.id, no_primitive);
      }
    }
  }
}

TEST(TracerLists, CountsAreTheLengthsOfLists) {
  const SphereCase scene = sphere_cases()[1];
  Tracer tracer = make_tracer(objects(scene.spheres));
  const std::vector<Ray> rays = rays_of(scene, 3000);
  const auto lists = crossings(tracer, rays);
  std::vector<std::int64_t> counts(rays.size());
  ASSERT_TRUE(tracer.count(rays, counts));
  for (std::size_t k = 0; k < rays.size(); ++k)
    ASSERT_EQ(static_cast<std::size_t>(counts[k]), lists[k].size());
  EXPECT_FALSE(tracer.count(rays, std::span(counts).first(1)));
}

/// The tree leaves out copies beyond the second, where more lie together than a leaf holds.
TEST(TracerLists, EveryCopyOfASphereIsCrossed) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 40; ++i) spheres.push_back({{0, 0, 0}, 1});
  for (int i = 0; i < 200; ++i)
    spheres.push_back({{3.0F * static_cast<float>(1 + i % 50), 0, 0}, 1});
  for (int i = 0; i < 30; ++i) spheres.push_back({{0, 0, 0}, 1e6F});  // outside the tree
  Tracer tracer = make_tracer(objects(spheres));
  const auto last = static_cast<std::int32_t>(spheres.size()) - 1;
  for (const std::int32_t source : {no_primitive, 0, 1, 2, 39, 250, 240, 241, last}) {
    for (const bool inside : {false, true}) {
      Ray ray{{-1, 0, 0}, {1, 0, 0}};
      ray.source = source;
      ray.inside = inside;
      std::vector<Crossing> expected;
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        const auto id = static_cast<std::int32_t>(i);
        const reference::Chord chord = reference::find_chord(ray, spheres[i], id == source);
        if (chord.enter > 0) expected.push_back({chord.enter, id, true});
        if (chord.leave > 0) expected.push_back({chord.leave, id, false});
      }
      std::sort(expected.begin(), expected.end(), [](const Crossing& a, const Crossing& b) {
        return std::tuple(a.t, a.id, !a.entering) < std::tuple(b.t, b.id, !b.entering);
      });
      EXPECT_EQ(crossings(tracer, {ray})[0], expected) << source << " " << inside;
    }
  }
}

TEST(TracerLists, SourcesAreLeftAsInSearches) {
  const Scene scene = objects({{{0, 0, 0}, 1}, {{5, 0, 0}, 1}});
  Tracer tracer = make_tracer(scene);
  Ray outside{{1, 0, 0}, {1, 0, 0}}, inside{{-1, 0, 0}, {1, 0, 0}};
  outside.source = inside.source = 0;
  inside.inside = true;
  const auto found = crossings(tracer, {outside, inside});
  const std::vector<Crossing> after = {{3, 1, true}, {5, 1, false}};
  EXPECT_EQ(found[0], after);
  const std::vector<Crossing> across = {{2, 0, false}, {5, 1, true}, {7, 1, false}};
  EXPECT_EQ(found[1], across);
}

TEST(TracerLists, SameForEveryIsaThreadAndCut) {
  const SphereCase scene = sphere_cases()[0];
  const std::vector<Ray> rays = rays_of(scene, 3000);
  Tracer reference = make_tracer(objects(scene.spheres), {.solver = Solver::reference});
  const auto expected = crossings(reference, rays);
  for (const IsaInfo& isa : list_isas()) {
    if (!select_kernels(std::string(isa.name))) continue;
    for (const unsigned threads : {1U, 3U}) {
      Tracer tracer =
          make_tracer(objects(scene.spheres), {.threads = threads, .isa = std::string(isa.name)});
      EXPECT_EQ(crossings(tracer, rays), expected) << isa.name;
      EXPECT_EQ(crossings(tracer, {rays[77]})[0], expected[77]);
    }
  }
}

TEST(TracerLists, BadRaysCrossNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto not_float = std::numeric_limits<float>::quiet_NaN();
  Tracer tracer = make_tracer(objects({{{0, 0, 0}, 1}}));
  std::vector<Ray> rays(6, Ray{{0, 0, 5}, {0, 0, -1}});
  rays[0].org.x = nan;
  rays[1].dir = {0, 0, 0};
  rays[2].dir.x = not_float;
  rays[3].tmin = nan;
  rays[4].tmax = nan;
  rays[5].org.z = inf;
  for (const auto& list : crossings(tracer, rays)) EXPECT_TRUE(list.empty());
  std::vector<double> lengths(rays.size(), -1);
  ASSERT_TRUE(tracer.chord(rays, lengths));
  for (const double length : lengths) EXPECT_EQ(length, 0);
  EXPECT_EQ(crossings(tracer, {}).size(), 0U);
}

TEST(TracerLists, SourcesOfColumnsAreChecked) {
  Tracer tracer = make_tracer(objects({{{0, 0, 0}, 1}}, {{{0, -3, 0}, {0, 1, 0}}}));
  const double org[] = {0, 0, 5}, dir[] = {0, 0, -1}, ends[] = {0, inf};
  const auto column = [](const double* first, std::ptrdiff_t step) {
    const void* const bytes = first;
    return RayNumbers{static_cast<const unsigned char*>(bytes), step, 8, true};
  };
  for (const double bad : {-2.0, 2.0, 0.5, inf, std::nan("")}) {
    const double sources[] = {-1, 1, bad};
    const RayColumns rays{3,
                          column(org, 0),
                          column(dir, 0),
                          column(ends, 0),
                          column(ends + 1, 0),
                          {},
                          column(sources, 8),
                          {}};
    std::uint8_t met[3];
    const Status status = tracer.any_of_columns(rays, met);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().key, "source");
    EXPECT_EQ(status.error().message.find("row 2: must be -1 or an id below 2, is "), 0U);
  }
}

}  // namespace
}  // namespace boule::test::tracer_lists
