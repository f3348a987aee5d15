#include <gtest/gtest.h>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "core/math/warp.h"
#include "tests/render/shading/lobe_twin.h"
#include "tests/support/test_scenes.h"

namespace boule::test::lobes {
namespace {

/// A surface with normal z, seen at this angle from the normal.
Surface seen_at(double angle) {
  Surface surface{};
  surface.normal = {0, 0, 1};
  surface.view = {std::sin(angle), 0, -std::cos(angle)};
  surface.cosine = std::cos(angle);
  surface.mirrored = {std::sin(angle), 0, std::cos(angle)};
  return surface;
}

const Material materials[] = {Matte{{0.2f, 0.5f, 0.8f}},
                              Plastic{{0.1f, 0.3f, 0.5f}, 0.3f, 12, 0.1f},
                              Plastic{{0.8f, 0.8f, 0.8f}, 0.6f, 3, 0},
                              Metal{{0.9f, 0.5f, 0.1f}},
                              Glass{{0.9f, 1, 0.9f}, 1.5f},
                              Phong{{0.5f, 0.4f, 0.3f}, 0, 0.6f, 0.2f, 8, 0.3f, 1.3f}};

constexpr std::uint32_t samples = 16384;

/// Bounce i of a sequence of random ones.
Bounce bounce_by_chance(const LobeSampler& lobes, std::uint32_t i) {
  const LobeSampler::Choice choice = lobes.choose(sobol_pair(1, RandomSet::film, i));
  return lobes.bounce(choice, direction_about(lobes.axis(choice), choice.from, choice.turns));
}

/// In white light the mean weight of bounces is the light that the lobes send on: a quadrature of
/// the diffuse lobe and the highlight, plus the weights of the reflected and the refracted ray.
TEST(LobeSampler, MeanBounceWeightEqualsTheLobesAlbedo) {
  for (const Material& material : materials) {
    for (const double angle : {0.1, 0.8, 1.4}) {
      const FlatMaterial flat = flatten_for_paths(material);
      const Surface surface = seen_at(angle);
      const LobeSampler lobes(flat, surface);
      Color by_chance, expected;
      for (std::uint32_t i = 0; i < samples; ++i) {
        by_chance = by_chance + bounce_by_chance(lobes, i).weight * (1.0f / samples);
        const auto [u, v] = sobol_pair(2, RandomSet::film, i);
        const Vec3d w = direction_about({0, 0, 1}, warp_to_cone(u, 1.0), v);
        expected = expected + lobes.reflected(w.z, w) * (2.0f / samples);
      }
      const Scatter weights = scatter(flat, surface);
      expected = expected + weights.reflection + weights.refraction;
      EXPECT_NEAR(by_chance.r, expected.r, 4e-3) << material.index() << " " << angle;
      EXPECT_NEAR(by_chance.g, expected.g, 4e-3) << material.index() << " " << angle;
      EXPECT_NEAR(by_chance.b, expected.b, 4e-3) << material.index() << " " << angle;
      EXPECT_LT(std::max({expected.r, expected.g, expected.b}), 1.001f) << material.index();
    }
  }
}

/// Directions are distributed by their density, counted over cells of the hemisphere.
TEST(LobeSampler, BouncesFollowTheirDensity) {
  for (const Material& material : materials) {
    const FlatMaterial flat = flatten_for_paths(material);
    const Surface surface = seen_at(0.7);
    const LobeSampler lobes(flat, surface);
    double counts[4][4] = {}, expected[4][4] = {};
    const auto cell = [](const Vec3d& w) {
      return std::pair{static_cast<int>(w.z * 3.999), (w.x > 0 ? 1 : 0) + (w.y > 0 ? 2 : 0)};
    };
    for (std::uint32_t i = 0; i < samples; ++i) {
      const Bounce bounce = bounce_by_chance(lobes, i);
      const auto [u, v] = sobol_pair(2, RandomSet::film, i);
      const Vec3d w = direction_about({0, 0, 1}, warp_to_cone(u, 1.0), v);
      const auto [row, column] = cell(w);
      expected[row][column] += lobes.density(w.z, w) * 2 * elementary::pi / samples;
      if (!(bounce.density > 0)) continue;
      EXPECT_NEAR(bounce.density, lobes.density(bounce.direction.z, bounce.direction), 1e-12);
      const auto [r, c] = cell(bounce.direction);
      counts[r][c] += 1.0 / samples;
    }
    for (int i = 0; i < 16; ++i) {
      EXPECT_NEAR(counts[i / 4][i % 4], expected[i / 4][i % 4], 4e-3) << material.index();
    }
  }
}

TEST(LobeSampler, AmbientLightIsLeftOut) {
  EXPECT_EQ(flatten_for_paths(Phong{gray(1), 0.5f}).constant, gray(0));
  EXPECT_EQ(flatten_for_paths(Emissive{{1, 2, 3}}).constant, (Color{1, 2, 3}));
}

/// A material that sends on less light than it gets stays as it is; one that would send on more is
/// scaled to send on all of it.
TEST(LobeSampler, EnergyIsConserved) {
  const FlatMaterial modest = flatten_for_paths(Plastic{{0.5f, 0.4f, 0.3f}, 0.25f, 10, 0.25f});
  EXPECT_EQ(modest.diffuse, (Color{0.5f, 0.4f, 0.3f}));
  EXPECT_EQ(modest.highlight, 0.25 * 6);
  EXPECT_EQ(highlight_albedo(modest), 0.25);
  const FlatMaterial greedy = flatten_for_paths(Plastic{{1, 0.5f, 0}, 0.5f, 10, 0.5f});
  EXPECT_EQ(greedy.diffuse, (Color{0.5f, 0.25f, 0}));
  EXPECT_EQ(highlight_albedo(greedy), 0.25);
  EXPECT_EQ(greedy.mirror, gray(0.25f));
  const FlatMaterial greatest = flatten_for_paths(Phong{gray(1), 0, 1, 3e38f, 10, 3e38f, 1});
  EXPECT_NEAR(greatest.mirror.r, 1 / 3.0, 1e-6);
  EXPECT_NEAR(greatest.transmission.r, 1 / 3.0, 1e-6);
  EXPECT_NEAR(highlight_albedo(greatest), 1 / 3.0, 1e-6);
  // Its colour times kd is above the largest float.
  const FlatMaterial brightest = flatten_for_paths(Phong{gray(3e38f), 0, 3e38f});
  EXPECT_NEAR(brightest.diffuse.r, 1, 1e-6);
}

}  // namespace
}  // namespace boule::test::lobes
