// Capsules: every kernel table gives the scalar path's bits, for hits, chords and surfaces.
#include <cstring>
#include <limits>
#include <set>

#include "core/surface.h"
#include "simd/stream/surface_buffer.h"
#include "tests/support/case_random.h"
#include "tests/support/expect_same.h"
#include "tests/support/hard_capsules.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::capsules {
namespace {

constexpr Form forms[] = {Form::automatic, Form::packet, Form::single, Form::set, Form::flight};

struct CapsuleScene {
  std::vector<Sphere> spheres{};
  std::vector<Plane> planes{};
  std::vector<Capsule> capsules{};
  std::vector<Ray> rays{};

  [[nodiscard]] Geometry geometry() const {
    Geometry geometry(spheres, planes);
    geometry.add_capsules(capsules);
    return geometry;
  }
  [[nodiscard]] Hit reference_hit(const Ray& ray) const {
    return reference::closest_hit(ray, spheres, planes, capsules);
  }
};

/// Each slot names its capsule.
void expect_own_slot(const CapsuleScene& scene, const Geometry& geometry, const Hit& hit) {
  if (hit.id == no_primitive || !geometry.is_capsule(hit)) return;
  const std::size_t others = scene.spheres.size() + scene.planes.size();
  const Capsule& named = scene.capsules[static_cast<std::size_t>(hit.id) - others];
  const Capsule found = geometry.capsule(hit.slot);
  EXPECT_TRUE(std::memcmp(&found.a, &named.a, sizeof found.a) == 0);
  EXPECT_TRUE(std::memcmp(&found.b, &named.b, sizeof found.b) == 0);
  EXPECT_TRUE(std::memcmp(&found.radius, &named.radius, sizeof found.radius) == 0);
}

void expect_reference_hits(const KernelTable& kernels, const CapsuleScene& scene) {
  const Geometry geometry = scene.geometry();
  for (const Form form : forms) {
    const Query query{Solver::robust, form, Coherence::none};
    const auto hits = run_closest(kernels, geometry.view(), scene.rays, query);
    const auto occluded = run_any(kernels, geometry.view(), scene.rays, query);
    for (std::size_t i = 0; i < hits.size() && !testing::Test::HasFailure(); ++i) {
      const Hit expected = scene.reference_hit(scene.rays[i]);
      ASSERT_TRUE(same_bits(hits[i], expected))
          << "ray " << i << ": " << hits[i].id << " " << hits[i].t << ", expected " << expected.id
          << " " << expected.t;
      ASSERT_EQ(occluded[i], expected.id == no_primitive ? 0 : 1) << "ray " << i;
      expect_own_slot(scene, geometry, hits[i]);
    }
  }
}

struct IsaAndCapsules {
  std::string isa;
  CapsuleCaseSpec spec;
};

class HardCapsules : public testing::TestWithParam<IsaAndCapsules> {
 protected:
  void SetUp() override {
    kernels = kernels_or_null(GetParam().isa);
    if (kernels == nullptr) GTEST_SKIP() << "this CPU has no " << GetParam().isa;
  }
  const KernelTable* kernels = nullptr;
};

std::vector<IsaAndCapsules> each_capsule_case() {
  std::vector<IsaAndCapsules> all;
  for (const std::string& isa : all_isa_names()) {
    for (const CapsuleCaseSpec& spec : capsule_case_specs()) all.push_back({isa, spec});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Tables, HardCapsules, testing::ValuesIn(each_capsule_case()),
                         [](const auto& tested) {
                           return tested.param.isa + "_" + name_of(tested.param.spec);
                         });

TEST_P(HardCapsules, AloneEqualTheScalarPath) {
  const CapsuleCase all = make_capsule_case(GetParam().spec, 8, 1033);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < all.capsules.size(); ++i) {
    CapsuleScene scene{.capsules = {all.capsules[i]}};
    for (std::size_t k = i; k < all.rays.size(); k += all.capsules.size())
      scene.rays.push_back(all.rays[k]);
    expect_reference_hits(*kernels, scene);
    for (const Ray& ray : scene.rays) hits += scene.reference_hit(ray).id >= 0 ? 1U : 0U;
  }
  EXPECT_GT(hits, all.rays.size() / 10);
}

TEST_P(HardCapsules, ManyEqualTheScalarPath) {
  CapsuleCase all = make_capsule_case(GetParam().spec, 150, 517);
  for (int i = 0; i < 20; ++i) all.capsules.push_back(all.capsules[7]);  // the lowest id wins
  expect_reference_hits(*kernels, {.capsules = all.capsules, .rays = all.rays});
}

std::vector<Capsule> random_capsules(CaseRandom& random, int count, double size) {
  std::vector<Capsule> capsules;
  for (int i = 0; i < count; ++i) {
    const Vec3d to_a = random.direction();
    const Vec3d a = to_a * random.uniform(0, 5);
    const Vec3d to_b = random.direction();
    const Vec3d along = to_b * random.uniform(0, size);
    const auto radius = static_cast<float>(random.decade(-2, -0.5));
    capsules.push_back({vec_cast<float>(a), vec_cast<float>(a + along), radius, {}});
  }
  return capsules;
}

/// Spheres at both ends of the first capsules, as atoms at bonds; planes through the middle.
CapsuleScene random_scene(std::uint64_t seed, int capsules, int rays) {
  CaseRandom random(seed);
  CapsuleScene scene{.capsules = random_capsules(random, capsules, 2)};
  for (std::size_t i = 0; i < scene.capsules.size() / 2; ++i) {
    scene.spheres.push_back({scene.capsules[i].a, scene.capsules[i].radius, {}});
    scene.spheres.push_back({scene.capsules[i].b, scene.capsules[i].radius * 2, {}});
  }
  scene.planes = {{{0, -3, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 2, -3}}};
  for (int i = 0; i < rays; ++i) {
    const Vec3d away = random.direction();
    const Vec3d from = away * random.uniform(0, 12);
    const Vec3d beside = random.direction() * 4.0;
    Ray ray{from, vec_cast<float>(beside - from * random.uniform(0, 1))};
    if (i % 3 == 1) ray.tmin = random.uniform(-1, 1);
    if (i % 4 == 1) ray.tmax = random.uniform(0, 2);
    scene.rays.push_back(ray);
  }
  return scene;
}

class CapsuleScenes : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Tables, CapsuleScenes, each_isa(), isa_name);

TEST_P(CapsuleScenes, AmidOthersEqualTheScalarPath) {
  for (const int capsules : {1, 3, 17, 400}) {
    expect_reference_hits(*kernels, random_scene(5, capsules, 1013));
    if (HasFailure()) return;
  }
}

TEST_P(CapsuleScenes, CoherentRaysEqualTheScalarPath) {
  CapsuleScene scene = random_scene(6, 300, 0);
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      scene.rays.push_back(
          {{0.5, 1, 20},
           {static_cast<float>(x - 20) * 0.012F, static_cast<float>(y - 20) * 0.012F, -1}});
    }
  }
  const Geometry geometry = scene.geometry();
  const Query query{Solver::robust, Form::automatic, Coherence::common_origin};
  const auto hits = run_closest(*kernels, geometry.view(), scene.rays, query);
  const auto occluded = run_any(*kernels, geometry.view(), scene.rays, query);
  std::size_t on_capsules = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    ASSERT_TRUE(same_bits(hits[i], scene.reference_hit(scene.rays[i]))) << "ray " << i;
    ASSERT_EQ(occluded[i], hits[i].id == no_primitive ? 0 : 1) << "ray " << i;
    on_capsules += hits[i].id >= 0 && geometry.is_capsule(hits[i]) ? 1U : 0U;
  }
  EXPECT_GT(on_capsules, 200U);
}

TEST_P(CapsuleScenes, OddNumbersEqualTheScalarPath) {
  constexpr float odd[] = {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           0,
                           -0.0F,
                           1e-45F,
                           3e38F,
                           1e19F,
                           -2e18F,
                           1e-20F};
  CapsuleScene scene = random_scene(7, 200, 700);
  CaseRandom random(8);
  const auto spoil = [&](auto& number) {
    using Number = std::remove_reference_t<decltype(number)>;
    if (random.chance(0.08)) number = static_cast<Number>(odd[random.below(10)]);
  };
  for (Capsule& capsule : scene.capsules) {
    for (float* number : {&capsule.a.x, &capsule.a.y, &capsule.b.x, &capsule.b.z, &capsule.radius})
      spoil(*number);
  }
  for (Ray& ray : scene.rays) {
    spoil(ray.org.x), spoil(ray.dir.x), spoil(ray.dir.y), spoil(ray.tmin), spoil(ray.tmax);
    ray.tmin = float_below(ray.tmin), ray.tmax = float_above(ray.tmax);
  }
  expect_reference_hits(*kernels, scene);
}

/// Rays that leave the capsules which the scene's rays hit, to both sides.
std::vector<Ray> departing_rays(const CapsuleScene& scene) {
  std::vector<Ray> departing;
  CaseRandom random(10);
  const auto first = static_cast<std::int32_t>(scene.spheres.size() + scene.planes.size());
  for (const Ray& ray : scene.rays) {
    const Hit hit = scene.reference_hit(ray);
    if (hit.id < first) continue;
    const Surface surface =
        find_surface(scene.capsules[static_cast<std::size_t>(hit.id - first)], ray, hit);
    for (const Side side : {Side::viewer, Side::beyond}) {
      Vec3d dir = random.direction();
      if ((dot(dir, surface.normal) > 0) != (side == Side::viewer)) dir = -dir;
      departing.push_back(leave(surface, side, dir));
    }
  }
  return departing;
}

TEST_P(CapsuleScenes, DepartingRaysEqualTheScalarPath) {
  CapsuleScene scene = random_scene(9, 300, 2000);
  scene.rays = departing_rays(scene);
  ASSERT_GT(scene.rays.size(), 300U);
  expect_reference_hits(*kernels, scene);
  std::size_t inside = 0;
  for (const Ray& ray : scene.rays) {
    const Hit hit = scene.reference_hit(ray);
    inside += ray.inside ? 1U : 0U;
    // A ray on the inside meets something: the capsule's own surface, if nothing else.
    if (ray.inside) EXPECT_NE(hit.id, no_primitive);
    if (!ray.inside) EXPECT_NE(hit.id, ray.source);
  }
  EXPECT_GT(inside, 100U);
}

TEST_P(CapsuleScenes, SurfacesEqualTheScalarPath) {
  const CapsuleScene scene = random_scene(11, 300, 1500);
  const Geometry geometry = scene.geometry();
  RayBuffer rays = to_stream(scene.rays);
  HitBuffer hits(scene.rays.size());
  SurfaceBuffer surfaces(scene.rays.size());
  kernels->closest_hit(geometry.view(), rays.view(), {}, hits.view());
  kernels->find_surfaces(geometry.view(), rays.view(), hits.view(), surfaces.stream());
  std::size_t met = 0;
  for (std::size_t k = 0; k < scene.rays.size() && !HasFailure(); ++k) {
    const Hit hit = hits.get(k);
    if (hit.id == no_primitive) continue;
    SCOPED_TRACE(k);
    const auto id = static_cast<std::size_t>(hit.id);
    const std::size_t others = scene.spheres.size() + scene.planes.size();
    const Surface expected = id < others
                                 ? find_surface(scene.spheres, scene.planes, rays.get(k), hit)
                                 : find_surface(scene.capsules[id - others], rays.get(k), hit);
    met += id < others ? 0U : 1U;
    const Departure departure = depart(expected, Side::viewer);
    expect_same(surfaces.normal.get(k), expected.normal);
    expect_same(surfaces.mirrored.get(k), expected.mirrored);
    expect_same(surfaces.org.get(k), departure.org);
    expect_same(surfaces.cosine[k], expected.cosine);
    expect_same(surfaces.reach[k], expected.reach);
    EXPECT_EQ(surfaces.inner[k] != 0, expected.inner);
    EXPECT_EQ(surfaces.inside[k] != 0, departure.inside);
  }
  EXPECT_GT(met, 200U);
}

using Chord = std::tuple<std::uint64_t, std::uint64_t, std::int32_t>;

TEST_P(CapsuleScenes, ChordsEqualTheScalarPath) {
  CapsuleScene scene = random_scene(12, 300, 600);
  const auto first = static_cast<std::int32_t>(scene.spheres.size() + scene.planes.size());
  const std::vector<Ray> departing = departing_rays(scene);
  scene.rays.insert(scene.rays.end(), departing.begin(), departing.end());
  for (Ray& ray : scene.rays) ray.tmin = float_below(ray.tmin), ray.tmax = float_above(ray.tmax);
  const Geometry geometry = scene.geometry();
  RayBuffer rays = to_stream(scene.rays);
  constexpr std::size_t capacity = 100'000;
  std::vector<double> enter(capacity), leave(capacity);
  std::vector<std::int32_t> id(capacity);
  std::vector<std::uint32_t> slot(capacity);
  std::vector<std::size_t> ends(scene.rays.size());
  ASSERT_EQ(kernels->find_chords(geometry.view(), rays.view(), 0,
                                 {enter.data(), leave.data(), id.data(), slot.data(), capacity},
                                 ends.data()),
            scene.rays.size());
  std::size_t at = 0, of_capsules = 0;
  for (std::size_t i = 0; i < scene.rays.size(); ++i) {
    std::multiset<Chord> found, expected;
    for (; at < ends[i]; ++at) {
      found.insert({std::bit_cast<std::uint64_t>(enter[at]),
                    std::bit_cast<std::uint64_t>(leave[at]), id[at]});
      expect_own_slot(scene, geometry, {enter[at], id[at], slot[at]});
    }
    std::int32_t next = 0;
    const auto add = [&](const auto& primitive) {
      const Ray& ray = scene.rays[i];
      const reference::Chord chord = reference::find_chord(ray, primitive, next == ray.source);
      if (overlaps(chord, ray, primitive)) {
        expected.insert({std::bit_cast<std::uint64_t>(chord.enter),
                         std::bit_cast<std::uint64_t>(chord.leave), next});
        of_capsules += next >= first ? 1U : 0U;
      }
      ++next;
    };
    for (const Sphere& sphere : scene.spheres) add(sphere);
    for (const Plane& plane : scene.planes) add(plane);
    for (const Capsule& capsule : scene.capsules) add(capsule);
    ASSERT_TRUE(found == expected) << "ray " << i;
  }
  EXPECT_GT(of_capsules, 500U);
}

TEST(CapsuleReference, OneWithoutLengthIsASphere) {
  const CapsuleCase all = make_capsule_case({"C8", 0}, 5, 2000);
  for (std::size_t i = 0; i < all.rays.size(); ++i) {
    const Capsule& capsule = all.capsules[i % 5];
    const Sphere sphere{capsule.a, capsule.radius, {}};
    EXPECT_EQ(reference::intersect(all.rays[i], capsule, false),
              reference::intersect(all.rays[i], sphere, false));
  }
}

TEST(CapsuleReference, ItsEndsDoNotMatter) {
  const CapsuleCase all = make_capsule_case({"C0", 0}, 50, 2000);
  for (std::size_t i = 0; i < all.rays.size(); ++i) {
    Capsule capsule = all.capsules[i % 50];
    const double t = reference::intersect(all.rays[i], capsule, false);
    std::swap(capsule.a, capsule.b);
    const double turned = reference::intersect(all.rays[i], capsule, false);
    if (!std::isfinite(t) || !std::isfinite(turned)) {
      EXPECT_EQ(t, turned);
    } else {
      EXPECT_NEAR(t, turned, 1e-12 * std::fabs(t));
    }
  }
}

}  // namespace
}  // namespace boule::test::capsules
