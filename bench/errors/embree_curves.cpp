#include "bench/errors/embree_curves.h"

#ifdef BOULE_EMBREE

#include <cmath>
#include <limits>

#include "bench/peers/embree/embree_version.h"

namespace boule::bench {
namespace {

RTCDevice curve_device() {
  static const RTCDevice device = rtcNewDevice("threads=1");
  return device;
}

RTCScene scene_of(const Capsule& capsule) {
  const RTCScene scene = rtcNewScene(curve_device());
  const RTCGeometry geometry = rtcNewGeometry(curve_device(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2));
  for (const Vec3f& end : {capsule.a, capsule.b}) {
    for (const float number : {end.x, end.y, end.z, capsule.radius}) *vertex++ = number;
  }
  *static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                  RTC_FORMAT_UINT, sizeof(unsigned), 1)) = 0;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

double solve(RTCScene scene, const Ray& ray) {
  constexpr float inf = std::numeric_limits<float>::infinity(), largest = 1.844e18F;
  const Vec3f org = vec_cast<float>(ray.org);
  const bool valid =
      std::fmax(std::fmax(std::fabs(org.x), std::fabs(org.y)), std::fabs(org.z)) <= largest;
  if (!valid) return std::numeric_limits<double>::quiet_NaN();
  EmbreeContext context;
  RTCRayHit one{};
  one.ray = {org.x, org.y, org.z, 0, ray.dir.x, ray.dir.y, ray.dir.z, 0, inf, ~0U, 0, 0};
  one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  EmbreeQuery(context).intersect(scene, one);
  return one.hit.geomID == RTC_INVALID_GEOMETRY_ID ? double{inf} : double{one.ray.tfar};
}

}  // namespace

std::vector<double> embree_curve_hits(const Capsule& capsule, const std::vector<Ray>& rays) {
  const RTCScene scene = scene_of(capsule);
  std::vector<double> t;
  for (const Ray& ray : rays) t.push_back(solve(scene, ray));
  rtcReleaseScene(scene);
  return t;
}

}  // namespace boule::bench

#else

namespace boule::bench {

std::vector<double> embree_curve_hits(const Capsule& /*capsule*/,
                                      const std::vector<Ray>& /*rays*/) {
  return {};
}

}  // namespace boule::bench

#endif
