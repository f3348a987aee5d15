#include "render/files/particles/particle_spheres.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>

#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::error_of;
using test::row_of;
using test::row_of_particles;
using test::spheres_of;
using test::threaded_for;
using testing::HasSubstr;

bool same_bits(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
  static_assert(sizeof(Sphere) == 20);
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Sphere)) == 0;
}

/// Atoms with three decimals, as in a PDB file, on multiples of 2^-10 so that moving is exact.
ParticleFrame protein(std::size_t count, const Vec3d& moved) {
  const char* const elements[] = {"C", "N", "O", "H", "S"};
  ParticleFrame frame;
  std::vector<std::string> species;
  for (std::size_t i = 0; i < count; ++i) {
    const auto axis = [&](std::size_t k) { return double(i * k % 65521) * 0x1p-10 - 32; };
    frame.positions.push_back(moved + Vec3d{axis(48271), axis(16807), axis(69621)});
    species.emplace_back(elements[i % 5]);
  }
  frame.species = test::text_column("element", species);
  frame.cell = ParticleCell{{70, 0, 0}, {10, 60, 0}, {5, 7, 80}, moved, {true, true, true}};
  return frame;
}

TEST(ParticleSpheres, AreTheSameFarFromTheOrigin) {
  const Vec3d far{1e6, 1e6, 1e6};
  for (const std::array<int, 3>& replicate : {std::array{1, 1, 1}, std::array{2, 1, 3}}) {
    const ParticleStyle style{.replicate = replicate};
    const auto here = spheres_of(protein(2000, {}), style);
    ASSERT_FALSE(here.empty());
    EXPECT_TRUE(same_bits(spheres_of(protein(2000, far), style, far), here));
    EXPECT_FALSE(same_bits(spheres_of(protein(2000, far), style), here));
  }
}

TEST(ParticleSpheres, AreRoundedOnce) {
  ParticleFrame frame = row_of_particles(1);
  frame.positions[0] = {1.0 / 3, 16777217.5, -1e-3};
  const auto spheres = spheres_of(frame, {.radius = 0.1, .scale = 0.3}, {0.1, 16777216, 0});
  ASSERT_EQ(spheres.size(), 1U);
  EXPECT_EQ(spheres[0].center.x, static_cast<float>(1.0 / 3 - 0.1));
  EXPECT_EQ(spheres[0].center.y, 1.5F);
  EXPECT_EQ(spheres[0].center.z, -1e-3F);
  EXPECT_EQ(spheres[0].radius, static_cast<float>(0.1 * 0.3));
}

TEST(ParticleSpheres, AreAppended) {
  std::vector<Sphere> spheres(2);
  for (const Vec3d& origin : {Vec3d{}, Vec3d{1, 0, 0}}) {
    auto made = ParticleSpheres::make(row_of_particles(3), {.radius = 1.0}).value();
    ASSERT_TRUE(std::move(made).append_to(spheres, origin));
  }
  ASSERT_EQ(spheres.size(), 8U);
  EXPECT_EQ(spheres[4].center.x, 2);
  EXPECT_EQ(spheres[7].center.x, 1);
}

TEST(ParticleSpheres, KeepCellNotesAndBounds) {
  ParticleFrame frame = protein(100, {});
  frame.notes = {"a note of the file"};
  const auto made = ParticleSpheres::make(frame, {}).value();
  EXPECT_EQ(made.size(), 100U);
  EXPECT_EQ(made.notes().front(), "a note of the file");
  EXPECT_EQ(made.cell()->b, (Vec3d{10, 60, 0}));
  EXPECT_EQ(made.center_bounds()[0].x, -32);
  EXPECT_FALSE(ParticleSpheres::make(row_of_particles(2), {}).value().cell().has_value());
}

TEST(ParticleSpheres, OfNoParticles) {
  for (const ParticleStyle& style :
       {ParticleStyle{}, ParticleStyle{.color = MappedColors{.by = "x"}},
        ParticleStyle{.select = "x > 0 && y == z"}}) {
    auto made = ParticleSpheres::make(ParticleFrame(), style);
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made.value().size(), 0U);
    EXPECT_EQ(made.value().center_bounds()[0], made.value().center_bounds()[1]);
    EXPECT_EQ(made.value().smallest_radius(), 0);
    std::vector<Sphere> spheres;
    EXPECT_TRUE(std::move(made).value().append_to(spheres, {}));
  }
}

TEST(ParticleSpheres, RefusePositionsThatNoFloatHas) {
  ParticleFrame frame = row_of_particles(3);
  frame.positions[1].z = 1e40;
  auto made = ParticleSpheres::make(frame, {.radius = 1.0}).value();
  std::vector<Sphere> spheres(5);
  const Status done = std::move(made).append_to(spheres, {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().key, "file");
  EXPECT_EQ(done.error().message,
            "the position of particle 2 of 3 is too far from the origin for a sphere");
  EXPECT_EQ(spheres.size(), 5U);
}

TEST(ParticleSpheres, AreTheSameForAnyThreads) {
  ParticleFrame frame = protein(300000, {});
  for (const char* name : {"q", "vx", "vy", "vz"}) {
    NumberColumn column{name, {}};
    for (std::size_t i = 0; i < frame.size(); ++i) {
      column.values.push_back(double(i * (column.name[0] + column.name.size()) % 7919));
    }
    frame.numbers.push_back(column);
  }
  for (const ParticleStyle& style :
       {ParticleStyle{.color = MappedColors{.by = "|v|"}},
        ParticleStyle{.select = "q > 100 && species != 'H'", .wrap = true, .replicate = {1, 2, 1}},
        ParticleStyle{.radius = RadiusTable::covalent, .color = MappedColors{.by = "q"}}}) {
    auto serial = ParticleSpheres::make(frame, style).value();
    const std::vector<std::string> notes = serial.notes();
    const std::array<Vec3d, 2> bounds = serial.center_bounds();
    std::vector<Sphere> expected;
    ASSERT_TRUE(std::move(serial).append_to(expected, {1, 2, 3}));
    for (const std::size_t threads : {2, 5}) {
      auto made = ParticleSpheres::make(frame, style, threaded_for(threads)).value();
      EXPECT_EQ(made.notes(), notes);
      EXPECT_EQ(made.center_bounds(), bounds);
      std::vector<Sphere> spheres;
      ASSERT_TRUE(std::move(made).append_to(spheres, {1, 2, 3}, threaded_for(threads)));
      EXPECT_TRUE(same_bits(spheres, expected));
    }
  }
}

/// Tables by text are as long as lists by particle where each has a text of its own.
TEST(ParticleSpheres, KeepTablesWhileParticlesAreLetGo) {
  const std::size_t count = 600000;
  ParticleFrame frame = row_of_particles(count);
  TextColumn colors{"color", {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    std::string code = "#000000";
    for (std::size_t k = 0; k < 6; ++k) code[6 - k] = "0123456789abcdef"[i >> 4 * k & 15];
    colors.texts.push_back(code);
    colors.indices.push_back(static_cast<std::uint32_t>(count - 1 - i));
  }
  frame.texts.push_back(std::move(colors));
  const auto spheres = spheres_of(frame, {.radius = 1.0});
  ASSERT_EQ(spheres.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t code = count - 1 - i;
    const auto part = [&](int shift) { return static_cast<std::uint8_t>(code >> shift); };
    const SrgbColor color{part(16), part(8), part(0)};
    ASSERT_EQ(spheres[i].material, MaterialRef::colored(0, color)) << i;
    ASSERT_EQ(spheres[i].center.x, static_cast<float>(i));
  }
}

TEST(ParticleSpheres, RefuseWhatDoesNotFitIntoMemory) {
  ParticleFrame frame = row_of_particles(1);  // too few to be instances
  frame.cell = ParticleCell{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}, {true, true, true}};
  const ParticleStyle style{.radius = 1.0, .replicate = {1000, 1000, 2000}};
  rlimit saved{};
  getrlimit(RLIMIT_AS, &saved);
  const rlimit limit{rlim_t{20} << 30, saved.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const std::string error = error_of(frame, style);
  setrlimit(RLIMIT_AS, &saved);
  EXPECT_THAT(error,
              HasSubstr("replicate: 2000000000 spheres need 38147 MiB of memory, there are"));
}

TEST(ParticleSpheres, ShareManyImagesOfManyParticles) {
  const auto are_shared = [](std::size_t particles, const std::array<int, 3>& replicate) {
    ParticleFrame frame = row_of_particles(particles);
    frame.cell = ParticleCell{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}, {true, true, true}};
    return ParticleSpheres::make(frame, {.radius = 1.0, .replicate = replicate})
        .value()
        .shares_images();
  };
  EXPECT_TRUE(are_shared(1024, {16, 32, 32}));  // 2^24
  EXPECT_FALSE(are_shared(1023, {16, 32, 32}));
  EXPECT_FALSE(are_shared(100, {100, 100, 100}));
  EXPECT_TRUE(are_shared(1000, {100, 100, 300}));  // 3 x 10^9, more than one tree can have
  ParticleFrame frame = row_of_particles(1000);
  frame.cell = ParticleCell{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}, {true, true, true}};
  EXPECT_EQ(error_of(frame, {.radius = 1.0, .replicate = {100, 100, 500}}),
            "replicate: more than 4294967293 spheres");
}

}  // namespace
}  // namespace boule
