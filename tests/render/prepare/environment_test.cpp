// What an environment's image shows at its edges, which are at the poles and behind.
#include "render/prepare/environment_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace boule::test {
namespace {

/// Four pixels wide and two high: each row covers a quarter turn.
EnvironmentBackground picture() {
  EnvironmentBackground image{4, 2, {}};
  for (int i = 0; i < 8; ++i) image.pixels.push_back(gray(static_cast<float>(1 << i)));
  return image;
}

/// The direction at these angles to the right of -z and upward, in degrees.
Vec3d direction(double right, double up) {
  constexpr double degree = 3.14159265358979323846 / 180;
  return {std::cos(up * degree) * std::sin(right * degree), std::sin(up * degree),
          -std::cos(up * degree) * std::cos(right * degree)};
}

float seen(double right, double up) {
  return environment_radiance(picture(), direction(right, up)).r;
}

/// Within half a row of a pole, a direction sees the colour of the first or last row, which depends
/// on the direction.
TEST(Environment, PolesHaveTheOutermostRow) {
  const float top[] = {1, 2, 4, 8}, bottom[] = {16, 32, 64, 128};
  for (int i = 0; i < 4; ++i) {
    const double right = -135 + 90 * i;
    for (const double up : {46.0, 70.0, 89.9}) {
      EXPECT_NEAR(seen(right, up), top[i], 1e-5 * 8) << right << " " << up;
      EXPECT_NEAR(seen(right, -up), bottom[i], 1e-5 * 128) << right << " " << up;
    }
  }
}

/// The right edge continues at the left one. Halfway between the rows the colour is their mean.
TEST(Environment, HasNoSeamBehind) {
  EXPECT_NEAR(seen(180, 60), (8 + 1) / 2.0, 1e-4);
  EXPECT_NEAR(seen(-180, 60), (8 + 1) / 2.0, 1e-4);
  EXPECT_NEAR(seen(-135, 0), (1 + 16) / 2.0, 1e-4);
}

}  // namespace
}  // namespace boule::test
