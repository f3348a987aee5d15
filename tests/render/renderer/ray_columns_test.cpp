// Rays and hits in columns: the bits of the same rays as a list, whatever the layout.
#include "render/renderer/ray_columns.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <vector>

#include "render/renderer/tracer.h"

namespace boule::test::ray_columns {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

Scene cloud() {
  Scene scene;
  scene.materials.push_back({"default", Matte{}});
  for (int i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(i % 7), y = static_cast<float>(i % 11);
    const auto z = static_cast<float>(i % 13);
    scene.spheres.push_back({{x - 3, y - 5, z - 6}, 0.4F, MaterialRef()});
  }
  scene.planes.push_back({{0, -7, 0}, {0, 1, 0}, MaterialRef()});
  return scene;
}

std::vector<Ray> rays() {
  std::vector<Ray> all;
  for (int i = 0; i < 3000; ++i) {
    const auto a = static_cast<float>(i % 50) / 25 - 1, b = static_cast<float>(i % 61) / 30 - 1;
    Ray ray{{0.1, 0.2 + i * 1e-3, 20}, {a, b, -1}};
    ray.tmin = i % 5 == 0 ? 15.0F : 0.0F;
    ray.tmax = i % 7 == 0 ? 22.0F : inf;
    all.push_back(ray);
  }
  return all;
}

/// Numbers of rays behind one another, `gap` bytes between two of them, at odd addresses.
template <class Number>
class Packed {
 public:
  Packed(std::size_t components, std::size_t gap)
      : components_(components), step_(components * sizeof(Number) + gap), bytes_(1) {}

  void add(std::initializer_list<double> numbers) {
    for (const double number : numbers) {
      const auto rounded = static_cast<Number>(number);
      const std::size_t at = bytes_.size();
      bytes_.resize(at + sizeof rounded);
      std::memcpy(&bytes_[at], &rounded, sizeof rounded);
    }
    bytes_.resize(bytes_.size() + step_ - components_ * sizeof(Number));
  }
  [[nodiscard]] RayNumbers numbers() const {
    return {&bytes_[1], static_cast<std::ptrdiff_t>(step_), sizeof(Number), sizeof(Number) == 8};
  }

 private:
  std::size_t components_, step_;
  std::vector<unsigned char> bytes_;
};

/// True if the hits in columns are those of the list, to the bit.
void expect_same(const std::vector<TracedHit>& list, const std::vector<double>& t,
                 const std::vector<std::int32_t>& id, const std::vector<float>& normal) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(list[k].t), std::bit_cast<std::uint64_t>(t[k])) << k;
    ASSERT_EQ(list[k].id, id[k]) << k;
    const Vec3f n{normal[3 * k], normal[3 * k + 1], normal[3 * k + 2]};
    ASSERT_EQ(list[k].normal, n) << k;
  }
}

template <class Number>
void compare(std::size_t gap) {
  Tracer tracer = Tracer::create(cloud()).value();
  const std::vector<Ray> list = rays();
  std::vector<TracedHit> hits(list.size());
  ASSERT_TRUE(tracer.closest(list, hits));
  Packed<double> org(3, gap);
  Packed<Number> dir(3, gap), ends(1, gap), begins(1, 0);
  for (const Ray& ray : list) {
    org.add({ray.org.x, ray.org.y, ray.org.z});
    dir.add({double{ray.dir.x}, double{ray.dir.y}, double{ray.dir.z}});
    begins.add({double{ray.tmin}});
    ends.add({double{ray.tmax}});
  }
  const RayColumns columns{list.size(),      org.numbers(),  dir.numbers(),
                           begins.numbers(), ends.numbers(), {}};
  std::vector<double> t(list.size());
  std::vector<std::int32_t> id(list.size());
  std::vector<float> normal(3 * list.size());
  ASSERT_TRUE(tracer.closest_of_columns(columns, {t.data(), id.data(), normal.data()}));
  expect_same(hits, t, id, normal);
  std::vector<std::uint8_t> met(list.size(), 2), told(list.size(), 3);
  ASSERT_TRUE(tracer.any(list, told));
  ASSERT_TRUE(tracer.any_of_columns(columns, met));
  EXPECT_EQ(met, told);
}

TEST(RayColumns, GiveTheHitsOfTheList) {
  for (const std::size_t gap : {0u, 3u, 40u}) {
    compare<float>(gap);
    compare<double>(gap);
  }
}

TEST(RayColumns, OneValueCanServeAllRays) {
  Tracer tracer = Tracer::create(cloud()).value();
  const double org[] = {0, 0, 20};
  const float dir[] = {0, 0, -1}, far = inf, near = 0;
  const auto fixed = [](const void* first, std::ptrdiff_t step, bool is_double) {
    return RayNumbers{static_cast<const unsigned char*>(first), 0, step, is_double};
  };
  const RayColumns columns{
      5, fixed(org, 8, true), fixed(dir, 4, false), fixed(&near, 0, false), fixed(&far, 0, false),
      {}};
  std::vector<double> t(5);
  std::vector<std::int32_t> id(5);
  std::vector<float> normal(15);
  ASSERT_TRUE(tracer.closest_of_columns(columns, {t.data(), id.data(), normal.data()}));
  for (const std::int32_t one : id) EXPECT_EQ(one, id[0]);
  EXPECT_GE(id[0], 0);
}

TEST(RayColumns, ZeroIsSubtractedInDouble) {
  Tracer tracer = Tracer::create(cloud()).value();
  const double org[] = {1e9 + 0.25, 0.5, 20}, dir[] = {0, 0, -1}, ends[] = {0, 1e300};
  const auto all = [](const double* first) {
    const void* const bytes = first;
    return RayNumbers{static_cast<const unsigned char*>(bytes), 0, 8, true};
  };
  const RayColumns columns{1, all(org), all(dir), all(&ends[0]), all(&ends[1]), {1e9, 0, 0}};
  double t = 0;
  std::int32_t id = 0;
  float normal[3];
  ASSERT_TRUE(tracer.closest_of_columns(columns, {&t, &id, normal}));
  TracedHit hit;
  const Ray near{{0.25, 0.5, 20}, {0, 0, -1}};
  ASSERT_TRUE(tracer.closest({&near, 1}, {&hit, 1}));
  EXPECT_EQ(t, hit.t);
  EXPECT_EQ(id, hit.id);
}

TEST(RayColumns, RefuseResultsOfAnotherSize) {
  Tracer tracer = Tracer::create(cloud()).value();
  std::uint8_t one = 0;
  const RayColumns columns{3, {}, {}, {}, {}, {}};
  EXPECT_FALSE(tracer.any_of_columns(columns, {&one, 1}));
}

}  // namespace
}  // namespace boule::test::ray_columns
