#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "render/integrators/aovs.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/renderer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/long_double_tracer.h"
#include "tests/support/test_scenes.h"

namespace boule::test {

/// A picture with one sample per pixel, its AOVs and its camera rays, all by pixel.
struct CheckedPicture {
  Image image;
  std::vector<Ray> rays;
  std::vector<float> depths;
  std::vector<Vec3f> normals;
  std::vector<std::uint32_t> ids;
};

inline std::uint32_t view_id(const LongHit& hit) { return static_cast<std::uint32_t>(hit.id); }

/// Matte and white objects before black, lit by one white light without falloff: a pixel is either
/// lit or black.
inline Scene matte_scene(int width, int height) {
  Scene scene = empty_scene(width, height);
  add_material(scene, Matte{{1, 1, 1}});
  return scene;
}

inline void light_from(Scene& scene, const Vec3f& position) {
  scene.lights = {PointLight{position, {1, 1, 1}, Falloff::none}};
}

inline Vec3f light_of(const Scene& scene) {
  return std::get<PointLight>(scene.lights.front()).position;
}

/// The rays through the pixels' centres, as the kernels make them.
inline std::vector<Ray> pixel_rays(const PreparedScene& scene, const KernelTable& kernels,
                                   const ImageSettings& size) {
  SampleBuffer samples;
  const auto pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  samples.resize(pixels);
  std::size_t k = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) samples.set(k++, x + 0.5, y + 0.5);
  }
  RayBuffer rays(pixels);
  kernels.primary_rays(scene.camera_view, samples.view(), rays.view());
  std::vector<Ray> all;
  for (k = 0; k < pixels; ++k) all.push_back(rays.get(k));
  return all;
}

/// The scene format's formulas for a pinhole whose field of view spans the width, in long double.
struct LongPinhole {
  Vec3l forward, right, up;  ///< of lengths 1, half the film's width and half its height
  long double width, height;

  LongPinhole(const PinholeCamera& camera, const ImageSettings& size)
      : forward(unit(vec_cast<long double>(camera.pose.look_at) -
                     vec_cast<long double>(camera.pose.eye))),
        right(unit(cross(forward, vec_cast<long double>(camera.pose.up)))),
        up(cross(right, forward)),
        width(static_cast<long double>(size.width)),
        height(static_cast<long double>(size.height)) {
    const long double pi = std::acos(-1.0L);
    const long double half = std::tan(static_cast<long double>(camera.fov) * pi / 360);
    right = right * half;
    up = up * (half * height / width);
  }

  /// The direction, of unit length, through a point of the picture; (0, 0) is its upper left
  /// corner.
  [[nodiscard]] Vec3l direction(long double x, long double y) const {
    return unit(forward + right * ((2 * x - width) / width) + up * ((height - 2 * y) / height));
  }
};

/// The number of a pinhole's rays whose direction is not the exact one, rounded to float.
inline int strayed_rays(const Scene& scene, const std::vector<Ray>& rays) {
  const LongPinhole camera(std::get<PinholeCamera>(*scene.camera), scene.image);
  const auto differs = [](float rounded, long double exact) {
    const float next = std::nextafter(std::fabs(rounded), HUGE_VALF);
    const auto ulp = static_cast<long double>(next - std::fabs(rounded));
    return !(std::fabs(static_cast<long double>(rounded) - exact) <= 0.501L * ulp + 0x1p-50L);
  };
  int strayed = 0;
  std::size_t k = 0;
  for (int y = 0; y < scene.image.height; ++y) {
    for (int x = 0; x < scene.image.width; ++x) {
      const Vec3l exact = camera.direction(x + 0.5L, y + 0.5L);
      const Vec3f& dir = rays[k++].dir;
      strayed +=
          differs(dir.x, exact.x) || differs(dir.y, exact.y) || differs(dir.z, exact.z) ? 1 : 0;
    }
  }
  return strayed;
}

template <class T>
std::vector<T> samples_of(const std::vector<ImageChannel>& channels, const std::string& name) {
  for (const ImageChannel& channel : channels) {
    if (channel.name == name) return std::get<std::vector<T>>(channel.samples);
  }
  ADD_FAILURE() << "no channel " << name;
  return {};
}

/// Renders a scene with one ISA's kernels, picture and AOVs. Fails if a ray is not that of the
/// scene format's formulas.
inline CheckedPicture render_checked(const Scene& scene, const std::string& isa) {
  RenderOptions options = options_of(scene);
  options.isa = isa;
  options.aovs.depth = options.aovs.normal = options.aovs.id = true;
  auto renderer = Renderer::create(scene, options);
  if (!renderer) throw std::runtime_error(format_diagnostic(renderer.error()));
  CheckedPicture out;
  out.image = renderer.value().render().value();
  const auto channels = renderer.value().render_aovs().value();
  out.depths = samples_of<float>(channels, "Z");
  out.ids = samples_of<std::uint32_t>(channels, "id");
  const auto x = samples_of<float>(channels, "N.X"), y = samples_of<float>(channels, "N.Y"),
             z = samples_of<float>(channels, "N.Z");
  for (std::size_t k = 0; k < x.size(); ++k) out.normals.push_back({x[k], y[k], z[k]});
  out.rays = pixel_rays(renderer.value().scene(), *select_kernels(isa).value(), scene.image);
  if (std::holds_alternative<PinholeCamera>(*scene.camera)) {
    EXPECT_EQ(strayed_rays(scene, out.rays), 0);
  }
  return out;
}

/// What the oracle says of a picture.
struct Verdict {
  int pixels = 0, hits = 0, wrong_ids = 0;
  int lit = 0, dark = 0, unsure = 0;  ///< hits, by the oracle's answer
  int false_shadows = 0, leaks = 0;
};
inline std::ostream& operator<<(std::ostream& out, const Verdict& v) {
  return out << v.pixels << " pixels, " << v.hits << " hits, " << v.wrong_ids << " wrong ids, "
             << v.lit << " lit, " << v.dark << " dark, " << v.unsure << " unsure, "
             << v.false_shadows << " false shadows, " << v.leaks << " leaks";
}

inline void count_light(Verdict& verdict, Lit expected, bool rendered) {
  if (expected == Lit::unsure) ++verdict.unsure;
  if (expected == Lit::yes) ++(rendered ? verdict.lit : verdict.false_shadows);
  if (expected == Lit::no) ++(rendered ? verdict.leaks : verdict.dark);
}

/// Compares a picture with the oracle. expected_lit(hit) tells whether light arrives there.
template <class ExpectedLit>
Verdict judge(const Scene& scene, const CheckedPicture& picture, const ExpectedLit& expected_lit) {
  const LongDoubleTracer tracer(scene);
  Verdict verdict;
  for (std::size_t k = 0; k < picture.rays.size(); ++k) {
    const LongHit hit = tracer.closest_hit(picture.rays[k]);
    ++verdict.pixels;
    verdict.wrong_ids += view_id(hit) != picture.ids[k] ? 1 : 0;
    if (hit.id == no_primitive || view_id(hit) != picture.ids[k]) continue;
    ++verdict.hits;
    count_light(verdict, expected_lit(hit), picture.image.pixels[k].r > 0);
  }
  return verdict;
}

inline Verdict judge(const Scene& scene, const CheckedPicture& picture) {
  const LongDoubleTracer tracer(scene);
  return judge(scene, picture,
               [&](const LongHit& hit) { return tracer.lit(hit, light_of(scene)); });
}

/// Expects that no pixel is wrong, and that the oracle decides almost all pixels that show
/// something.
inline void expect_right(const Verdict& verdict) {
  EXPECT_EQ(verdict.wrong_ids, 0) << verdict;
  EXPECT_EQ(verdict.false_shadows, 0) << verdict;
  EXPECT_EQ(verdict.leaks, 0) << verdict;
  EXPECT_LT(verdict.unsure * 100, verdict.hits) << verdict;
}

}  // namespace boule::test
