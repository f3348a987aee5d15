#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "render/prepare/prepared_scene.h"
#include "simd/stream/path_buffers.h"
#include "tests/support/case_random.h"
#include "tests/support/test_scenes.h"

/// Rays as the shading kernels write them, and a scene of all materials for them.
namespace boule::test {

inline const Material materials[] = {Matte{{0.2f, 0.5f, 0.8f}},
                                     Matte{{0, 0, 1e-20f}},
                                     Plastic{{0.1f, 0.3f, 0.5f}, 0.3f, 12, 0.1f},
                                     Plastic{{0.8f, 0.8f, 0.8f}, 0.6f, 3.25f, 0},
                                     Plastic{{0.4f, 0.4f, 0.4f}, 0, 0, 0.2f},
                                     Phong{{0, 0, 0}, 0, 0, 0.9f, 5000, 0, 1},
                                     Metal{{0.9f, 0.5f, 0.1f}},
                                     Glass{{0.9f, 1, 0.9f}, 1.5f},
                                     Phong{{0.5f, 0.4f, 0.3f}, 0, 0.6f, 0.2f, 8, 0.3f, 1.3f},
                                     Phong{{0, 0, 0}, 0, 0, 0.2f, 0, 0.7f, 1.2f},
                                     Matte{{0, 0, 0}}};

/// Spheres and planes of all these materials.
inline PreparedScene scene_of_all(CaseRandom& random, Method method) {
  Scene scene = empty_scene(4, 4);
  std::vector<MaterialRef> refs;
  for (const Material& material : materials) refs.push_back(add_material(scene, material));
  for (std::size_t i = 0; i < 120; ++i) {
    const Vec3f center = vec_cast<float>(random.direction() * random.uniform(2, 9));
    scene.spheres.push_back(
        {center, static_cast<float>(random.uniform(0.2, 1.5)), refs[i % refs.size()]});
  }
  scene.planes = {{{0, -9, 0}, {0, 1, 0}, refs[2]}, {{9, 0, 0}, {-2, 1, 0}, refs[7]}};
  scene.render.method = method;
  return prepare(scene, 4, 4, serial_for, method).value();
}

/// A ray and what else is known of it, as the kernels write it.
struct Written {
  Ray ray;
  std::uint32_t index = 0;  ///< of the ray that a shadow ray belongs to; of a sample
  Color color;              ///< the light, or the throughput
  float density = 0;
};

inline void expect_same_color(const Color& a, const Color& b) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(a.r), std::bit_cast<std::uint32_t>(b.r));
  EXPECT_EQ(std::bit_cast<std::uint32_t>(a.g), std::bit_cast<std::uint32_t>(b.g));
  EXPECT_EQ(std::bit_cast<std::uint32_t>(a.b), std::bit_cast<std::uint32_t>(b.b));
}

inline void expect_same_rays(const std::vector<Written>& written,
                             const std::vector<Written>& expected) {
  ASSERT_EQ(written.size(), expected.size());
  for (std::size_t k = 0; k < written.size() && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const auto& [ray, index, color, density] = written[k];
    const Written& other = expected[k];
    EXPECT_EQ(ray.org, other.ray.org);
    EXPECT_EQ(ray.dir, other.ray.dir);
    EXPECT_EQ(ray.tmin, other.ray.tmin);
    EXPECT_EQ(ray.tmax, other.ray.tmax);
    EXPECT_EQ(ray.source, other.ray.source);
    EXPECT_EQ(ray.inside, other.ray.inside);
    EXPECT_EQ(index, other.index);
    expect_same_color(color, other.color);
    EXPECT_EQ(density, other.density);
  }
}

inline std::vector<Written> written(const RayStream& from, std::size_t size,
                                    const std::uint32_t* index, const ColorStream& color,
                                    const float* densities) {
  std::vector<Written> all;
  for (std::size_t k = 0; k < size; ++k)
    all.push_back({get_ray(from, k),
                   index[k],
                   {color.r[k], color.g[k], color.b[k]},
                   densities == nullptr ? 0 : densities[k]});
  return all;
}

}  // namespace boule::test
