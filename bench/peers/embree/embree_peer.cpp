#include "bench/peers/embree/embree_peer.h"

#include <cmath>
#include <utility>

#include "bench/peers/embree/embree_contender.h"
#include "simd/dispatch/cpu.h"

namespace boule::bench {
namespace {

/// The box of a PackedSphere, a little larger: its radius comes from a rounded square.
void bounds(const RTCBoundsFunctionArguments* args) {
  const PackedSphere& s = static_cast<const PackedSphere*>(args->geometryUserPtr)[args->primID];
  const float r = std::sqrt(s.radius_squared) * (1 + 0x1p-21F);
  *args->bounds_o = {s.x - r, s.y - r, s.z - r, 0, s.x + r, s.y + r, s.z + r, 0};
}

/// A vertex of Embree's spheres and curves.
struct Ball {
  float x, y, z, radius;
};
Ball* new_vertices(RTCGeometry geometry, std::size_t count) {
  return static_cast<Ball*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                    RTC_FORMAT_FLOAT4, sizeof(Ball), count));
}

struct Mode {
  const char* name;
  EmbreeCall call;
  std::size_t width;
};
constexpr Mode modes[] = {{"1", EmbreeCall::rays1, 1},
                          {"4", EmbreeCall::rays4, 4},
                          {"8", EmbreeCall::rays8, 8},
                          {"16", EmbreeCall::rays16, 16},
                          {"1M", EmbreeCall::stream, embree_stream_size}};

/// The hint about coherence that Embree gets.
struct Flag {
  const char* suffix;
  EmbreeHint hint;
};

/// Which of the two is better depends on the scene.
std::vector<Flag> flags_for(RayKind kind) {
  const Flag coherent = {"", embree_coherent};
  const Flag incoherent = {"", embree_incoherent};
  switch (kind) {
    case RayKind::primary:
    case RayKind::orthographic:
      return {coherent};
    case RayKind::shadow:
    case RayKind::mirror:
    case RayKind::light:
    case RayKind::ambient:
      return {coherent, {"-incoherent", incoherent.hint}};
    case RayKind::diffuse:
    case RayKind::chord:
      return {incoherent};
  }
  return {};
}

}  // namespace

EmbreePeer::EmbreePeer(const BenchScene& scene, Isa isa)
    : scene_(scene),
      device_(rtcNewDevice(isa == Isa::avx512 ? "frequency_level=simd512" : "isa=avx2")),
      isa_(isa),
      callbacks_(isa == Isa::avx512 ? avx512::embree_callbacks : avx2::embree_callbacks),
      packed_(scene.spheres.size()) {
  builtin_ = build(builtin_geometry());
  user_ = build(user_geometry());
}

EmbreePeer::~EmbreePeer() {
  rtcReleaseScene(user_);
  rtcReleaseScene(builtin_);
  rtcReleaseDevice(device_);
}

/// The spheres are geometry 0, and the capsules 1.
RTCScene EmbreePeer::build(RTCGeometry spheres) const {
  const RTCScene scene = rtcNewScene(device_);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  const auto attach = [scene](RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  };
  attach(spheres);
  if (!scene_.capsules.empty()) attach(curves());
  rtcCommitScene(scene);
  return scene;
}

RTCGeometry EmbreePeer::builtin_geometry() const {
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  Ball* next = new_vertices(geometry, scene_.spheres.size());
  for (const Sphere& s : scene_.spheres) *next++ = {s.center.x, s.center.y, s.center.z, s.radius};
  return geometry;
}

/// One segment for each capsule, without neighbours: both of its ends are round.
RTCGeometry EmbreePeer::curves() const {
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  const std::size_t size = scene_.capsules.size();
  Ball* next = new_vertices(geometry, 2 * size);
  for (const Capsule& c : scene_.capsules) {
    for (const Vec3f& end : {c.a, c.b}) *next++ = {end.x, end.y, end.z, c.radius};
  }
  auto* const first = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), size));
  for (unsigned i = 0; i < size; ++i) first[i] = 2 * i;
  return geometry;
}

RTCGeometry EmbreePeer::user_geometry() {
  for (std::size_t i = 0; i < scene_.spheres.size(); ++i) {
    const Sphere& s = scene_.spheres[i];
    packed_[i] = {s.center.x, s.center.y, s.center.z, s.radius * s.radius};
  }
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene_.spheres.size()));
  rtcSetGeometryUserData(geometry, packed_.data());
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, callbacks_.intersect);
  rtcSetGeometryOccludedFunction(geometry, callbacks_.occluded);
  return geometry;
}

std::vector<std::unique_ptr<Contender>> EmbreePeer::contenders(const Workload& workload) {
  std::vector<std::unique_ptr<Contender>> all;
  const auto add = [&](const char* geometry, RTCScene scene, const Mode& mode, const Flag& flag) {
    if (mode.call == EmbreeCall::stream && !embree_has_streams) return;
    const bool limited = isa_ == Isa::avx2;
    const std::string name = std::string(limited ? "embree-avx2-" : "embree-") + geometry + "-" +
                             mode.name + flag.suffix;
    Contender::Info info = {name, limited ? "avx2" : "avx512", mode.width, "float", true, false};
    all.push_back(std::make_unique<EmbreeContender>(std::move(info), workload, scene, mode.call,
                                                    flag.hint, rays_));
  };
  for (const Flag& flag : flags_for(workload.kind)) {
    for (const Mode& mode : modes) add("builtin", builtin_, mode, flag);
    for (const Mode& mode : modes) add("user", user_, mode, flag);
  }
  return all;
}

std::string embree_version() { return RTC_VERSION_STRING; }

}  // namespace boule::bench
