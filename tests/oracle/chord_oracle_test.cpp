// All crossings and lengths inside, judged in 1400 bits: spheres that overlap, lie in one another,
// touch, coincide, and lie far from 0.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include "core/math/geometry.h"
#include "render/renderer/tracer.h"
#include "tests/oracle/oracle.h"
#include "tests/support/case_random.h"

#include <gtest/gtest.h>

namespace boule::test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

struct ChordCase {
  const char* name;
  std::vector<Sphere> (*spheres)(CaseRandom& random);
  Vec3d shift{};  ///< of the spheres and of the rays
};

float small(CaseRandom& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}
Vec3f point(CaseRandom& random, double side) {
  return {small(random, -side, side), small(random, -side, side), small(random, -side, side)};
}

std::vector<Sphere> overlapping(CaseRandom& random) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 60; ++i) spheres.push_back({point(random, 2), small(random, 0.3, 1.5)});
  return spheres;
}

/// Shells around one point, and spheres that touch a larger one from its inside.
std::vector<Sphere> nested(CaseRandom& random) {
  std::vector<Sphere> spheres;
  for (int i = 1; i <= 20; ++i)
    spheres.push_back({{0.5f, -0.25f, 1}, 0.125f * static_cast<float>(i)});
  for (int i = 0; i < 20; ++i) {
    const auto r = static_cast<float>(i + 1) / 16;
    spheres.push_back({{2 - r, 0, 0}, r});
  }
  for (int i = 0; i < 10; ++i) spheres.push_back({point(random, 0.5), small(random, 0.01, 3)});
  return spheres;
}

/// A row of spheres that touch each other, all of them the x axis's neighbours or on it.
std::vector<Sphere> touching(CaseRandom& random) {
  std::vector<Sphere> spheres;
  for (int i = -8; i < 8; ++i) {
    const auto x = static_cast<float>(i);
    spheres.push_back({{x, 0, 0}, 0.5f});
    spheres.push_back({{x, 0.5f, 0}, 0.5f});
    spheres.push_back({{x, 0, -0.25f}, 0.25f});
  }
  for (int i = 0; i < 4; ++i) spheres.push_back({point(random, 4), 1});
  return spheres;
}

/// More copies than a leaf holds, and spheres that differ by one unit of a float.
std::vector<Sphere> coincident(CaseRandom& random) {
  std::vector<Sphere> spheres;
  const Sphere one{point(random, 1), 0.75f};
  for (int i = 0; i < 40; ++i) spheres.push_back(one);
  for (int i = 0; i < 10; ++i) {
    Sphere other = one;
    other.radius = std::nextafter(other.radius, i % 2 == 0 ? 0.0f : 9.0f);
    other.center.x = std::nextafter(other.center.x, i % 3 == 0 ? -9.0f : 9.0f);
    spheres.push_back(other);
  }
  return spheres;
}

const ChordCase chord_cases[] = {{"Overlapping", overlapping},
                                 {"Nested", nested},
                                 {"Touching", touching},
                                 {"Coincident", coincident},
                                 {"FarOverlapping", overlapping, {4096.5, -1e5, 3e4}},
                                 {"FarTouching", touching, {1048576, 65536, -65536}},
                                 {"FarCoincident", coincident, {-7e5, 1, 9e6}}};

/// Rays from around the spheres and from among them, along the x axis, and through centres.
std::vector<Ray> rays_of(const ChordCase& tested, const std::vector<Sphere>& spheres,
                         CaseRandom& random) {
  std::vector<Ray> rays;
  for (int i = 0; i < 120; ++i) {
    const Vec3d from = random.direction(), aside = random.direction();
    const double distance = random.uniform(0, 8), off = random.uniform(0, 2);
    const auto target = static_cast<std::size_t>(i) % spheres.size();
    const Vec3d towards =
        i % 3 == 0 ? vec_cast<double>(spheres[target].center) : tested.shift + aside * off;
    Ray ray{tested.shift + from * distance, {}};
    ray.dir = vec_cast<float>((towards - ray.org) * random.uniform(0.01, 10));
    if (i % 5 == 0) ray.tmin = random.uniform(-0.5, 0.5);
    if (i % 7 == 0) ray.tmax = random.uniform(0.2, 3);
    if (i % 4 == 0) ray.tmin = -inf;
    rays.push_back(ray);
  }
  for (const double y : {0.0, 0.25, 0.5, 1.0}) {
    rays.push_back({tested.shift + Vec3d{-16, y, 0}, {1, 0, 0}});
    rays.push_back({tested.shift + Vec3d{3, y, 0}, {-0.5f, 0, 0}});
  }
  return rays;
}

/// What is true of one sphere and a line, and what the tracer says of it.
struct JudgedChord {
  std::optional<OracleRoots> truth;
  std::vector<double> found;  ///< in order
  double error = 0;           ///< sum over both ends, in t
};

class ChordOracle : public testing::TestWithParam<ChordCase> {
 protected:
  void SetUp() override {
    CaseRandom random(7);
    spheres_ = GetParam().spheres(random);
    for (Sphere& sphere : spheres_)
      sphere.center = vec_cast<float>(vec_cast<double>(sphere.center) + GetParam().shift);
    rays_ = rays_of(GetParam(), spheres_, random);
    Scene scene;
    scene.materials = {{"", Matte{}}};
    scene.spheres = spheres_;
    tracer_.emplace(Tracer::create(std::move(scene)).value());
  }

  /// The whole line, without the ends of the ray.
  std::vector<JudgedChord> judge(const Ray& ray) {
    Ray line = ray;
    line.tmin = -inf;
    line.tmax = inf;
    const Crossings all = tracer_->all_hits(std::vector{line}).value();
    std::vector<JudgedChord> chords(spheres_.size());
    for (std::size_t i = 0; i < all.t.size(); ++i)
      chords[static_cast<std::size_t>(all.id[i])].found.push_back(all.t[i]);
    for (std::size_t id = 0; id < spheres_.size(); ++id) judge(ray, spheres_[id], chords[id]);
    return chords;
  }

  static void judge(const Ray& ray, const Sphere& sphere, JudgedChord& chord) {
    chord.truth = oracle_roots(ray, sphere);
    const std::size_t roots = !chord.truth ? 0 : chord.truth->enter < chord.truth->leave ? 2 : 1;
    // Roots that are one number in double cannot be told apart.
    if (roots != 2 || chord.truth->enter.to_double() < chord.truth->leave.to_double())
      ASSERT_EQ(chord.found.size(), roots);
    const double scale =
        std::max(length(vec_cast<double>(sphere.center) - ray.org), double{sphere.radius});
    for (std::size_t k = 0; k < chord.found.size(); ++k) {
      const double t = chord.found[k];
      EXPECT_LE(abs(oracle_residual(ray, sphere, t)).to_double(), 0x1p-48 * scale);
      const BigFloat& root = k == 0 ? chord.truth->enter : chord.truth->leave;
      chord.error += abs(BigFloat(t) - root).to_double();
    }
  }

  std::vector<Sphere> spheres_;
  std::vector<Ray> rays_;
  std::optional<Tracer> tracer_;
};
INSTANTIATE_TEST_SUITE_P(All, ChordOracle, testing::ValuesIn(chord_cases),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(ChordOracle, CrossingsAreExactAndInOrder) {
  std::size_t crossings = 0, tangents = 0;
  for (const Ray& ray : rays_) {
    const double end = std::min(ray.tmax, double{std::numeric_limits<float>::max()});
    using Key = std::tuple<double, std::int32_t, bool>;  // true sorts last: those that leave
    std::vector<Key> expected;
    const auto chords = judge(ray);
    for (std::size_t id = 0; id < chords.size(); ++id) {
      tangents += chords[id].found.size() == 1 ? 1 : 0;
      for (std::size_t k = 0; k < chords[id].found.size(); ++k) {
        const double t = chords[id].found[k];
        if (ray.tmin < t && t <= end) expected.emplace_back(t, static_cast<int>(id), k == 1);
      }
    }
    std::sort(expected.begin(), expected.end());
    const Crossings all = tracer_->all_hits(std::vector{ray}).value();
    std::vector<Key> found;
    for (std::size_t i = 0; i < all.t.size(); ++i)
      found.emplace_back(all.t[i], all.id[i], all.entering[i] == 0);
    EXPECT_EQ(found, expected);
    crossings += found.size();
  }
  EXPECT_GT(crossings, 5 * rays_.size());
  if (GetParam().spheres == touching) EXPECT_GT(tangents, 10U);
}

/// The part of a chord that counts; nothing where there is none.
std::optional<OracleRoots> clipped(const OracleRoots& chord, const Ray& ray) {
  const double end = std::min(ray.tmax, double{std::numeric_limits<float>::max()});
  OracleRoots part = chord;
  if (ray.tmin > -inf && part.enter < BigFloat(ray.tmin)) part.enter = BigFloat(ray.tmin);
  if (BigFloat(end) < part.leave) part.leave = BigFloat(end);
  if (!(part.enter < part.leave)) return {};
  return part;
}

BigFloat union_of(std::vector<OracleRoots> parts) {
  std::sort(parts.begin(), parts.end(),
            [](const OracleRoots& a, const OracleRoots& b) { return a.enter < b.enter; });
  BigFloat length(0.0);
  for (std::size_t k = 0; k < parts.size();) {
    OracleRoots joined = parts[k];
    for (++k; k < parts.size() && parts[k].enter <= joined.leave; ++k) {
      if (joined.leave < parts[k].leave) joined.leave = parts[k].leave;
    }
    length = length + (joined.leave - joined.enter);
  }
  return length;
}

/// Lengths are as right as the crossings, up to the rounding of sums.
TEST_P(ChordOracle, LengthsAreThoseOfExactIntervals) {
  double total = 0;
  for (const Ray& ray : rays_) {
    std::vector<OracleRoots> parts;
    std::map<std::int32_t, double> each;
    double error = 0, reach = 0;
    const auto chords = judge(ray);
    for (std::size_t id = 0; id < chords.size(); ++id) {
      const JudgedChord& chord = chords[id];
      for (const double t : chord.found) reach = std::max(reach, std::fabs(t));
      error += chord.error;
      const auto part = chord.truth ? clipped(*chord.truth, ray) : std::nullopt;
      if (!part) continue;
      parts.push_back(*part);
      each[static_cast<std::int32_t>(id)] = (part->leave - part->enter).to_double();
    }
    const double rounding = 0x1p-52 * reach * static_cast<double>(parts.size() + 1);
    double length = -1;
    ASSERT_TRUE(tracer_->chord(std::vector{ray}, std::span(&length, 1)));
    EXPECT_NEAR(length, union_of(parts).to_double(), error + rounding);
    total += length;
    const SphereChords found = tracer_->chords(std::vector{ray}).value();
    for (std::size_t i = 0; i < found.id.size(); ++i) {
      const double own = chords[static_cast<std::size_t>(found.id[i])].error;
      EXPECT_NEAR(found.length[i], each[found.id[i]], own + 0x1p-51 * reach);
      each.erase(found.id[i]);
    }
    for (const auto& [id, left_out] : each)
      EXPECT_LE(left_out, chords[static_cast<std::size_t>(id)].error + 0x1p-51 * reach);
  }
  EXPECT_GT(total, 0);
}

}  // namespace
}  // namespace boule::test
