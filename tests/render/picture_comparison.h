#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "core/reference.h"
#include "render/renderer/renderer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/support/whitted_oracle.h"

namespace boule::test {

/// The picture of a scene. If there is none, the test fails and the picture is empty.
inline Image render(const Scene& scene, const RenderOptions& options) {
  auto renderer = Renderer::create(scene, options);
  if (!renderer) {
    ADD_FAILURE() << format_diagnostic(renderer.error());
    return {};
  }
  auto image = renderer.value().render();
  if (!image) {
    ADD_FAILURE() << format_diagnostic(image.error());
    return {};
  }
  return image.value();
}
inline Image render(const Scene& scene) { return render(scene, options_of(scene)); }

inline bool same_bits(const Color& a, const Color& b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return bits(a.r) == bits(b.r) && bits(a.g) == bits(b.g) && bits(a.b) == bits(b.b);
}

/// Pixels that differ in any bit; -1 if the sizes differ or there are none.
inline int differing_pixels(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.pixels.empty()) return -1;
  int count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    count += same_bits(a.pixels[i], b.pixels[i]) ? 0 : 1;
  return count;
}

/// A crop has the bits of the picture where it was cut out: from column x and row y on.
inline void expect_crop_of(const Image& picture, const Image& crop, int x, int y) {
  for (int v = 0; v < crop.height; ++v) {
    for (int u = 0; u < crop.width; ++u)
      ASSERT_TRUE(same_bits(crop.at(u, v), picture.at(u + x, v + y))) << u << ' ' << v;
  }
}

/// The picture has the bits of the reference path, by scalar code and by the machine's widest.
inline void expect_reference_picture(const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.solver = Solver::reference;
  const Image expected = render(scene, options);
  options.solver = Solver::robust;
  for (const char* const isa : {"scalar", "auto"}) {
    options.isa = isa;
    options.threads = 3;
    options.tile = 7;
    EXPECT_EQ(differing_pixels(render(scene, options), expected), 0) << isa;
  }
}

/// Every instruction set makes this picture, alpha included, by other threads and tiles.
inline void expect_picture_of_all_isas(const Scene& scene, const Image& picture) {
  RenderOptions options = options_of(scene);
  for (const IsaInfo& isa : list_isas()) {
    if (!isa.supported) continue;
    options.isa = isa.name;
    options.threads = 3;
    options.tile = 4;
    const Image other = render(scene, options);
    EXPECT_EQ(differing_pixels(picture, other), 0) << isa.name;
    EXPECT_EQ(picture.alpha, other.alpha) << isa.name;
  }
}

/// The oracle's colour of the centre of pixel (x, y).
inline Rgb oracle_pixel(const Scene& scene, int x, int y) {
  const CameraView view = build_camera(*scene.camera, scene.image.width, scene.image.height);
  const Ray ray = primary_ray(view, x + 0.5, y + 0.5);
  return WhittedOracle(scene).trace(ray, scene.render.max_depth);
}

/// |a - b| relative to b's largest component (or 1e-3), the largest over the components.
inline double distance(const Color& a, const Rgb& b) {
  const double scale = std::max({std::fabs(b.r), std::fabs(b.g), std::fabs(b.b), 1e-3});
  return std::max({std::fabs(static_cast<double>(a.r) - b.r),
                   std::fabs(static_cast<double>(a.g) - b.g),
                   std::fabs(static_cast<double>(a.b) - b.b)}) /
         scale;
}

/// The largest difference between a picture of the scene with one sample per pixel and the
/// oracle's.
inline double distance_to_oracle(const Scene& scene, const Image& image) {
  if (image.width != scene.image.width || image.height != scene.image.height) return HUGE_VAL;
  double largest = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double d = distance(image.at(x, y), oracle_pixel(scene, x, y));
      if (!(d <= largest)) largest = d;
    }
  }
  return largest;
}

}  // namespace boule::test
