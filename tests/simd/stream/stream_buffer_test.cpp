#include "simd/stream/stream_buffer.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace boule::test {
namespace {

TEST(AlignedArray, IsAlignedPaddedAndFilled) {
  for (const std::size_t size : {1U, 15U, 16U, 17U, 1000U}) {
    AlignedArray<float> array(size, 2.5F);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % stream_alignment, 0U);
    for (std::size_t i = 0; i < padded(size); ++i) ASSERT_EQ(array[i], 2.5F);
  }
}

TEST(AlignedArray, ResizingWithinCapacityKeepsTheMemory) {
  AlignedArray<int> array(100);
  array[99] = 7;
  const int* before = array.data();
  array.resize(3);
  array.resize(100);
  EXPECT_EQ(array.data(), before);
  EXPECT_EQ(array[99], 7);
}

TEST(AlignedArray, ImpossibleSizesThrowBadAlloc) {
  EXPECT_THROW(AlignedArray<double>(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

TEST(Padded, RoundsUpToTheWidestPacket) {
  EXPECT_EQ(padded(0), 0U);
  EXPECT_EQ(padded(1), 16U);
  EXPECT_EQ(padded(16), 16U);
  EXPECT_EQ(padded(17), 32U);
}

TEST(RayBuffer, ReturnsWhatWasSet) {
  RayBuffer buffer(3);
  Ray ray{{1e-30, 2, 3.1415926535897931}, {4, 5, 6}};
  ray.tmin = 0.25F;
  ray.tmax = 9;
  ray.source = 12;
  ray.inside = true;
  buffer.set(2, ray);
  const Ray back = buffer.get(2);
  EXPECT_EQ(back.org, ray.org);
  EXPECT_EQ(back.dir, ray.dir);
  EXPECT_EQ(back.tmin, ray.tmin);
  EXPECT_EQ(back.tmax, ray.tmax);
  EXPECT_EQ(back.source, 12);
  EXPECT_TRUE(back.inside);
  EXPECT_EQ(buffer.view().size, 3U);
  EXPECT_EQ(buffer.view().org_z[2], ray.org.z);
}

Ray ray_with(double x, float direction, float tmin) {
  Ray ray{{x, 2 * x, 3 * x}, {direction, 0, 1}};
  ray.tmin = tmin;
  ray.tmax = tmin + 1;
  ray.source = static_cast<std::int32_t>(x);
  ray.inside = tmin > 1;
  return ray;
}

TEST(RayBuffer, RaysShareAnOriginAndAStart) {
  RayBuffer buffer;
  buffer.resize(100, CommonPart::origin);
  buffer.share(ray_with(7, 1, 2));
  for (std::size_t i = 0; i < 100; ++i) buffer.set(i, ray_with(3, static_cast<float>(i), 0));
  for (std::size_t i = 0; i < 100; ++i) {
    const Ray ray = buffer.get(i);
    EXPECT_EQ(ray.org, (Vec3d{7, 14, 21}));
    EXPECT_EQ(ray.dir, (Vec3f{static_cast<float>(i), 0, 1}));
    EXPECT_EQ(ray.tmin, 2);
    EXPECT_EQ(ray.tmax, 1);
    EXPECT_EQ(ray.source, 7);
    EXPECT_TRUE(ray.inside);
  }
  EXPECT_TRUE(buffer.view().shared.has_origin());
  EXPECT_FALSE(buffer.view().shared.has_direction());
}

TEST(RayBuffer, RaysShareADirectionAndAStart) {
  RayBuffer buffer;
  buffer.resize(40, CommonPart::direction);
  buffer.share(ray_with(7, 1, 2));
  for (std::size_t i = 0; i < 40; ++i) buffer.set(i, ray_with(static_cast<double>(i), 9, 0));
  const RayStream rest = part(buffer.view(), 32, 8);
  for (std::size_t i = 0; i < 8; ++i) {
    const Ray ray = get_ray(rest, i);
    EXPECT_EQ(ray.org.x, static_cast<double>(32 + i));
    EXPECT_EQ(ray.dir, (Vec3f{1, 0, 1}));
    EXPECT_EQ(ray.tmin, 2);
    EXPECT_EQ(ray.source, 7);
  }
}

/// Used again for rays that share nothing, a buffer has all their numbers.
TEST(RayBuffer, ForgetsWhatRaysShared) {
  RayBuffer buffer;
  buffer.resize(50, CommonPart::origin);
  buffer.share(ray_with(7, 1, 2));
  buffer.resize(50);
  for (std::size_t i = 0; i < 50; ++i) buffer.set(i, ray_with(static_cast<double>(i), 1, 0));
  EXPECT_EQ(buffer.get(49).org.x, 49);
  EXPECT_EQ(buffer.get(1).source, 1);
  EXPECT_EQ(buffer.get(49).tmin, 0);
  buffer.shrink(20);
  EXPECT_EQ(buffer.view().size, 20U);
}

}  // namespace
}  // namespace boule::test
