#include "render/files/particles/boundary_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/files/particles/particle_frames.h"

// Particles on faces of the cell, on the opposite ones too.

namespace boule {
namespace {

using test::error_of;
using test::notes_of;
using test::row_of_particles;
using test::spheres_of;
using testing::HasSubstr;

constexpr std::array<bool, 3> along_all{true, true, true};
const ParticleCell upright_cell{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {}, along_all};
const ParticleCell slanted{{5, 0, 0}, {1.5, 4, 0}, {-2, 0.7, 3}, {-1, 2, 0.5}, along_all};

/// Rock salt: a particle at each half of the cell's vectors.
ParticleFrame salt_in(const ParticleCell& cell) {
  ParticleFrame frame;
  frame.cell = cell;
  for (int i = 0; i < 8; ++i) {
    const auto half = [&](int bit) { return (i >> bit & 1) * 0.5; };
    frame.positions.push_back(cell.origin + cell.a * half(0) + cell.b * half(1) + cell.c * half(2));
  }
  return frame;
}

/// Whether there is just one sphere at a point.
bool has_one_at(const std::vector<Sphere>& spheres, const Vec3d& point) {
  return std::count_if(spheres.begin(), spheres.end(), [&](const Sphere& sphere) {
           const Vec3d way = vec_cast<double>(sphere.center) - point;
           return dot(way, way) < 1e-9;
         }) == 1;
}

std::vector<Capsule> bonds_on_faces(const ParticleFrame& frame, const ParticleStyle& style) {
  std::vector<Capsule> capsules;
  const auto made = ParticleSpheres::make(frame, style);
  EXPECT_TRUE(made.ok() && made.value().append_capsules_to(capsules, {}).ok());
  return capsules;
}

TEST(Boundary, SaltFillsCornersEdgesAndFaces) {
  for (const ParticleCell& cell : {upright_cell, slanted}) {
    const auto spheres = spheres_of(salt_in(cell), {.radius = 1.0, .boundary = true});
    EXPECT_EQ(spheres.size(), 27U);
    for (int i = 0; i < 27; ++i) {
      EXPECT_TRUE(has_one_at(spheres, cell.origin + cell.a * (i % 3 * 0.5) +
                                          cell.b * (i / 3 % 3 * 0.5) + cell.c * (i / 9 * 0.5)));
    }
  }
}

TEST(Boundary, FacesAreThoseOfAllImages) {
  const auto spheres =
      spheres_of(salt_in(slanted), {.radius = 1.0, .boundary = true, .replicate = {2, 1, 3}});
  EXPECT_EQ(spheres.size(), 5U * 3 * 7);
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < 7; ++z) {
        EXPECT_TRUE(has_one_at(spheres, slanted.origin + slanted.a * (x * 0.5) +
                                            slanted.b * (y * 0.5) + slanted.c * (z * 0.5)));
      }
    }
  }
}

TEST(Boundary, ParticlesNearAFaceCount) {
  ParticleFrame frame = row_of_particles(4);
  frame.cell = upright_cell;
  frame.positions = {{0.0019, 1, 1}, {1.9981, 1, 1}, {0.0021, 1, 1}, {1, -0.0019, 1}};
  const auto spheres = spheres_of(frame, {.radius = 1.0, .boundary = true});
  ASSERT_EQ(spheres.size(), 7U);
  EXPECT_EQ(spheres[4].center, (Vec3f{2.0019F, 1, 1}));
  EXPECT_EQ(spheres[5].center, (Vec3f{-0.0019F, 1, 1}));
  EXPECT_EQ(spheres[6].center, (Vec3f{1, 1.9981F, 1}));
}

TEST(Boundary, OnlyPeriodicDirectionsCount) {
  ParticleFrame frame = salt_in(upright_cell);
  frame.cell->periodic = {true, false, true};
  EXPECT_EQ(spheres_of(frame, {.radius = 1.0, .boundary = true}).size(), 18U);
  frame.cell->periodic = {};
  EXPECT_EQ(spheres_of(frame, {.radius = 1.0, .boundary = true}).size(), 8U);
  EXPECT_THAT(notes_of(frame, {.radius = 1.0, .boundary = true}),
              HasSubstr("nothing is repeated on its faces"));
  frame.cell = ParticleCell{{2, 0, 0}, {0, 2, 0}, {}, {}, along_all};
  EXPECT_EQ(spheres_of(frame, {.radius = 1.0, .boundary = true}).size(), 18U);
}

TEST(Boundary, BoundsAreThoseOfAllSpheres) {
  const auto made =
      ParticleSpheres::make(salt_in(upright_cell), {.radius = 1.0, .boundary = true}).value();
  EXPECT_EQ(made.size(), 27U);
  EXPECT_EQ(made.center_bounds(), (std::array<Vec3d, 2>{Vec3d{}, Vec3d{2, 2, 2}}));
}

TEST(Boundary, BondsJoinWhatIsShownOnce) {
  const auto capsules =
      bonds_on_faces(salt_in(upright_cell), {.radius = 0.2, .bonds = 1.1, .boundary = true});
  // Lines of two bonds along each of nine edges, in three directions.
  ASSERT_EQ(capsules.size(), 54U);
  for (const Capsule& one : capsules) {
    const Vec3d way = vec_cast<double>(one.b) - vec_cast<double>(one.a);
    EXPECT_DOUBLE_EQ(dot(way, way), 1);
    EXPECT_EQ(std::count_if(capsules.begin(), capsules.end(),
                            [&](const Capsule& other) {
                              return (other.a == one.a && other.b == one.b) ||
                                     (other.a == one.b && other.b == one.a);
                            }),
              1);
  }
}

TEST(Boundary, ArrowsAreRepeated) {
  ParticleFrame frame = row_of_particles(1);
  frame.cell = upright_cell;
  for (const char* name : {"fx", "fy", "fz"}) frame.numbers.push_back({name, {0.5}});
  const ParticleStyle style{.radius = 0.2, .arrows = ArrowColumns{{"f"}}, .boundary = true};
  EXPECT_EQ(bonds_on_faces(frame, style).size(), 8U);
}

TEST(Boundary, RefusesFlatCells) {
  ParticleFrame frame = row_of_particles(2);
  EXPECT_EQ(error_of(frame, {.boundary = true}), "boundary: the file tells no cell with faces");
  frame.cell = ParticleCell{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {}, along_all};
  EXPECT_EQ(error_of(frame, {.boundary = true}),
            "boundary: the vectors of the file's cell lie in a plane or a line");
}

}  // namespace
}  // namespace boule
