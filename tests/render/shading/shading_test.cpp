#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/optics/dielectric.h"
#include "render/shading/background_radiance.h"
#include "render/shading/bsdf.h"
#include "render/shading/lights.h"
#include "tests/render/shading/direct_light_twin.h"
#include "tests/support/case_random.h"

namespace boule::test::shading {
namespace {

constexpr double degree = 3.141592653589793 / 180;

/// The direction, in the x-y plane, that comes down on y = 0 at `angle` radians from the normal.
Vec3d coming_down(double angle) { return {std::sin(angle), -std::cos(angle), 0}; }
const Vec3d up{0, 1, 0};

Surface seen_at(double angle, bool inner = false) {
  Surface surface{};
  surface.normal = up;
  surface.view = coming_down(angle);
  surface.cosine = std::cos(angle);
  surface.mirrored = {std::sin(angle), std::cos(angle), 0};
  surface.inner = inner;
  surface.solid = true;
  return surface;
}

TEST(Dielectric, ObeysSnellsLaw) {
  for (const double eta : {0.25, 1 / 1.5, 1.0, 1.3}) {
    for (double angle = 0; angle < 45 * degree; angle += degree) {
      const Refraction bent = refract(coming_down(angle), up, std::cos(angle), eta);
      ASSERT_FALSE(bent.total);
      EXPECT_NEAR(bent.direction.x, eta * std::sin(angle), 1e-15);
      EXPECT_NEAR(length(bent.direction), 1, 1e-15);
      EXPECT_NEAR(bent.direction.y, -bent.cosine, 1e-15);
    }
  }
}

TEST(Dielectric, ReflectsTotallyBeyondTheCriticalAngle) {
  const double critical = std::asin(1 / 1.5);
  EXPECT_FALSE(refract(coming_down(critical - 1e-6), up, std::cos(critical - 1e-6), 1.5).total);
  EXPECT_TRUE(refract(coming_down(critical + 1e-6), up, std::cos(critical + 1e-6), 1.5).total);
  EXPECT_TRUE(refract({1, 0, 0}, up, 0.0, 1.0).total);  // along the surface nothing goes through
  EXPECT_FALSE(refract({1, 0, 0}, up, 0.0, 0.99).total);
}

TEST(Dielectric, FresnelHasItsKnownValues) {
  const auto reflected = [](double angle, double eta) {
    const double beyond = std::sqrt(1 - eta * eta * std::sin(angle) * std::sin(angle));
    return fresnel(std::cos(angle), {.direction = {}, .cosine = beyond, .total = false}, eta);
  };
  // Head on: ((n - 1) / (n + 1))^2, from either side.
  EXPECT_NEAR(reflected(0, 1 / 1.5), 0.04, 1e-15);
  EXPECT_NEAR(reflected(0, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(reflected(0, 1 / 2.0), 1.0 / 9, 1e-15);
  // At Brewster's angle one polarisation is not reflected: half of ((1 - n^2) / (1 + n^2))^2 is
  // left.
  const double n = 1.5, brewster = std::atan(n);
  EXPECT_NEAR(reflected(brewster, 1 / n), 0.5 * std::pow((1 - n * n) / (1 + n * n), 2), 1e-15);
  // At grazing incidence everything is reflected.
  EXPECT_NEAR(reflected(90 * degree, 1 / 1.5), 1, 1e-12);
  // With equal indices nothing is reflected.
  EXPECT_NEAR(reflected(30 * degree, 1), 0, 1e-15);
  // The same both ways along one path (Stokes).
  for (double angle = 1 * degree; angle < 89 * degree; angle += degree) {
    const double beyond = std::asin(std::sin(angle) / 1.5);
    EXPECT_NEAR(reflected(angle, 1 / 1.5), reflected(beyond, 1.5), 1e-12);
  }
}

TEST(Scatter, SharesTheLightOfADielectric) {
  const FlatMaterial glass = flatten(Glass{{0.5f, 1, 1}, 1.5f}, {});
  const Scatter entering = scatter(glass, seen_at(0));
  EXPECT_FLOAT_EQ(entering.reflection.r, 0.04f);
  EXPECT_FLOAT_EQ(entering.refraction.g, 0.96f);
  EXPECT_FLOAT_EQ(entering.refraction.r, 0.48f);
  EXPECT_EQ(entering.refracted, (Vec3d{0, -1, 0}));
  const Scatter leaving = scatter(glass, seen_at(30 * degree, true));
  EXPECT_NEAR(leaving.refracted.x, 0.75, 1e-12);  // 1.5 sin 30
  const Scatter total = scatter(glass, seen_at(60 * degree, true));
  EXPECT_EQ(total.reflection, gray(1));
  EXPECT_TRUE(is_black(total.refraction));
}

TEST(Scatter, TotalReflectionAddsTransmissionToReflection) {
  const FlatMaterial phong = flatten(Phong{gray(1), 0, 1, 0.25f, 0, 0.5f, 1.5f}, {});
  const Scatter entering = scatter(phong, seen_at(60 * degree));
  EXPECT_EQ(entering.reflection, gray(0.25f));
  EXPECT_EQ(entering.refraction, gray(0.5f));
  EXPECT_NEAR(entering.refracted.x, std::sin(60 * degree) / 1.5, 1e-15);
  const Scatter total = scatter(phong, seen_at(60 * degree, true));
  EXPECT_EQ(total.reflection, gray(0.75f));
  EXPECT_TRUE(is_black(total.refraction));
}

TEST(Scatter, MetalReflectsAndMatteAbsorbs) {
  EXPECT_EQ(scatter(flatten(Metal{{0.5f, 0.25f, 1}}, {}), seen_at(1)).reflection,
            (Color{0.5f, 0.25f, 1}));
  const Scatter none = scatter(flatten(Matte{}, {}), seen_at(1));
  EXPECT_TRUE(is_black(none.reflection) && is_black(none.refraction));
}

/// Light from the unit direction `to_light`.
Color direct_light_on(const Surface& surface, const FlatMaterial& material, const Vec3d& to_light,
                      const Color& intensity) {
  return direct_light(material, dot(surface.normal, to_light), to_light, surface.mirrored,
                      intensity);
}

TEST(DirectLight, IsPhongsFormula) {
  const FlatMaterial m = flatten(Phong{{0.5f, 1, 0}, 0, 0.5f, 0.25f, 4, 0, 1}, {});
  const Surface surface = seen_at(45 * degree);
  const Vec3d l{0, 1, 0};  // n.l = 1, r.l = cos 45, (r.l)^4 = 1/4
  const Color c = direct_light_on(surface, m, l, {1, 2, 4});
  EXPECT_FLOAT_EQ(c.r, 0.25f + 0.0625f);
  EXPECT_FLOAT_EQ(c.g, 1.0f + 0.125f);
  EXPECT_FLOAT_EQ(c.b, 0.25f);
}

TEST(DirectLight, TakesAnyExponent) {
  for (const float exponent : {0.5f, 1.0f, 2.0f, 3.08f, 50.0f, 1023.0f, 1024.0f, 1025.0f, 5e6f}) {
    const FlatMaterial m = flatten(Phong{gray(0), 0, 0, 1, exponent, 0, 1}, {});
    for (const double angle : {0.0, 0.001, 0.2, 1.0, 1.5}) {
      const double expected = std::pow(std::cos(angle), static_cast<double>(exponent));
      EXPECT_NEAR(direct_light_on(seen_at(angle), m, up, gray(1)).r, expected,
                  1e-7 * expected + 1e-40);
    }
  }
}

TEST(DirectLight, AGreatExponentDoesNotOverflow) {
  const FlatMaterial m = flatten(Phong{gray(0), 0, 0, 1, 3e38f, 0, 1}, {});
  Surface surface = seen_at(0);
  surface.mirrored = {0, 1 + 0x1p-52, 0};
  EXPECT_EQ(direct_light_on(surface, m, up, gray(1)), gray(1));
}

TEST(Lights, HaveTheirTargetAndFalloff) {
  const Vec3d point{0, 2, 0};
  const PointLight plain{{0, 4, 0}, {1, 2, 3}, Falloff::none};
  const ShadowTarget near = shadow_target(plain);
  EXPECT_FALSE(near.directional);
  EXPECT_EQ((Vec3d{near.target[0], near.target[1], near.target[2]}), (Vec3d{0, 4, 0}));
  EXPECT_EQ(intensity_at(plain, point), (Color{1, 2, 3}));
  const PointLight weak{{0, 4, 0}, {1, 2, 3}, Falloff::inverse_square};
  EXPECT_EQ(intensity_at(weak, point), (Color{0.25f, 0.5f, 0.75f}));
  const DirectionalLight sun{{0, -7, 0}, {1, 2, 3}};
  const ShadowTarget far = shadow_target(sun);
  EXPECT_TRUE(far.directional);
  EXPECT_EQ((Vec3d{far.target[0], far.target[1], far.target[2]}), up);
  EXPECT_EQ((Vec3f{far.dir[0], far.dir[1], far.dir[2]}), (Vec3f{0, 7, 0}));
  EXPECT_EQ(intensity_at(sun, point), (Color{1, 2, 3}));
  EXPECT_EQ(shadow_coherence(sun), Coherence::common_direction);
}

TEST(Lights, SphereLightsEqualPointLightsInWhitted) {
  const SphereLight light{{0, 4, 0}, 0.5f, {8, 16, 24}};
  const ShadowTarget at = shadow_target(light);
  EXPECT_EQ((Vec3d{at.target[0], at.target[1], at.target[2]}), (Vec3d{0, 4, 0}));
  // radiance (radius / distance)^2
  EXPECT_EQ(intensity_at(light, {0, 2, 0}), (Color{0.5f, 1, 1.5f}));
  EXPECT_EQ(shadow_coherence(light), Coherence::common_end);
}

TEST(Background, IsConstantOrAGradientAlongUp) {
  EXPECT_EQ(background_radiance(ConstantBackground{{1, 2, 3}}, {0, 1, 0}), (Color{1, 2, 3}));
  const GradientBackground sky{{0, 0, 4}, {2, 0, 0}, {0, 5, 0}};
  EXPECT_EQ(background_radiance(sky, {0, 9, 0}), (Color{2, 0, 0}));
  EXPECT_EQ(background_radiance(sky, {0, -0.1f, 0}), (Color{0, 0, 4}));
  EXPECT_EQ(background_radiance(sky, {3, 0, 4}), (Color{1, 0, 2}));
  CaseRandom random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3f tilted = vec_cast<float>(random.direction());
    const Color c = background_radiance(GradientBackground{{}, {1, 1, 1}, tilted}, -tilted);
    EXPECT_TRUE(c.r >= 0 && c.r <= 1);
  }
}

}  // namespace
}  // namespace boule::test::shading
