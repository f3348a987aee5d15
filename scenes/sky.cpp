/// Writes a picture of a clear sky with the sun for [background] type = "environment":
/// latitude-longitude, radiance, the sun in the middle across.
///
///   boule_sky ELEVATION HEIGHT FILE.exr
///
/// ELEVATION, 1 to 89: degrees of the sun above the horizon. HEIGHT, 16 to 1024: pixels; the width
/// is twice that. The sun's disc has a radius of 9 degrees, as through haze, so that small
/// pictures can show it, and gives about as much light as the sky. Only arithmetic of our own: the
/// numbers are the same on every machine.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/math/geometry.h"
#include "core/math/warp.h"
#include "render/image/write_image.h"

namespace {

using namespace boule;

constexpr double sun_turns = 9.0 / 360;
constexpr Color zenith{0.13f, 0.28f, 0.62f}, horizon{0.80f, 0.88f, 0.95f};
constexpr Color ground{0.20f, 0.18f, 0.16f}, haze{1.6f, 1.3f, 0.9f}, sun{32, 28, 22};

/// The whole of a text as a number from `low` to `high`.
bool parse(std::string_view text, int low, int high, int& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size() && out >= low && out <= high;
}

/// cosine^16: a wide, soft glow; 0 on the far side.
double glow(double cosine) {
  double power = std::max(cosine, 0.0);
  for (int i = 0; i < 4; ++i) power *= power;
  return power;
}

/// Fewer digits, for a smaller file.
float rounded(float x) {
  const float large = x * 4097;  // Veltkamp's splitting: 12 bits remain
  return large - (large - x);
}

/// Radiance from a direction of unit length.
Color radiance(const Vec3d& direction, const Vec3d& to_sun) {
  const double cosine = dot(direction, to_sun);
  if (cosine > full_turns(sun_turns).cosine) return sun;
  const double low = 1 - std::fabs(direction.y);  // 1 at the horizon
  const auto pale = static_cast<float>(low * low * low), hazy = static_cast<float>(glow(cosine));
  return (direction.y < 0 ? ground : zenith) * (1 - pale) + horizon * pale + haze * hazy;
}

/// The mean over a pixel, by a grid of samples.
Color pixel(int x, int y, int width, int height, const Vec3d& to_sun) {
  constexpr int grid = 8;
  Color sum;
  for (int i = 0; i < grid * grid; ++i) {
    const double u = (x + (i % grid + 0.5) / grid) / width;
    const double v = (y + (i / grid + 0.5) / grid) / height;
    const Angle polar = full_turns(v / 2), around = full_turns(u);  // from +z, to the left
    const Vec3d direction{-polar.sine * around.sine, polar.cosine, polar.sine * around.cosine};
    sum = sum + radiance(direction, to_sun) * (1.0f / (grid * grid));
  }
  return {rounded(sum.r), rounded(sum.g), rounded(sum.b)};
}

Image sky(int elevation, int height) {
  const Angle up = full_turns(elevation / 360.0);
  const Vec3d to_sun{0, up.sine, -up.cosine};
  Image image(2 * height, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y) = pixel(x, y, image.width, height, to_sun);
    }
  }
  return image;
}

}  // namespace

int main(int argc, char** argv) {
  int elevation = 0, height = 0;
  if (argc != 4 || !parse(argv[1], 1, 89, elevation) || !parse(argv[2], 16, 1024, height)) {
    std::fputs("usage: boule_sky ELEVATION HEIGHT FILE.exr    (ELEVATION 1 to 89)\n", stderr);
    return 2;
  }
  if (const Status done = write_image(sky(elevation, height), argv[3]); !done) {
    std::fprintf(stderr, "%s\n", format_diagnostic(done.error()).c_str());
    return 1;
  }
  return 0;
}
