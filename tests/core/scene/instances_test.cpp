// Groups and their instances, compared with the same objects written out by hand.
#include "core/scene/instances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math/similarity.h"
#include "core/scene/scene.h"
#include "tests/support/grouped_scene.h"

namespace boule::test {
namespace {

bool same(const Sphere& a, const Sphere& b) {
  return a.center == b.center && a.radius == b.radius && a.material == b.material;
}
bool same(const Plane& a, const Plane& b) {
  return a.point == b.point && a.normal == b.normal && a.material == b.material;
}
template <class Primitive>
bool same(const std::vector<Primitive>& a, const std::vector<Primitive>& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](auto& p, auto& q) { return same(p, q); });
}

TEST(Instances, ExpandInTheDocumentedOrder) {
  Scene scene;
  add_material(scene, Matte{});
  add_material(scene, Metal{});
  scene.spheres = {{{9, 9, 9}, 1, 0}};
  scene.planes = {{{0, -1, 0}, {0, 1, 0}, 0}};
  scene.groups = {{"outer", {{{1, 0, 0}, 2, 0}}, {{{0, 1, 0}, {0, 1, 0}, 1}}, {}},
                  {"inner", {{{0, 1, 0}, 1, 0}, {{0, 0, 1}, 0.5f, 1}}, {}, {}}};
  scene.groups[0].instances = {{1, {0, 0, 4}, {0, 0, 90}, 0.5f, {}}};
  scene.instances = {{0, {10, 0, 0}, {0, 90, 0}, 2, {}}, {1, {}, {-90, 0, 0}, 1, 1u}};
  expand_instances(scene);
  const std::vector<Sphere> spheres = {
      {{9, 9, 9}, 1, 0},
      {{10, 0, -2}, 4, 0},    // (1,0,0) turned by 90 degrees about y is (0,0,-1), doubled
      {{18, 0, 1}, 1, 0},     // (0,1,0) -> (-.5,0,4) -> (4,0,.5), doubled, moved
      {{19, 0, 0}, 0.5f, 1},  // (0,0,1) -> (0,0,4.5) -> (4.5,0,0)
      {{0, 0, -1}, 1, 1},     // (0,1,0) turned by -90 about x
      {{0, 1, 0}, 0.5f, 1}};
  const std::vector<Plane> planes = {{{0, -1, 0}, {0, 1, 0}, 0}, {{10, 2, 0}, {0, 1, 0}, 1}};
  EXPECT_TRUE(same(scene.spheres, spheres));
  EXPECT_TRUE(same(scene.planes, planes));
  EXPECT_TRUE(scene.groups.empty() && scene.instances.empty());
}

struct LongPoint {
  long double x, y, z;
};

/// A point scaled, turned about x, y and z, and moved, one step after the other, with the functions
/// of the C++ library.
LongPoint twin(const Instance& instance, LongPoint p) {
  const long double s = static_cast<long double>(instance.scale);
  const long double radians = 3.14159265358979323846264338327950288L / 180;
  const long double a = static_cast<long double>(instance.rotate.x) * radians;
  const long double b = static_cast<long double>(instance.rotate.y) * radians;
  const long double c = static_cast<long double>(instance.rotate.z) * radians;
  p = {s * p.x, s * p.y, s * p.z};
  p = {p.x, std::cos(a) * p.y - std::sin(a) * p.z, std::sin(a) * p.y + std::cos(a) * p.z};
  p = {std::cos(b) * p.x + std::sin(b) * p.z, p.y, std::cos(b) * p.z - std::sin(b) * p.x};
  p = {std::cos(c) * p.x - std::sin(c) * p.y, std::sin(c) * p.x + std::cos(c) * p.y, p.z};
  const Vec3d move = vec_cast<double>(instance.translate);
  return {p.x + move.x, p.y + move.y, p.z + move.z};
}

/// Half an ulp of float, plus what the rounding of doubles of size `scale` may add.
void expect_rounded_once(float found, long double expected, double scale) {
  const auto magnitude = static_cast<double>(std::fabs(expected));
  EXPECT_NEAR(static_cast<double>(found), static_cast<double>(expected),
              magnitude * 0x1.00001p-24 + scale * 0x1p-46);
}

TEST(Instances, NestedTransformsAreRoundedOnce) {
  CaseRandom random(11);
  const auto draw = [&](double low, double high) {
    return static_cast<float>(random.uniform(low, high));
  };
  for (int trial = 0; trial < 2000; ++trial) {
    Scene scene;
    add_material(scene, Matte{});
    constexpr std::uint32_t depth = 5;
    std::vector<Instance> way;  // the outer ones come first
    double scale = 1;
    for (std::uint32_t level = 0; level < depth; ++level) {
      Instance instance{level, {}, {}, draw(0.2, 3), {}};
      for (float* x : {&instance.translate.x, &instance.translate.y, &instance.translate.z}) {
        *x = draw(-10, 10);
      }
      for (float* x : {&instance.rotate.x, &instance.rotate.y, &instance.rotate.z}) {
        *x = draw(-800, 800);
      }
      scale = scale * std::max(1.0, static_cast<double>(instance.scale)) + 20;
      way.push_back(instance);
      scene.groups.push_back({std::to_string(level), {}, {}, {}});
      if (level > 0) scene.groups[level - 1].instances = {instance};
    }
    scene.instances = {way.front()};
    const Sphere sphere{{draw(-5, 5), draw(-5, 5), draw(-5, 5)}, draw(0.1, 2), 0};
    scene.groups.back().spheres = {sphere};
    LongPoint expected{sphere.center.x, sphere.center.y, sphere.center.z};
    long double radius = sphere.radius;
    for (auto level = way.rbegin(); level != way.rend(); ++level) {
      expected = twin(*level, expected);
      radius *= static_cast<long double>(level->scale);
    }
    expand_instances(scene);
    ASSERT_EQ(scene.spheres.size(), 1u);
    expect_rounded_once(scene.spheres[0].center.x, expected.x, scale * 10);
    expect_rounded_once(scene.spheres[0].center.y, expected.y, scale * 10);
    expect_rounded_once(scene.spheres[0].center.z, expected.z, scale * 10);
    expect_rounded_once(scene.spheres[0].radius, radius, scale);
  }
}

TEST(Similarity, QuarterTurnsAreExact) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const auto [c, s] = turn_of(90.0 * quarter);
    const double cosines[] = {1, 0, -1, 0}, sines[] = {0, 1, 0, -1};
    EXPECT_EQ(c, cosines[((quarter % 4) + 4) % 4]);
    EXPECT_EQ(s, sines[((quarter % 4) + 4) % 4]);
  }
  for (double degrees = -720; degrees <= 720; degrees += 0.37) {
    const auto [c, s] = turn_of(degrees);
    const long double radians = degrees * 3.14159265358979323846264338327950288L / 180;
    EXPECT_NEAR(c, static_cast<double>(std::cos(radians)), 4e-16);
    EXPECT_NEAR(s, static_cast<double>(std::sin(radians)), 4e-16);
  }
}

TEST(Instances, ErrorsNameTheInstance) {
  struct Case {
    const char* key;
    const char* words;
    std::function<void(Scene&)> spoil;
  };
  constexpr float inf = std::numeric_limits<float>::infinity();
  const Case cases[] = {
      {"instance[0].scale", "above 0", [](Scene& s) { s.instances[0].scale = 0; }},
      {"instance[1].scale", "above 0", [](Scene& s) { s.instances[1].scale = -1; }},
      {"instance[2].translate", "finite", [](Scene& s) { s.instances[2].translate.y = NAN; }},
      {"group.outer.instance[0].rotate", "finite",
       [](Scene& s) { s.groups[0].instances[0].rotate.z = inf; }},
      {"instance[0].group", "no group", [](Scene& s) { s.instances[0].group = 2; }},
      {"instance[0].material", "no material", [](Scene& s) { s.instances[0].material = 99; }},
      {"group.inner.sphere[1].radius", "above 0",
       [](Scene& s) { s.groups[1].spheres[1].radius = 0; }},
      {"group.outer.plane[0].material", "no material",
       [](Scene& s) { s.groups[0].planes[0].material = 99; }},
      {"group.inner.instance[0].group", "'outer' -> 'inner' -> 'outer'",
       [](Scene& s) {
         s.groups[1].instances = {{0, {}, {}, 1, {}}};
       }},
      {"group.inner.instance[0].group", "'inner' -> 'inner'",
       [](Scene& s) {
         s.groups[1].instances = {{1, {}, {}, 1, {}}};
       }},
      {"instance[2].scale", "range", [](Scene& s) { s.instances[2].scale = 3e38f; }},
      {"instance[0].scale", "range", [](Scene& s) { s.instances[0].scale = 1e-45f; }},
      {"instance[1].scale", "range",
       [](Scene& s) {
         s.instances[1].translate = s.groups[1].spheres[0].center = {3e38f, 0, 0};
       }},
  };
  for (const Case& c : cases) {
    Scene scene = grouped_scene();
    c.spoil(scene);
    const Status done = validate(scene);
    ASSERT_FALSE(done) << c.key;
    EXPECT_EQ(done.error().key, c.key);
    EXPECT_NE(done.error().message.find(c.words), std::string::npos) << done.error().message;
  }
}

/// Groups of which each shows the next one ten times.
Scene tower(int levels, bool with_sphere) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  for (int i = 0; i < levels; ++i) {
    scene.groups.push_back({std::to_string(i), {}, {}, {}});
    const auto next = static_cast<std::uint32_t>(i + 1);
    if (i + 1 < levels) scene.groups.back().instances.assign(10, {next, {}, {}, 1, {}});
  }
  if (with_sphere) scene.groups.back().spheres = {Sphere{}};
  scene.instances = {{0, {}, {}, 1, {}}};
  return scene;
}

/// The same with the groups in opposite order.
Scene inner_first(Scene scene) {
  const auto last = static_cast<std::uint32_t>(scene.groups.size() - 1);
  std::reverse(scene.groups.begin(), scene.groups.end());
  for (Group& group : scene.groups) {
    for (Instance& instance : group.instances) instance.group = last - instance.group;
  }
  for (Instance& instance : scene.instances) instance.group = last - instance.group;
  return scene;
}

TEST(Instances, TooManyAreRefusedBeforeAllocation) {
  EXPECT_EQ(count_primitives(tower(7, true)).spheres, 1'000'000u);
  for (const int levels : {11, 30, 250}) {
    const Status done = validate(tower(levels, true));
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().key, "instance[0].group");
    EXPECT_NE(done.error().message.find("more than 2147483647"), std::string::npos);
  }
  // Empty groups take no time either, however often they are shown.
  Scene empty = tower(250, false);
  EXPECT_TRUE(validate(empty));
  expand_instances(empty);
  EXPECT_TRUE(empty.spheres.empty());
}

TEST(Instances, TooDeepNestingIsAlwaysRefused) {
  EXPECT_TRUE(validate(tower(256, false)));
  EXPECT_TRUE(validate(inner_first(tower(256, false))));
  for (const int levels : {257, 300, 20'000}) {
    for (const Scene& scene : {tower(levels, false), inner_first(tower(levels, false))}) {
      const Status deep = validate(scene);
      ASSERT_FALSE(deep);
      EXPECT_NE(deep.error().message.find("nested more than 256 deep"), std::string::npos);
    }
  }
}

TEST(Instances, SharedOnesExpandToTheSameList) {
  Scene shared = shared_scene(), flat = shared;
  const auto groups = share_or_expand(shared);
  ASSERT_TRUE(groups);
  expand_instances(flat);
  EXPECT_EQ(groups->size(), count_primitives(shared).placements);
  EXPECT_EQ(count_primitives(shared).spheres, flat.spheres.size());
  EXPECT_EQ(count_primitives(shared).planes, flat.planes.size());
  EXPECT_EQ(shared.planes.size(), flat.planes.size());
  std::size_t at = shared.spheres.size();
  visit_shown(shared, [&](const Sphere& one) {
    const Sphere& expected = flat.spheres[at++];
    ASSERT_TRUE(one.center == expected.center && one.radius == expected.radius &&
                one.material == expected.material)
        << at;
  });
  EXPECT_EQ(at, flat.spheres.size());
}

TEST(Instances, ExpandWhereSharingIsUselessOrInexact) {
  const auto is_shared = [](const std::function<void(Scene&)>& change) {
    Scene scene = shared_scene();
    change(scene);
    EXPECT_TRUE(validate(scene));
    return groups_to_share(scene).has_value();
  };
  EXPECT_TRUE(is_shared([](Scene&) {}));
  EXPECT_FALSE(is_shared([](Scene& s) { s.instances.resize(10); }));          // few
  EXPECT_FALSE(is_shared([](Scene& s) { s.groups[2].spheres.resize(30); }));  // small
  EXPECT_FALSE(is_shared([](Scene& s) { s.instances.back().translate.x = 1e18f; }));
  EXPECT_FALSE(is_shared([](Scene& s) { s.instances.back().scale = 1e19f; }));
  EXPECT_FALSE(is_shared([](Scene& s) { s.spheres[0].radius = 1e18f; }));
  Scene pairs = shared_scene();  // as many spheres in groups that are shown once as shown again
  for (int i = 0; i < 60; ++i) {
    pairs.groups.push_back({std::to_string(i), pairs.groups[2].spheres, {}, {}});
    pairs.instances.push_back({static_cast<std::uint32_t>(pairs.groups.size() - 1), {}, {}, 1, {}});
  }
  EXPECT_FALSE(groups_to_share(pairs));
}

}  // namespace
}  // namespace boule::test
