// The solvers of textbooks find the same hits by a tree as by a scan.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/scenes/bench_scenes.h"
#include "bench/scenes/camera_rays.h"
#include "bench/textbook/book_arrays.h"
#include "simd/geometry/geometry.h"
#include "tests/support/kernel_runs.h"

namespace boule::bench {
namespace {

using test::OnEachIsa;

std::vector<Sphere> spheres_of(const std::string& scene) {
  return make_scene(scene).value().spheres;
}

std::vector<Ray> camera_rays_of(const std::string& scene) {
  const RayBuffer rays = primary_rays(make_scene(scene).value(), 64);
  std::vector<Ray> all;
  for (std::size_t i = 0; i < rays.size(); ++i) all.push_back(rays.get(i));
  return all;
}

/// Rays from around the unit cube and from within it; some along axes, with zeros of either sign.
std::vector<Ray> axis_rays() {
  std::vector<Ray> rays;
  for (int k = 0; k < 4096; ++k) {
    const float x = static_cast<float>(k % 64) / 63, y = static_cast<float>(k / 64) / 63;
    const float sign = k % 2 == 0 ? 1.0F : -1.0F, zero = k % 3 == 0 ? -0.0F : 0.0F;
    const float from = 0.5F - sign * static_cast<float>(k % 5) / 4;
    const Vec3f org[] = {{from, x, y}, {y, from, x}, {x, y, from}};
    const Vec3f dir[] = {{sign, zero, 0}, {zero, sign, 0}, {0, zero, sign}};
    rays.push_back({vec_cast<double>(org[k % 3]), dir[k % 3]});
  }
  return rays;
}

std::vector<std::uint32_t> bits_of(const BookData& data) {
  std::vector<std::uint32_t> bits;
  for (std::size_t i = 0; i < data.rays; ++i)
    bits.push_back(std::bit_cast<std::uint32_t>(data.t[i]));
  return bits;
}

/// Counts the rays whose t differs in any bit between tree and scan.
std::size_t count_differing(const BookSolver& solver, const BookData& data) {
  solver.nearest(data);
  const std::vector<std::uint32_t> scanned = bits_of(data);
  solver.traverse(data);
  const std::vector<std::uint32_t> traversed = bits_of(data);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < scanned.size(); ++i) differ += scanned[i] == traversed[i] ? 0 : 1;
  return differ;
}

class BookSolvers : public OnEachIsa {
 protected:
  void expect_same(const std::vector<Sphere>& spheres, const std::vector<Ray>& rays) const {
    const Geometry tree(spheres, {}, Structure::bvh);
    BookArrays book(spheres.size(), rays.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) book.set(i, spheres[i]);
    for (std::size_t i = 0; i < rays.size(); ++i) book.set(i, rays[i]);
    book.set(tree.view());
    ASSERT_FALSE(book_solvers(kernels->isa).empty());
    for (const BookSolver& solver : book_solvers(kernels->isa))
      EXPECT_EQ(count_differing(solver, book.data()), 0U) << solver.name;
  }
};
INSTANTIATE_TEST_SUITE_P(Isas, BookSolvers, test::each_isa(), test::isa_name);

TEST_P(BookSolvers, FindTheSameInATreeAsByAScan) {
  expect_same(spheres_of("u1000"), camera_rays_of("u1000"));
}

TEST_P(BookSolvers, FindTheSameAlongTheAxes) { expect_same(spheres_of("u1000"), axis_rays()); }

/// The largest balls of a flake are in no leaf, and in a small scene no ball is.
TEST_P(BookSolvers, ScanWhatIsApartFromTheTree) {
  for (const char* scene : {"flake2", "u1", "u5"})
    expect_same(spheres_of(scene), camera_rays_of(scene));
}

}  // namespace
}  // namespace boule::bench
