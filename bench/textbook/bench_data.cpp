#include "bench/textbook/bench_data.h"

#include <cmath>
#include <map>
#include <memory>

#include "bench/scenes/camera_rays.h"
#include "bench/scenes/random4.h"
#include "core/optics/camera_builder.h"
#include "core/scene/camera.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

constexpr int side = 32;  // pixels: 1024 rays

std::vector<Sphere> random_spheres(const std::string& kind, std::size_t n) {
  const double cover = kind == "sparse" ? 1e-4 * static_cast<double>(n) : 4;
  const double radius =
      kind == "every" ? 5.0 : std::sqrt(cover / (3.141592653589793 * static_cast<double>(n)));
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = random4(static_cast<std::uint32_t>(i), 0, 7);
    spheres.push_back(
        {{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])},
         static_cast<float>(radius),
         0});
  }
  return spheres;
}

std::vector<Plane> random_planes(std::size_t n) {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = random4(static_cast<std::uint32_t>(i), 0, 8);
    const auto normal = random4(static_cast<std::uint32_t>(i), 1, 8);
    planes.push_back(
        {{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])},
         {static_cast<float>(normal[0] - 0.5), static_cast<float>(normal[1] - 0.5),
          static_cast<float>(normal[2] - 0.5)},
         0});
  }
  return planes;
}

RayBuffer camera_rays() {
  SampleBuffer samples = pixel_centers(side);
  PinholeCamera camera;
  camera.pose = {{0.5F, 0.5F, -1.2F}, {0.5F, 0.5F, 0.5F}, {0, 1, 0}};
  camera.fov = 25.61F;
  RayBuffer rays(side * side);
  reference_kernels().primary_rays(build_camera(camera, side, side), samples.view(), rays.view());
  return rays;
}

}  // namespace

BenchData::BenchData(const std::string& kind, std::size_t n)
    : spheres(kind == "planes" ? std::vector<Sphere>{} : random_spheres(kind, n)),
      planes(kind == "planes" ? random_planes(n) : std::vector<Plane>{}),
      geometry(spheres, planes, Structure::scan),
      rays(camera_rays()),
      hits(rays.size()),
      book(spheres.size(), rays.size()) {
  for (std::size_t i = 0; i < spheres.size(); ++i) book.set(i, spheres[i]);
  for (std::size_t i = 0; i < rays.size(); ++i) book.set(i, rays.get(i));
}

BenchData& bench_data(const std::string& kind, std::size_t n) {
  static std::map<std::pair<std::string, std::size_t>, std::unique_ptr<BenchData>> made;
  auto& data = made[{kind, n}];
  if (!data) data = std::make_unique<BenchData>(kind, n);
  return *data;
}

}  // namespace boule::bench
