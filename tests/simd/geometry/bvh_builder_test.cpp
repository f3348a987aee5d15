#include "simd/geometry/bvh_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <thread>

#include "simd/abi/isa.h"
#include "tests/simd/geometry/bvh_walk.h"
#include "tests/support/case_random.h"

namespace boule::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

std::vector<Sphere> cloud(std::size_t count) {
  CaseRandom random(21);
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = static_cast<float>(random.uniform());
    const float y = static_cast<float>(random.uniform());
    const float z = static_cast<float>(random.uniform());
    spheres.push_back({{x, y, z}, static_cast<float>(random.uniform(0.001, 0.02)), 0});
  }
  return spheres;
}

TEST(BvhBuilder, CloudsGiveFullLeavesAndFewLevels) {
  for (const std::size_t count : {1U, 8U, 9U, 64U, 1000U, 50'000U}) {
    const auto spheres = cloud(count);
    const Bvh bvh = build_bvh(spheres);
    const Walk walk = check(bvh, spheres);
    if (count < 1000) continue;
    EXPECT_EQ(bvh.scanned, 0U);
    EXPECT_LE(walk.depth, 10);
    EXPECT_GT(static_cast<double>(walk.in_leaves) / static_cast<double>(walk.leaves), 7);
    const auto children = static_cast<double>(bvh.nodes.size() - 1 + walk.leaves);
    EXPECT_GT(children / static_cast<double>(bvh.nodes.size()), 5);
  }
}

TEST(BvhBuilder, ZeroSpheresGiveNoTree) {
  const Bvh bvh = build_bvh({});
  EXPECT_TRUE(bvh.nodes.empty());
  EXPECT_EQ(bvh.scanned, 0U);
  const Bvh five = no_bvh(cloud(5));
  EXPECT_EQ(five.scanned, 5U);
  ASSERT_EQ(five.slots.size(), max_width);
  for (std::int32_t i = 0; i < 5; ++i) EXPECT_EQ(five.slots[static_cast<std::size_t>(i)], i);
  for (std::size_t i = 5; i < max_width; ++i) EXPECT_EQ(five.slots[i], empty_slot);
}

struct Hostile {
  const char* name;
  std::vector<Sphere> spheres;
};

std::vector<Hostile> hostile_sets() {
  constexpr std::size_t count = 20'000;
  const auto changed = [&](const char* name, const auto& change) {
    Hostile hostile{name, cloud(count)};
    for (std::size_t i = 0; i < count; ++i) change(hostile.spheres[i], i);
    return hostile;
  };
  const auto at = [](double x, double y, double z) {
    return Vec3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  };
  return {changed("a giant among many",
                  [&](Sphere& s, std::size_t i) {
                    s.radius = i == 777 ? 10.0F : 1e-4F;
                    s.center = s.center * 100.0F;
                  }),
          changed("two clusters far apart",
                  [&](Sphere& s, std::size_t i) {
                    s.radius = 1e-3F;
                    s.center.x += i % 3 == 0 ? 1e6F : 0.0F;
                  }),
          changed("radii over nine decades",
                  [&](Sphere& s, std::size_t i) {
                    const double exponent = static_cast<double>(i) / 1000 * 9 / 20 - 9;
                    s.radius = static_cast<float>(0.1 * std::pow(10.0, exponent));
                  }),
          changed("on a diagonal",
                  [&](Sphere& s, std::size_t i) {
                    const auto x = static_cast<double>(i) * 1e-4;
                    s = {at(x, x, x), 1e-5F, 0};
                  }),
          changed("denormal extents",
                  [&](Sphere& s, std::size_t) {
                    s.center = s.center * 1e-40F;
                    s.radius = 1e-42F;
                  }),
          changed("coordinates of 1e17",
                  [&](Sphere& s, std::size_t) {
                    s.center = (s.center - Vec3f{0.5F, 0.5F, 0.5F}) * 1.9e18F;
                    s.radius = 1e15F;
                  }),
          changed("points", [&](Sphere& s, std::size_t) { s.radius = 0; }),
          changed("a few points", [&](Sphere& s, std::size_t i) {
            const double radius = 0.1 + static_cast<double>(i) * 1e-7;  // copies would be left out
            s = {at(static_cast<double>(i % 5), 0, 0), static_cast<float>(radius), 0};
          })};
}

TEST(BvhBuilder, HostileInputsFillTheirLeaves) {
  for (const Hostile& hostile : hostile_sets()) {
    SCOPED_TRACE(hostile.name);
    const Bvh bvh = build_bvh(hostile.spheres);
    const Walk walk = check(bvh, hostile.spheres);
    EXPECT_EQ(bvh.scanned, 0U);
    EXPECT_GT(static_cast<double>(walk.in_leaves) / static_cast<double>(walk.leaves), 13);
    EXPECT_LE(walk.depth, 16);
    EXPECT_LT(bvh.nodes.size(), walk.leaves / 2);
  }
}

/// The ids of a tree's slots, in order.
std::vector<std::int32_t> ids_of(const Bvh& bvh) {
  std::vector<std::int32_t> ids(bvh.slots.begin(), bvh.slots.end());
  std::erase(ids, empty_slot);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// However many there are, they cost what two cost.
TEST(BvhBuilder, KeepsOnlyTwoOfManyCopies) {
  std::vector<Sphere> spheres = cloud(3000);
  spheres[5] = {{0.5F, 0.25F, -0.0F}, 0.01F, 0};
  spheres.resize(100'000, {{0.5F, 0.25F, 0.0F}, 0.01F, 1});
  const Bvh bvh = build_bvh(spheres);
  check(bvh, spheres);
  const std::vector<std::int32_t> ids = ids_of(bvh);
  EXPECT_LE(ids.size(), 3000U + bvh_leaf_size);
  for (const int id : {5, 3000}) EXPECT_EQ(std::count(ids.begin(), ids.end(), id), 1) << id;
  EXPECT_LT(bvh.slots.size(), 8000U);
}

TEST(BvhBuilder, KeepsFewSpheresIfAllAreCopies) {
  for (const Sphere& sphere : {Sphere{{1, 2, 3}, 0.5F, 0}, Sphere{{2e18F, 0, 0}, 1, 0},
                               Sphere{{0, 0, 0}, std::numeric_limits<float>::quiet_NaN(), 0}}) {
    const std::vector<Sphere> spheres(100'000, sphere);
    const Bvh bvh = build_bvh(spheres);
    check(bvh, spheres);
    EXPECT_EQ(ids_of(bvh).front(), 0);
    EXPECT_LE(ids_of(bvh).size(), 4U);  // two are giants, two are in the tree
  }
}

TEST(BvhBuilder, LeavesHoldTheSpheresOfTheirSlots) {
  std::vector<Sphere> spheres = cloud(5000);
  spheres[7].radius = -0.01F;
  const Bvh bvh = build_bvh(spheres);
  for (std::size_t i = 0; i + bvh.scanned < bvh.slots.size(); ++i) {
    const SphereBlock& leaf = bvh.blocks[(bvh.scanned + i) / bvh_leaf_size];
    const std::size_t k = i % bvh_leaf_size;
    const std::int32_t id = bvh.slots[bvh.scanned + i];
    if (id < 0) {
      EXPECT_TRUE(std::isnan(leaf.radius[k]));
      continue;
    }
    const Sphere& sphere = spheres[static_cast<std::size_t>(id)];
    EXPECT_EQ(leaf.center_x[k], sphere.center.x);
    EXPECT_EQ(leaf.center_y[k], sphere.center.y);
    EXPECT_EQ(leaf.center_z[k], sphere.center.z);
    EXPECT_EQ(leaf.radius[k], sphere.radius);
  }
}

TEST(BvhBuilder, ScansGiantsAndSpheresWithoutABox) {
  std::vector<Sphere> spheres = cloud(5000);
  spheres[77] = {{0, -1e6F, 0}, 1e6F, 0};
  spheres[78] = {{0, std::numeric_limits<float>::quiet_NaN(), 0}, 1, 0};
  spheres[79] = {{0, 0, 0}, inf, 0};
  spheres[80] = {{2e18F, 0, 0}, 1, 0};
  const Bvh bvh = build_bvh(spheres);
  ASSERT_EQ(bvh.scanned, max_width);
  for (const std::int32_t id : {77, 78, 79, 80}) {
    const auto* const end = bvh.slots.begin() + bvh.scanned;
    EXPECT_NE(std::find(bvh.slots.begin(), end, id), end) << id;
  }
  check(bvh, spheres);
}

/// Bodies on several threads, each taking the next when it is free.
ParallelFor on_threads(unsigned count) {
  return [count](std::size_t size, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i = next++; i < size; i = next++) body(i);
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < count; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
  };
}

void last_first(std::size_t size, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = size; i-- > 0;) body(i);
}

/// Bit for bit, of what is used.
void expect_same(const Bvh& a, const Bvh& b) {
  EXPECT_EQ(a.scanned, b.scanned);
  ASSERT_EQ(a.materials.by_slot() == nullptr, b.materials.by_slot() == nullptr);
  for (std::size_t slot = 0; a.materials.by_slot() != nullptr && slot < a.slots.size(); ++slot)
    ASSERT_EQ(a.materials.by_slot()[slot], b.materials.by_slot()[slot]) << "slot " << slot;
  ASSERT_TRUE(std::equal(a.slots.begin(), a.slots.end(), b.slots.begin(), b.slots.end()));
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const BvhNode &x = a.nodes[i], &y = b.nodes[i];
    constexpr std::size_t rows = offsetof(BvhNode, size) + sizeof(x.size);
    ASSERT_EQ(std::memcmp(&x, &y, rows), 0) << "node " << i;
  }
  if (!a.nodes.empty()) {
    const std::size_t bytes = a.slots.size() / bvh_leaf_size * sizeof(SphereBlock);
    EXPECT_EQ(std::memcmp(a.blocks.data(), b.blocks.data(), bytes), 0);
  }
}

TEST(BvhBuilder, IgnoresTheThreadCount) {
  for (const std::size_t count : {5U, 3000U, 70'000U}) {
    std::vector<Sphere> spheres = cloud(count);
    spheres[count / 2] = {{0, -1e6F, 0}, 1e6F, 0};
    spheres[count / 3].center.x = inf;
    spheres[count - 1] = {{0, 0, 0}, 1e3F, 0};  // found by a second pass
    const Bvh serial = build_bvh(spheres);
    check(serial, spheres);
    expect_same(serial, build_bvh(spheres));
    expect_same(serial, build_bvh(spheres, last_first));
    for (const unsigned threads : {2U, 3U, 7U})
      expect_same(serial, build_bvh(spheres, on_threads(threads)));
  }
}

/// Clusters that are halved again and again from one side: their subtrees are of all sizes, and the
/// small ones are twigs. Each sphere is made of something else.
TEST(BvhBuilder, IgnoresThreadCountWithTwigsAndMaterials) {
  std::vector<Sphere> spheres = cloud(70'000);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    Sphere& s = spheres[i];
    const float far = std::ldexp(1.0F, static_cast<int>(i % 97) - 50);
    if (i % 7 != 0) s = {{far + s.center.x * far, far, s.center.z * far}, far * 0.01F, {}};
    s.material = static_cast<std::uint32_t>(i % 1000);
  }
  spheres[123].radius = inf;
  const Bvh serial = build_bvh(spheres);
  check(serial, spheres);
  for (std::size_t slot = 0; slot < serial.slots.size(); ++slot) {
    const std::int32_t id = serial.slots[slot];
    if (id < 0) continue;
    ASSERT_EQ(serial.materials[static_cast<std::uint32_t>(slot)],
              spheres[static_cast<std::size_t>(id)].material);
  }
  expect_same(serial, build_bvh(spheres, last_first));
  expect_same(serial, build_bvh(spheres, on_threads(3)));
}

}  // namespace
}  // namespace boule::test
