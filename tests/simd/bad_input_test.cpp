// What the headers of simd, but for its kernels, say of bad input, entry by entry. What the
// entry by entry. What the kernels take: tests/equivalence/kernel_bad_input_test.cpp,
// contract_test.cpp.
#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/optics/camera_builder.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/bvh_builder.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"

namespace boule::test {
namespace {

constexpr auto most_rays = static_cast<std::size_t>(-1);
constexpr auto nan = std::numeric_limits<float>::quiet_NaN();

// The sanitizers' operator new ends the program where it should throw.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr std::size_t impossible[] = {most_rays,          most_rays - 1,     most_rays - 14,
                                      most_rays - 15,     most_rays - 16,    most_rays / 2,
                                      most_rays / 4 + 1,  most_rays / 8 - 2, most_rays / 8 - 16,
                                      most_rays / 8 - 17, most_rays / 64};

TEST(BadInput, ImpossibleSizesLeaveArraysUnchanged) {
  AlignedArray<double> array(20, 3);
  const double* const before = array.data();
  for (const std::size_t size : impossible) {
    EXPECT_THROW(array.resize(size), std::bad_alloc) << size;
    EXPECT_THROW(AlignedArray<SphereBlock>{size}, std::bad_alloc) << size;
  }
  EXPECT_EQ(array.data(), before);
  EXPECT_EQ(array[19], 3);
}

template <class Buffer>
void refuse_and_stay() {
  Buffer buffer;
  buffer.resize(5);
  for (const std::size_t size : impossible) EXPECT_THROW(buffer.resize(size), std::bad_alloc);
  EXPECT_EQ(buffer.size(), 5U);
  EXPECT_EQ(buffer.view().size, 5U);
}

TEST(BadInput, ImpossibleSizesLeaveBuffersUnchanged) {
  refuse_and_stay<RayBuffer>();
  refuse_and_stay<HitBuffer>();
  refuse_and_stay<SampleBuffer>();
}
#endif

/// One that forgot what it gave away would hand out null.
TEST(BadInput, MovedFromArraysCanBeResized) {
  AlignedArray<int> first(40, 1);
  AlignedArray<int> second = std::move(first);
  EXPECT_EQ(first.data(), nullptr);  // NOLINT: that is the test
  first.resize(7, 5);
  ASSERT_NE(first.data(), nullptr);
  EXPECT_EQ(first[6], 5);
  second = std::move(first);
  EXPECT_EQ(second[6], 5);
  first.resize(30, 6);
  ASSERT_NE(first.data(), nullptr);
  EXPECT_EQ(first[29], 6);

  RayBuffer rays(40);
  const RayBuffer kept = std::move(rays);
  rays.resize(3);
  ASSERT_NE(rays.view().org_x, nullptr);
  rays.set(2, {{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(rays.get(2).org, (Vec3d{1, 2, 3}));
  EXPECT_EQ(kept.size(), 40U);
}

TEST(BadInput, NoSpheresAreNoBlocks) {
  const Geometry nothing({}, {});
  EXPECT_EQ(nothing.view().spheres.block_count, 0U);
  EXPECT_EQ(nothing.view().planes.size, 0U);
}

TEST(BadInput, ExceptionsOfParallelForPropagate) {
  const std::vector<Sphere> spheres(100, Sphere{{nan, 0, 0}, 1, 0});
  const ParallelFor failing = [](std::size_t, const auto&) { throw std::runtime_error("no"); };
  EXPECT_THROW(Geometry(spheres, {}, Structure::bvh, failing), std::runtime_error);
  EXPECT_THROW(build_bvh(spheres, failing), std::runtime_error);
  EXPECT_THROW(build_bvh(spheres, ParallelFor{}), std::bad_function_call);
  EXPECT_NO_THROW(Geometry(spheres, {}, static_cast<Structure>(9)));
}

TEST(BadInput, UnknownIsaNamesAreRefused) {
  for (const std::string& name :
       {std::string(), std::string("AVX2"), std::string("avx2 "), std::string("avx2\0", 5),
        std::string("\xff\xfe"), std::string(100'000, 'a')}) {
    const auto kernels = select_kernels(name);
    ASSERT_FALSE(kernels) << name.size();
    EXPECT_NE(kernels.error().message.find("expected one of auto, scalar"), std::string::npos);
    EXPECT_LT(kernels.error().message.size(), 200U);
  }
  EXPECT_EQ(isa_name(static_cast<Isa>(99)), "");
}

}  // namespace
}  // namespace boule::test
