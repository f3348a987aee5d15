#include "bench/bench_data.h"

#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "core/math/random.h"
#include "core/scene/camera.h"
#include "simd/build/camera_builder.h"
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
    const auto at = random4(static_cast<std::uint32_t>(i), 0, 0, 0, 7);
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
    const auto at = random4(static_cast<std::uint32_t>(i), 0, 0, 0, 8);
    const auto normal = random4(static_cast<std::uint32_t>(i), 1, 0, 0, 8);
    planes.push_back(
        {{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])},
         {static_cast<float>(normal[0] - 0.5), static_cast<float>(normal[1] - 0.5),
          static_cast<float>(normal[2] - 0.5)},
         0});
  }
  return planes;
}

/// Pixels in Morton order, x first, so that each packet is a block of the picture.
void make_rays(RayBuffer& rays) {
  SampleBuffer samples;
  samples.resize(side * side);
  for (unsigned i = 0; i < side * side; ++i) {
    unsigned x = 0, y = 0;
    for (unsigned bit = 0; bit < 5; ++bit) {
      x |= ((i >> (2 * bit)) & 1U) << bit;
      y |= ((i >> (2 * bit + 1)) & 1U) << bit;
    }
    samples.set(i, x + 0.5, y + 0.5);
  }
  PinholeCamera camera;
  camera.pose = {{0.5F, 0.5F, -1.2F}, {0.5F, 0.5F, 0.5F}, {0, 1, 0}};
  camera.fov = 25.61F;
  rays.resize(side * side);
  reference_kernels().primary_rays(build_camera(camera, side, side), samples.view(), rays.view());
}

void make_book(BenchData& data) {
  const std::size_t n = data.spheres.size(), rays = data.rays.size();
  for (AlignedArray<float>* array : {&data.center_x, &data.center_y, &data.center_z})
    array->resize(n);
  data.radius.resize(n, std::numeric_limits<float>::quiet_NaN());  // padding: missed
  for (std::size_t i = 0; i < n; ++i) {
    data.center_x[i] = data.spheres[i].center.x;
    data.center_y[i] = data.spheres[i].center.y;
    data.center_z[i] = data.spheres[i].center.z;
    data.radius[i] = data.spheres[i].radius;
  }
  const RayStream view = data.rays.view();
  for (AlignedArray<float>* array : {&data.org_x, &data.org_y, &data.org_z, &data.t})
    array->resize(rays);
  for (std::size_t i = 0; i < rays; ++i) {
    data.org_x[i] = static_cast<float>(view.org_x[i]);
    data.org_y[i] = static_cast<float>(view.org_y[i]);
    data.org_z[i] = static_cast<float>(view.org_z[i]);
  }
  data.book = {data.center_x.data(),
               data.center_y.data(),
               data.center_z.data(),
               data.radius.data(),
               n,
               data.org_x.data(),
               data.org_y.data(),
               data.org_z.data(),
               view.dir_x,
               view.dir_y,
               view.dir_z,
               rays,
               data.t.data()};
}

std::unique_ptr<BenchData> make(const std::string& kind, std::size_t n) {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  if (kind == "planes") {
    planes = random_planes(n);
  } else {
    spheres = random_spheres(kind, n);
  }
  auto data = std::make_unique<BenchData>(BenchData{spheres,
                                                    planes,
                                                    Geometry(spheres, planes, Structure::scan),
                                                    {},
                                                    {},
                                                    {},
                                                    {},
                                                    {},
                                                    {},
                                                    {},
                                                    {},
                                                    {},
                                                    {},
                                                    {}});
  make_rays(data->rays);
  data->hits.resize(data->rays.size());
  make_book(*data);
  return data;
}

}  // namespace

BenchData& bench_data(const std::string& kind, std::size_t n) {
  static std::map<std::pair<std::string, std::size_t>, std::unique_ptr<BenchData>> made;
  auto& data = made[{kind, n}];
  if (!data) data = make(kind, n);
  return *data;
}

}  // namespace boule::bench
