#include "render/files/particles/cell_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::error_of;
using test::notes_of;
using test::row_of_particles;
using test::spheres_of;
using testing::HasSubstr;

constexpr std::array<bool, 3> all{true, true, true};

const ParticleCell tilted{{5, 0, 0}, {1.5, 4, 0}, {-2, 0.7, 3}, {-1, 2, 0.5}, all};
const ParticleCell left_handed{{0, 3, 0.2}, {5, 0.1, 0}, {0.3, 0, 4}, {100, -7, 3}, all};

/// Points around a cell, up to three cells away.
std::vector<Vec3d> points_around(const ParticleCell& cell) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 4000; ++i) {
    const auto part = [&](int k) { return ((i * k) % 4001) / 4001.0 * 7 - 3; };
    points.push_back(cell.origin + cell.a * part(7) + cell.b * part(911) + cell.c * part(1777));
  }
  return points;
}

using Long = long double;
using LongVec = Vec3<Long>;

LongVec long_of(const Vec3d& v) { return {Long(v.x), Long(v.y), Long(v.z)}; }

/// Fractions by Cramer's rule.
std::array<Long, 3> fractions_of(const Vec3d& point, const ParticleCell& cell) {
  const LongVec a = long_of(cell.a), b = long_of(cell.b), c = long_of(cell.c);
  const LongVec p = long_of(point) - long_of(cell.origin);
  const Long volume = dot(a, cross(b, c));
  return {dot(p, cross(b, c)) / volume, dot(a, cross(p, c)) / volume, dot(a, cross(b, p)) / volume};
}

TEST(Wrap, MovesIntoTheCell) {
  for (ParticleCell cell : {tilted, left_handed}) {
    for (const auto& periodic :
         {all, std::array<bool, 3>{true, false, true}, std::array<bool, 3>{false, false, true}}) {
      cell.periodic = periodic;
      const std::vector<Vec3d> before = points_around(cell);
      std::vector<Vec3d> after = before;
      ASSERT_TRUE(wrap_into(cell, after, serial_for));
      for (std::size_t i = 0; i < before.size(); ++i) {
        const auto from = fractions_of(before[i], cell), to = fractions_of(after[i], cell);
        for (std::size_t k = 0; k < 3; ++k) {
          const Long moved = from[k] - to[k];
          // The positions are about 100 at most, the fractions' rounding is below 2^-40.
          EXPECT_NEAR(double(moved - std::round(moved)), 0, 1e-12);
          const bool is_inside = to[k] >= -1e-12L && to[k] < 1 + 1e-12L;
          EXPECT_TRUE(periodic[k] ? is_inside : std::fabs(moved) < 1e-12L);
        }
      }
    }
  }
}

TEST(Wrap, LeavesWhatIsInsideAsItIs) {
  std::vector<Vec3d> points;
  for (int i = 1; i < 100; ++i) {
    points.push_back(tilted.origin + (tilted.a + tilted.b + tilted.c) * (i / 100.0));
  }
  std::vector<Vec3d> after = points;
  ASSERT_TRUE(wrap_into(tilted, after, serial_for));
  EXPECT_EQ(after, points);
}

TEST(Wrap, VectorsOfLengthZeroAreNotPeriodic) {
  std::vector<Vec3d> points{{7, 8, 9}, {-1, -1, -1}};
  ASSERT_TRUE(wrap_into({{5, 0, 0}, {1, 4, 0}, {}, {}, {true, true, false}}, points, serial_for));
  EXPECT_EQ(points, (std::vector<Vec3d>{{0, 0, 9}, {5, 3, -1}}));
  points = {{7, 8, 9}};
  ASSERT_TRUE(wrap_into({{}, {0, 3, 0}, {}, {}, all}, points, serial_for));
  EXPECT_EQ(points, (std::vector<Vec3d>{{7, 2, 9}}));
}

TEST(Wrap, RefusesFlatCellsAndFarParticles) {
  ParticleFrame frame = row_of_particles(2);
  EXPECT_EQ(error_of(frame, {.wrap = true}), "wrap: the file tells no cell to wrap into");
  frame.cell = ParticleCell{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {}, all};
  EXPECT_EQ(error_of(frame, {.wrap = true}),
            "wrap: the vectors of the file's cell lie in a plane or a line");
  frame.cell = ParticleCell{{}, {}, {}, {}, all};
  EXPECT_THAT(error_of(frame, {.wrap = true}), HasSubstr("lie in a plane"));
  frame.cell = tilted;
  frame.positions[1] = {1e300, 0, 0};
  EXPECT_EQ(error_of(frame, {.radius = 1.0, .wrap = true}),
            "wrap: particle 2 of 2 is more than 1e9 cells away from the cell");
  EXPECT_EQ(error_of(frame, {.radius = 1.0, .select = "x < 1", .wrap = true}), "");
  frame.cell->periodic = {};
  EXPECT_THAT(notes_of(frame, {.radius = 1.0, .wrap = true}), HasSubstr("nothing is wrapped"));
}

TEST(Replicate, AddsImagesOneAfterTheOther) {
  ParticleFrame frame = row_of_particles(2);
  frame.positions = {{0.1, 0.2, 0.3}, {1.7, 3.1, 2.2}};
  frame.cell = tilted;
  const std::array<int, 3> counts{3, 2, 2};
  const auto spheres = spheres_of(frame, {.radius = 1.0, .replicate = counts});
  ASSERT_EQ(spheres.size(), 24U);
  std::size_t n = 0;
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        for (const Vec3d& position : frame.positions) {
          const LongVec exact = long_of(position) + long_of(tilted.a) * Long(i) +
                                long_of(tilted.b) * Long(j) + long_of(tilted.c) * Long(k);
          EXPECT_FLOAT_EQ(spheres[n].center.x, float(exact.x));
          EXPECT_FLOAT_EQ(spheres[n].center.y, float(exact.y));
          EXPECT_FLOAT_EQ(spheres[n].center.z, float(exact.z));
          ++n;
        }
      }
    }
  }
}

TEST(Replicate, BoundsAreThoseOfAllImages) {
  ParticleFrame frame = row_of_particles(3);
  frame.positions = {{0.5, 0.25, 0.75}, {1.5, 3, 2.25}, {-4, 8, 1}};
  frame.cell = ParticleCell{{5, 0, 0}, {1.5, 4, 0}, {-2, 0.75, 3}, {}, all};
  auto made = ParticleSpheres::make(frame, {.radius = 1.0, .replicate = {4, 3, 5}}).value();
  const std::array<Vec3d, 2> bounds = made.center_bounds();
  EXPECT_EQ(made.size(), 180U);
  std::vector<Sphere> spheres;
  ASSERT_TRUE(std::move(made).append_to(spheres, {}));
  Vec3f low = spheres[0].center, high = low;
  for (const Sphere& sphere : spheres) {
    for (float Vec3f::*const axis : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
      low.*axis = std::min(low.*axis, sphere.center.*axis);
      high.*axis = std::max(high.*axis, sphere.center.*axis);
    }
  }
  EXPECT_EQ(bounds[0], vec_cast<double>(low));
  EXPECT_EQ(bounds[1], vec_cast<double>(high));
}

TEST(Replicate, RefusesWhatIsWrong) {
  ParticleFrame frame = row_of_particles(2);
  const auto error = [&](std::array<int, 3> counts) {
    return error_of(frame, {.replicate = counts});
  };
  EXPECT_EQ(error({1, 1, 1}), "");
  EXPECT_EQ(error({1, 2, 1}), "replicate: the file tells no cell to replicate");
  frame.cell = ParticleCell{{5, 0, 0}, {0, 5, 0}, {}, {}, {true, false, false}};
  EXPECT_EQ(error({1, 1, 2}), "replicate: the file's cell has no vector c");
  EXPECT_EQ(error({1, 0, 1}), "replicate: expected three numbers from 1 on");
  EXPECT_EQ(error({-1, -1, 1}), "replicate: expected three numbers from 1 on");
  EXPECT_EQ(error({2, 2, 1}), "");
  EXPECT_THAT(notes_of(frame, {.replicate = {2, 2, 1}}),
              HasSubstr("not periodic along b, but is replicated along it"));
  frame.cell->c = {0, 0, 5};
  for (const std::array<int, 3>& many :
       {std::array{2000, 2000, 2000}, std::array{2147483647, 2147483647, 2147483647}}) {
    EXPECT_EQ(error(many), "replicate: more than 2147483647 spheres");
  }
}

}  // namespace
}  // namespace boule
