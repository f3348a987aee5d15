#include "render/prepare/outlying_spheres.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "render/prepare/projection.h"
#include "render/prepare/view_notes.h"

namespace boule {
namespace {

/// A float as a number in whose order the floats are.
std::uint32_t order_of(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000U;
}
float float_of(std::uint32_t order) {
  return std::bit_cast<float>((order >> 31) != 0 ? order & 0x7fffffffU : ~order);
}

/// The number that would be at `rank` if those of all spheres were in order: it is found by its
/// digits, the first ones first, without a copy of the numbers.
template <class Number>
float at_rank(const std::vector<Sphere>& spheres, std::uint64_t rank, const Number& number) {
  constexpr int digit = 11;
  std::uint32_t known = 0, mask = 0;
  for (int shift = 22;; shift = std::max(shift - digit, 0)) {
    std::array<std::uint64_t, std::size_t{1} << digit> counts{};
    const std::uint32_t open = ~mask >> shift;
    for (const Sphere& sphere : spheres) {
      const std::uint32_t order = order_of(number(sphere));
      if ((order & mask) == known) ++counts[(order >> shift) & open & (counts.size() - 1)];
    }
    std::uint32_t value = 0;
    while (rank >= counts[value]) rank -= counts[value++];
    known |= value << shift;
    if (shift == 0) return float_of(known);
    mask = ~std::uint32_t{0} << shift;
  }
}

float distance_between(const Vec3f& a, const Vec3f& b) {
  return static_cast<float>(length(vec_cast<double>(a) - vec_cast<double>(b)));
}

}  // namespace

std::optional<Sphere> median_sphere(const Scene& scene) {
  const std::vector<Sphere>& spheres = scene.spheres;
  if (scene.packed || !scene.instances.empty() || spheres.empty()) return std::nullopt;
  const std::uint64_t middle = (spheres.size() - 1) / 2;
  const auto median = [&](const auto& number) { return at_rank(spheres, middle, number); };
  return Sphere{{median([](const Sphere& s) { return s.center.x; }),
                 median([](const Sphere& s) { return s.center.y; }),
                 median([](const Sphere& s) { return s.center.z; })},
                median([](const Sphere& s) { return s.radius; })};
}

bool may_be_specks(const Scene& scene, const Camera& camera, int width, int height) {
  Scene sample;
  sample.spheres = sample_spheres(scene, std::nullopt);
  const auto median = median_sphere(sample);
  return median && pixels_across(*median, camera, width, height) < 2;
}

NearOthers::NearOthers(const Scene& scene, const Sphere& median) : center_(median.center) {
  const std::vector<Sphere>& spheres = scene.spheres;
  const std::uint64_t outside = spheres.size() / 200;  // 0.5 %
  reach_ = 2 * at_rank(spheres, spheres.size() - 1 - outside,
                       [this](const Sphere& s) { return distance_between(s.center, center_); });
}

bool NearOthers::operator()(const Sphere& sphere) const {
  return distance_between(sphere.center, center_) <= reach_;
}

std::optional<Scene> without_outliers(const Scene& scene, const Sphere& median) {
  const std::vector<Sphere>& spheres = scene.spheres;
  const NearOthers is_near(scene, median);
  if (std::all_of(spheres.begin(), spheres.end(), is_near)) return std::nullopt;
  Scene rest;
  std::copy_if(spheres.begin(), spheres.end(), std::back_inserter(rest.spheres), is_near);
  rest.fit = scene.fit;
  rest.planes = scene.planes;
  rest.capsules = scene.capsules;
  return rest;
}

double pixels_across(const Sphere& sphere, const Camera& camera, int width, int height) {
  const CameraView view = build_camera(camera, width, height);
  const auto disc = Projection(view, width).of(sphere);
  return disc ? 2 * disc->radius : std::numeric_limits<double>::infinity();
}

bool is_better_without(const Sphere& median, const Camera& all, const Camera& near, int width,
                       int height) {
  const double size = pixels_across(median, all, width, height);
  return size < 1 && pixels_across(median, near, width, height) >= 2 * size;
}

}  // namespace boule
