#include "render/prepare/environment_light.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/interval.h"
#include "core/math/warp.h"

namespace boule {
namespace {

/// The point of an image that shows a direction: u is 0 at the left edge, v is 0 at the top.
UnitPair image_point(const Vec3d& d, float rotation) {
  const double turns = 0.5 + elementary::atan2(d.x, -d.z) / (2 * elementary::pi) -
                       static_cast<double>(rotation) / 360;
  const double across = std::sqrt(d.x * d.x + d.z * d.z);
  const double v = elementary::atan2(across, d.y) / elementary::pi;
  const double u = turns - std::floor(turns);
  // The comparisons are false for NaN, which becomes below_one.
  return {u < below_one ? u : below_one, v < below_one ? std::max(v, 0.0) : below_one};
}

/// The interval of a running sum in which `at` lies. `at` becomes its position within the interval,
/// 0..1.
std::size_t find_interval(const double* sums, std::size_t count, double& at) {
  const auto index = static_cast<std::size_t>(std::upper_bound(sums, sums + count - 1, at) - sums);
  const double first = index == 0 ? 0 : sums[index - 1];
  at = rescale(at, {.first = first, .size = sums[index] - first});
  return index;
}

/// The light of each pixel's area. The image is bilinear there; each neighbour's share of the
/// integral over the area is 1/8 along either axis.
class PixelLight {
 public:
  explicit PixelLight(const EnvironmentBackground& image) : image_(image) {}

  double operator()(int x, int y) const {
    const int last = image_.height - 1;
    return 0.75 * in_row(x, y) +
           0.125 * (in_row(x, std::max(y - 1, 0)) + in_row(x, std::min(y + 1, last)));
  }

 private:
  double in_row(int x, int y) const {
    const int width = image_.width;
    return 0.75 * at(x, y) + 0.125 * (at((x + width - 1) % width, y) + at((x + 1) % width, y));
  }
  double at(int x, int y) const {
    return component_sum(
        image_.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                      static_cast<std::size_t>(x)]);
  }

  const EnvironmentBackground& image_;
};

}  // namespace

Color environment_radiance(const EnvironmentBackground& image, const Vec3d& direction) {
  const int width = image.width, height = image.height;
  const auto [u, v] = image_point(direction, image.rotation);
  const double x = u * width - 0.5, y = std::clamp(v * height - 0.5, 0.0, height - 1.0);
  const auto left = static_cast<int>(std::floor(x)), above = static_cast<int>(y);
  const auto across = static_cast<float>(x - left), down = static_cast<float>(y - above);
  const auto row = [&](int line) {
    const Color* const pixels =
        &image.pixels[static_cast<std::size_t>(line) * static_cast<std::size_t>(width)];
    return pixels[(left + width) % width] * (1 - across) + pixels[(left + 1) % width] * across;
  };
  return row(above) * (1 - down) + row(std::min(above + 1, height - 1)) * down;
}

EnvironmentLight::EnvironmentLight(const EnvironmentBackground& image)
    : width_(image.width), height_(image.height), rotation_(image.rotation) {
  columns_.reserve(image.pixels.size());
  double total = 0;
  const PixelLight light(image);
  for (int y = 0; y < height_; ++y) {
    const double sine = full_turns((y + 0.5) / (2.0 * height_)).sine;
    double row = 0;
    for (int x = 0; x < width_; ++x) {
      row += light(x, y) * sine;
      columns_.push_back(row);
    }
    total += row;
    rows_.push_back(total);
  }
}

EnvironmentSample EnvironmentLight::sample(const UnitPair& numbers) const {
  if (!shines()) return {};
  double v = numbers.v * rows_.back();
  const std::size_t row = find_interval(rows_.data(), rows_.size(), v);
  const auto width = static_cast<std::size_t>(width_);
  const double* const columns = &columns_[row * width];
  double u = numbers.u * columns[width - 1];
  const std::size_t column = find_interval(columns, width, u);
  const Angle from_top = full_turns((static_cast<double>(row) + v) / (2.0 * height_));
  const double turns =
      (static_cast<double>(column) + u) / width_ - 0.5 + static_cast<double>(rotation_) / 360;
  const Angle around = full_turns(turns - std::floor(turns));
  const Vec3d direction{from_top.sine * around.sine, from_top.cosine,
                        -from_top.sine * around.cosine};
  return {direction, density(direction)};
}

double EnvironmentLight::density(const Vec3d& direction) const {
  const double sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  if (!shines() || !(sine > 0)) return 0;
  const auto [u, v] = image_point(direction, rotation_);
  const auto width = static_cast<std::size_t>(width_);
  const auto column = static_cast<std::size_t>(u * width_);
  const double* const columns = &columns_[static_cast<std::size_t>(v * height_) * width];
  const double weight = columns[column] - (column == 0 ? 0 : columns[column - 1]);
  const double pixels = static_cast<double>(width_) * height_;
  return weight / rows_.back() * pixels / (2 * elementary::pi * elementary::pi * sine);
}

}  // namespace boule
