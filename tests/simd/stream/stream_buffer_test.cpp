#include "simd/stream/stream_buffer.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace boule::test {
namespace {

TEST(AlignedArray, StartsOnACacheLineAndIsPaddedAndFilled) {
  for (const std::size_t size : {1U, 15U, 16U, 17U, 1000U}) {
    AlignedArray<float> array(size, 2.5F);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % stream_alignment, 0U);
    for (std::size_t i = 0; i < padded(size); ++i) ASSERT_EQ(array[i], 2.5F);
  }
}

TEST(AlignedArray, ShrinkingAndRegrowingWithinItsMemoryKeepsIt) {
  AlignedArray<int> array(100);
  array[99] = 7;
  const int* before = array.data();
  array.resize(3);
  array.resize(100);
  EXPECT_EQ(array.data(), before);
  EXPECT_EQ(array[99], 7);
}

TEST(AlignedArray, AnImpossibleSizeIsBadAlloc) {
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

}  // namespace
}  // namespace boule::test
