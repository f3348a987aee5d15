// All that rays cross, judged by long double; and the ends of rays, compared in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "render/renderer/tracer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/ray_clouds.h"
#include "tests/support/case_random.h"

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

/// A chord in long double; `unsure`: the line is so close to the rim that rounding decides.
struct LongChord {
  bool met, unsure;
  long double enter, leave;
};
LongChord long_chord(const Ray& ray, const Sphere& sphere) {
  const auto d = vec_cast<long double>(ray.dir);
  const auto f = vec_cast<long double>(sphere.center) - vec_cast<long double>(ray.org);
  const long double r = sphere.radius, a = dot(d, d), middle = dot(f, d) / a;
  const auto aside = f - d * middle;
  const long double rest = r * r - dot(aside, aside);
  const long double doubt = 1e-13L * (r * r + dot(f, f));
  const long double half = std::sqrt(std::fmax(rest, 0.0L) / a);
  return {rest >= 0, std::fabs(rest) < doubt, middle - half, middle + half};
}

struct Case {
  std::string name;
  std::vector<Sphere> spheres;
  double spread;
};
/// Spheres that overlap, lie in each other, coincide, and are far from 0 for their size.
std::vector<Case> cases() {
  CaseRandom random(61);
  std::vector<Case> all;
  const auto point = [&](double spread) {
    const double x = random.uniform(-spread, spread), y = random.uniform(-spread, spread);
    return Vec3f{static_cast<float>(x), static_cast<float>(y),
                 static_cast<float>(random.uniform(-spread, spread))};
  };
  Case overlapping{"overlapping", {}, 2}, nested{"nested", {}, 2}, coincident{"coincident", {}, 2},
      far{"far", {}, 2};
  for (int i = 0; i < 400; ++i) {
    const auto r = static_cast<float>(random.uniform(0.05, 0.5));
    overlapping.spheres.push_back({point(1), r});
    nested.spheres.push_back({point(0.05), static_cast<float>(random.uniform(0.1, 1.5))});
    coincident.spheres.push_back({{static_cast<float>(i % 40) / 40, 0, 0}, 0.3F});
    const Vec3f near = point(1);
    far.spheres.push_back({{near.x + 1000, near.y - 2000, near.z + 3000}, r});
  }
  return {overlapping, nested, coincident, far};
}

std::vector<Ray> rays_of(const Case& scene, int count) {
  CaseRandom random(62);
  const Vec3d middle = scene.name == "far" ? Vec3d{1000, -2000, 3000} : Vec3d{};
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const Vec3d from = random.direction() * (random.uniform(0, 1) * scene.spread);
    Ray ray{middle + from, vec_cast<float>(random.direction() * random.uniform(0.5, 2))};
    if (i % 3 == 0) ray.tmin = random.uniform(-2, 1);
    if (i % 4 == 0) ray.tmax = random.uniform(0, 3);
    rays.push_back(ray);
  }
  return rays;
}

/// Whether a number is so close to an end that the rounding of t decides.
bool is_at(long double t, double end, double scale) {
  return std::fabs(t - static_cast<long double>(end)) < 1e-9L * scale;
}

TEST(TracerLists, CrossingsAreThoseOfLongDouble) {
  for (const Case& scene : cases()) {
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
  for (const Case& scene : cases()) {
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
  const Case scene = cases()[0];
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
  for (const Case& scene : cases()) {
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
  const Case scene = cases()[1];
  Tracer tracer = make_tracer(objects(scene.spheres));
  const std::vector<Ray> rays = rays_of(scene, 3000);
  const auto lists = crossings(tracer, rays);
  std::vector<std::int64_t> counts(rays.size());
  ASSERT_TRUE(tracer.count(rays, counts));
  for (std::size_t k = 0; k < rays.size(); ++k)
    ASSERT_EQ(static_cast<std::size_t>(counts[k]), lists[k].size());
  EXPECT_FALSE(tracer.count(rays, std::span(counts).first(1)));
}

/// The union by sweeping over all ends, which shares nothing with the merging of sorted spans.
long double swept_length(const Ray& ray, const std::vector<Sphere>& spheres) {
  std::vector<std::pair<long double, int>> ends;
  for (const Sphere& sphere : spheres) {
    const LongChord chord = long_chord(ray, sphere);
    if (!chord.met) continue;
    const long double low = std::fmax(chord.enter, static_cast<long double>(ray.tmin));
    const long double high = std::fmin(chord.leave, static_cast<long double>(ray.tmax));
    if (!(low < high)) continue;
    ends.emplace_back(low, 1);
    ends.emplace_back(high, -1);
  }
  std::sort(ends.begin(), ends.end());
  long double length = 0;
  int depth = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (depth > 0) length += ends[i].first - ends[i - 1].first;
    depth += ends[i].second;
  }
  return length;
}

TEST(TracerLists, ChordsOfTheUnionAreExact) {
  for (const Case& scene : cases()) {
    Tracer tracer = make_tracer(objects(scene.spheres, {{{0, 0.1F, 0}, {0, 1, 0}}}));
    const std::vector<Ray> rays = rays_of(scene, 500);
    std::vector<double> lengths(rays.size());
    ASSERT_TRUE(tracer.chord(rays, lengths));
    const SphereChords each = tracer.chords(rays).value();
    const double scale = scene.name == "far" ? 4000 : 4;
    double most = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      // A chord that misses by rounding is shorter than sqrt(1e-13) of the scale.
      const auto exact = static_cast<double>(swept_length(rays[k], scene.spheres));
      ASSERT_NEAR(lengths[k], exact, 2e-6 * scale) << scene.name << " ray " << k;
      most = std::max(most, lengths[k]);
      std::int32_t last = -1;
      for (auto i = static_cast<std::size_t>(each.offset[k]);
           i < static_cast<std::size_t>(each.offset[k + 1]); ++i) {
        ASSERT_LT(last, each.id[i]);
        last = each.id[i];
        const LongChord chord = long_chord(rays[k], scene.spheres[static_cast<std::size_t>(last)]);
        const long double low = std::fmax(chord.enter, static_cast<long double>(rays[k].tmin));
        const long double high = std::fmin(chord.leave, static_cast<long double>(rays[k].tmax));
        ASSERT_NEAR(each.length[i], static_cast<double>(high - low), 2e-6 * scale);
      }
    }
    EXPECT_GT(most, 0.3) << scene.name;
  }
}

TEST(TracerLists, ChordsOfKnownSpheresAreExact) {
  const Scene scene = objects({{{0, 0, 0}, 2}, {{0, 0, 0}, 1}, {{3, 0, 0}, 2}, {{9, 0, 0}, 1}});
  Tracer tracer = make_tracer(scene);
  const auto length = [&](Ray ray) {
    double value = -1;
    EXPECT_TRUE(tracer.chord(std::vector<Ray>{ray}, {&value, 1}));
    return value;
  };
  const auto with = [](double x, double tmin, double tmax, std::int32_t source = no_primitive) {
    Ray ray{{x, 0, 0}, {2, 0, 0}};
    ray.tmin = tmin;
    ray.tmax = tmax;
    ray.source = source;
    ray.inside = source != no_primitive;
    return ray;
  };
  EXPECT_EQ(length(with(-4, 0, inf)), 4.5);   // -2 .. 5 and 8 .. 10 of x, at twice the speed
  EXPECT_EQ(length(with(0, 0, inf)), 3.5);    // from the inside
  EXPECT_EQ(length(with(0, 0, 0.25)), 0.25);  // without any crossing
  EXPECT_EQ(length(with(0, -inf, inf)), 4.5);
  EXPECT_EQ(length(with(5.5, 0, 1)), 0);
  EXPECT_EQ(length(with(0, 1, 1)), 0);
  EXPECT_EQ(length(with(8, 0, inf, 3)), 1);   // leaves sphere 3 on its inside
  EXPECT_EQ(length(with(8, -1, inf, 3)), 1);  // and was not in it before
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
  const Case scene = cases()[0];
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
