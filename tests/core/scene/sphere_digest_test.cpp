#include "core/scene/sphere_digest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace boule::test {
namespace {

/// More than two of the chunks that are hashed by themselves, and a rest.
std::vector<Sphere> row(std::size_t count = 40'001) {
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    spheres.push_back({{x, 0.5F * x, -x}, 1 + x, static_cast<std::uint32_t>(i % 3)});
  }
  return spheres;
}

std::uint64_t digest_of(std::span<const Sphere> spheres,
                        const ParallelFor& parallel_for = serial_for) {
  SphereDigest digest;
  digest.add(spheres, parallel_for);
  return digest.value();
}

/// The last first, as threads may have it.
void backward_for(std::size_t count, const std::function<void(std::size_t)>& function) {
  while (count-- > 0) function(count);
}

TEST(SphereDigest, IsIndependentOfThePartition) {
  const std::vector<Sphere> spheres = row();
  const std::uint64_t whole = digest_of(spheres);
  for (const std::size_t size : {1U, 1000U, 16'383U, 16'384U, 16'385U, 32'768U}) {
    SphereDigest digest;
    for (std::size_t first = 0; first < spheres.size(); first += size) {
      const auto rest = std::span(spheres).subspan(first);
      digest.add(rest.first(std::min(size, rest.size())));
    }
    EXPECT_EQ(digest.value(), whole) << size;
  }
}

TEST(SphereDigest, IsIndependentOfLoopOrder) {
  const std::vector<Sphere> spheres = row();
  EXPECT_EQ(digest_of(spheres, backward_for), digest_of(spheres));
}

TEST(SphereDigest, DependsOnEveryNumberAndItsPlace) {
  const std::vector<Sphere> spheres = row();
  std::vector<std::uint64_t> digests{digest_of(spheres)};
  for (const std::size_t at : {std::size_t{0}, std::size_t{16'384}, spheres.size() - 1}) {
    const auto changed = [&](const auto& change) {
      std::vector<Sphere> others = spheres;
      change(others[at]);
      digests.push_back(digest_of(others));
    };
    changed([](Sphere& one) { one.center.x = -one.center.x - 1; });
    changed([](Sphere& one) { one.center.y += 1; });
    changed([](Sphere& one) { one.center.z += 1; });
    changed([](Sphere& one) { one.radius += 1; });
    changed([](Sphere& one) { one.material = 7; });
    changed([](Sphere& one) { std::swap(one.center.x, one.radius); });
  }
  std::vector<Sphere> others = spheres;
  std::swap(others.front(), others.back());
  digests.push_back(digest_of(others));
  std::rotate(others.begin(), others.begin() + 16'384, others.end());
  digests.push_back(digest_of(others));
  std::sort(digests.begin(), digests.end());
  EXPECT_EQ(std::adjacent_find(digests.begin(), digests.end()), digests.end());
}

TEST(SphereDigest, DependsOnTheNumberOfSpheres) {
  const std::vector<Sphere> same(20'000, Sphere{});
  std::vector<std::uint64_t> digests;
  for (const std::size_t count : {0U, 1U, 2U, 16'383U, 16'384U, 16'385U, 20'000U})
    digests.push_back(digest_of(std::span(same).first(count)));
  std::sort(digests.begin(), digests.end());
  EXPECT_EQ(std::adjacent_find(digests.begin(), digests.end()), digests.end());
}

}  // namespace
}  // namespace boule::test
