#include "bench/errors/lit_scene.h"

#include <variant>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "core/reference.h"
#include "simd/dispatch/dispatch.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {
namespace {

const KernelTable& kernels() { return *select_kernels("auto").value(); }

bool faces_light(const SeenPoint& point) { return point.hit && point.cosine > 0; }

}  // namespace

LitScene::LitScene(const Scene& scene)
    : scene_(scene),
      light_(std::get<PointLight>(scene.lights.front()).position),
      geometry_(scene.spheres, scene.planes),
      truth_(scene) {}

std::vector<SeenPoint> LitScene::see(const std::vector<std::pair<double, double>>& raster,
                                     int width, int height) const {
  const CameraView camera = build_camera(*scene_.camera, width, height);
  RayBuffer rays(raster.size());
  HitBuffer hits(raster.size());
  for (std::size_t i = 0; i < raster.size(); ++i)
    rays.set(i, primary_ray(camera, raster[i].first, raster[i].second));
  kernels().closest_hit(geometry_.view(), rays.view(), {}, hits.view());
  std::vector<SeenPoint> points;
  for (std::size_t i = 0; i < raster.size(); ++i)
    points.push_back(find_point(rays.get(i), hits.get(i)));
  return points;
}

SeenPoint LitScene::find_point(const Ray& ray, const Hit& hit) const {
  const test::LongHit true_hit = truth_.closest_hit(ray);
  SeenPoint point;
  point.hit = hit.id != no_primitive;
  point.right_hit = hit.id == true_hit.id;
  if (!point.hit) return point;
  point.surface = find_surface(scene_.spheres, scene_.planes, ray, hit);
  point.rounded = {float_point(ray, hit), vec_cast<float>(point.surface.normal)};
  const Vec3d to_light = normalize(vec_cast<double>(light_) - point.surface.point);
  point.cosine = dot(point.surface.normal, to_light);
  if (point.right_hit) point.truth = truth_.lit(true_hit, light_);
  return point;
}

std::vector<std::uint8_t> LitScene::lit(const std::vector<SeenPoint>& points,
                                        const FloatRemedy& remedy) const {
  std::vector<std::uint8_t> lit;
  for (const SeenPoint& point : points) {
    const bool dark = !faces_light(point) || is_shadowed(remedy, scene_, point.rounded, light_);
    lit.push_back(dark ? 0 : 1);
  }
  return lit;
}

std::vector<std::uint8_t> LitScene::lit(const std::vector<SeenPoint>& points) const {
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (faces_light(points[i])) asked.push_back(i);
  }
  RayBuffer rays(asked.size());
  for (std::size_t k = 0; k < asked.size(); ++k)
    rays.set(k, shadow_ray_to(points[asked[k]].surface, vec_cast<double>(light_)));
  AlignedArray<std::uint8_t> occluded(asked.size(), 0);
  kernels().any_hit(geometry_.view(), rays.view(), {}, occluded.data());
  std::vector<std::uint8_t> lit(points.size(), 0);
  for (std::size_t k = 0; k < asked.size(); ++k) lit[asked[k]] = occluded.data()[k] == 0 ? 1 : 0;
  return lit;
}

}  // namespace boule::bench
