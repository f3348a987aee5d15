// The lengths of rays inside spheres, judged by long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/renderer/tracer.h"
#include "tests/render/ray_clouds.h"
#include "tests/render/renderer/overlapping_spheres.h"

namespace boule::test::tracer_chords {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Tracer make_tracer(const Scene& scene) { return Tracer::create(scene).value(); }

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

TEST(TracerChords, ChordsOfTheUnionAreExact) {
  for (const SphereCase& scene : sphere_cases()) {
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

TEST(TracerChords, ChordsOfKnownSpheresAreExact) {
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

}  // namespace
}  // namespace boule::test::tracer_chords
