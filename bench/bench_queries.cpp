// One ray a call: nanoseconds of Tracer::closest(const Ray&) and Tracer::any(const Ray&) beside
// Embree's rtcIntersect1 and rtcOccluded1 on its built-in spheres, interleaved in one run: the
// least thread CPU time of all repetitions.
//
//   bench_queries [scene...]
//
// The rays are chords from one random point of the sphere around a scene to another, so that no ray
// has anything in common with the one before it. Embree answers in float, without a normal of the
// surface that the ray meets where it leaves the sphere; how many of its answers are others is
// printed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/peers/embree/embree_version.h"
#include "bench/scenes/bench_scenes.h"
#include "bench/scenes/ray_kinds.h"
#include "bench/tools/thread_seconds.h"
#include "core/math/geometry.h"
#include "render/renderer/tracer.h"

namespace boule::bench {
namespace {

constexpr int side = 256;  // as many rays as pixels
constexpr int repetitions = 11;

/// The crossings of rays, collected from Embree.
struct EmbreeCrossings {
  struct Crossing {
    float t;
    unsigned id;
    bool entering;
  };
  std::vector<std::size_t> offset{0};
  std::vector<Crossing> all;
};

/// The context of a ray that collects.
struct CollectingContext {
  EmbreeContext embree;  // first: Embree knows its address
  std::vector<EmbreeCrossings::Crossing>* to;
};

/// Keeps a hit, and lets the search go on as if there were none.
void collect(const RTCFilterFunctionNArguments* query) {
  const auto* const ray = reinterpret_cast<const RTCRay*>(query->ray);
  const auto* const hit = reinterpret_cast<const RTCHit*>(query->hit);
  const float along = ray->dir_x * hit->Ng_x + ray->dir_y * hit->Ng_y + ray->dir_z * hit->Ng_z;
  const auto* const context = reinterpret_cast<const CollectingContext*>(query->context);
  context->to->push_back({ray->tfar, hit->primID, along < 0});
  query->valid[0] = 0;
}

/// Embree's spheres, in the caller's memory.
class EmbreeSpheres {
 public:
  explicit EmbreeSpheres(const std::vector<Sphere>& spheres, RTCFilterFunctionN filter = nullptr) {
    for (const Sphere& s : spheres)
      points_.insert(points_.end(), {s.center.x, s.center.y, s.center.z, s.radius});
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               points_.data(), 0, 4 * sizeof(float), spheres.size());
    rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeSpheres() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeSpheres(const EmbreeSpheres&) = delete;
  EmbreeSpheres& operator=(const EmbreeSpheres&) = delete;

  [[nodiscard]] unsigned closest(const Ray& ray) const {
    EmbreeContext context;
    EmbreeQuery asked(context);
    return intersect(ray, asked);
  }
  /// Precondition: the filter is collect().
  [[nodiscard]] EmbreeCrossings all_hits(const std::vector<Ray>& rays) const {
    EmbreeCrossings found;
    CollectingContext context{{}, &found.all};
    EmbreeQuery asked(context.embree);
    for (const Ray& ray : rays) {
      intersect(ray, asked);
      std::sort(found.all.begin() + static_cast<std::ptrdiff_t>(found.offset.back()),
                found.all.end(), [](const auto& a, const auto& b) {
                  return std::tuple(a.t, a.id, !a.entering) < std::tuple(b.t, b.id, !b.entering);
                });
      found.offset.push_back(found.all.size());
    }
    return found;
  }
  [[nodiscard]] bool any(const Ray& ray) const {
    EmbreeContext context;
    RTCRay query{};
    set(ray, query);
    EmbreeQuery(context).occluded(scene_, query);
    return query.tfar < 0;
  }

 private:
  unsigned intersect(const Ray& ray, EmbreeQuery& asked) const {
    RTCRayHit query{};
    set(ray, query.ray);
    query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    asked.intersect(scene_, query);
    return query.hit.primID;
  }
  static void set(const Ray& ray, RTCRay& to) {
    to.org_x = static_cast<float>(ray.org.x);
    to.org_y = static_cast<float>(ray.org.y);
    to.org_z = static_cast<float>(ray.org.z);
    to.dir_x = ray.dir.x;
    to.dir_y = ray.dir.y;
    to.dir_z = ray.dir.z;
    to.tfar = static_cast<float>(ray.tmax);
    to.mask = ~0U;
  }

  std::vector<float> points_;
  RTCDevice device_ = rtcNewDevice("threads=1");
  RTCScene scene_ = rtcNewScene(device_);
};

/// The rays of a scene, with unit directions: Embree's spheres are least exact without them.
std::vector<Ray> chords(const BenchScene& scene) {
  const RayBuffer pixels(std::size_t{side} * side);
  const RayBuffer made = make_rays(RayKind::chord, scene, {side, &pixels, nullptr});
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < made.size(); ++k) {
    Ray ray = made.get(k);
    const double size = length(vec_cast<double>(ray.dir));
    ray.dir = vec_cast<float>(vec_cast<double>(ray.dir) * (1 / size));
    ray.tmax *= size;
    rays.push_back(ray);
  }
  return rays;
}

/// Nanoseconds of work() for each of `count` rays.
double nanoseconds(std::size_t count, const auto& work) {
  const double begin = thread_seconds();
  work();
  return (thread_seconds() - begin) * 1e9 / static_cast<double>(count);
}
/// Nanoseconds of answer(ray) for each ray.
double nanoseconds(const std::vector<Ray>& rays, const auto& answer) {
  return nanoseconds(rays.size(), [&] {
    for (const Ray& ray : rays) answer(ray);
  });
}

struct Times {
  std::vector<double> ours, theirs;
};

void print(const std::string& what, const Times& times, std::size_t others) {
  const double ours = *std::min_element(times.ours.begin(), times.ours.end());
  const double theirs = *std::min_element(times.theirs.begin(), times.theirs.end());
  std::printf("%-28s Boule %7.0f ns  Embree %7.0f ns  Embree / Boule %.2f  other answers %zu\n",
              what.c_str(), ours, theirs, theirs / ours, others);
}

/// All hits of all rays. Other answers: rays with other crossings.
void compare_lists(const std::string& name, Tracer& tracer, const std::vector<Ray>& rays,
                   const std::vector<Sphere>& spheres) {
  const EmbreeSpheres embree(spheres, collect);
  Times times;
  std::size_t other_answers = 0, crossings = 0;
  for (int k = 0; k < repetitions; ++k) {
    EmbreeCrossings theirs;
    times.theirs.push_back(nanoseconds(rays.size(), [&] { theirs = embree.all_hits(rays); }));
    std::optional<Result<Crossings>> ours;
    times.ours.push_back(nanoseconds(rays.size(), [&] { ours = tracer.all_hits(rays); }));
    const Crossings& all = ours->value();
    other_answers = 0;
    for (std::size_t ray = 0; ray < rays.size(); ++ray) {
      const auto begin = static_cast<std::size_t>(all.offset[ray]);
      const auto end = static_cast<std::size_t>(all.offset[ray + 1]);
      bool same = end - begin == theirs.offset[ray + 1] - theirs.offset[ray];
      for (std::size_t at = begin; same && at < end; ++at)
        same = static_cast<unsigned>(all.id[at]) == theirs.all[theirs.offset[ray] + at - begin].id;
      other_answers += same ? 0 : 1;
    }
    crossings = all.t.size();
  }
  print(name + " all hits", times, other_answers);
  std::printf("%28s crossings a ray: %.2f\n", "",
              static_cast<double>(crossings) / static_cast<double>(rays.size()));
}

int compare(const std::string& name) {
  auto scene = make_scene(name);
  if (!scene) {
    std::fprintf(stderr, "%s\n", scene.error().message.c_str());
    return 2;
  }
  const std::vector<Ray> rays = chords(scene.value());
  Scene objects;
  objects.materials = {{"", Matte{}}};
  objects.spheres = scene.value().spheres;
  TraceOptions options;
  options.threads = 1;
  auto tracer = Tracer::create(std::move(objects), options);
  const EmbreeSpheres embree(scene.value().spheres);

  Times closest, any;
  std::size_t other_hits = 0, other_answers = 0;
  for (int k = 0; k < repetitions; ++k) {
    std::vector<unsigned> hits;
    std::vector<bool> met;
    hits.reserve(rays.size());
    met.reserve(rays.size());
    closest.theirs.push_back(
        nanoseconds(rays, [&](const Ray& ray) { hits.push_back(embree.closest(ray)); }));
    std::size_t at = 0;
    other_hits = 0;
    closest.ours.push_back(nanoseconds(rays, [&](const Ray& ray) {
      const auto id = static_cast<unsigned>(tracer.value().closest(ray).value().id);
      other_hits += id != hits[at++] ? 1 : 0;
    }));
    any.theirs.push_back(
        nanoseconds(rays, [&](const Ray& ray) { met.push_back(embree.any(ray)); }));
    at = other_answers = 0;
    any.ours.push_back(nanoseconds(rays, [&](const Ray& ray) {
      other_answers += tracer.value().any(ray).value() != met[at++] ? 1 : 0;
    }));
  }
  print(name + " closest", closest, other_hits);
  print(name + " any", any, other_answers);
  compare_lists(name, tracer.value(), rays, scene.value().spheres);
  return 0;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"u1000", "u100000", "protein50000", "u1000000"};
  for (const std::string& name : names) {
    if (const int code = boule::bench::compare(name); code != 0) return code;
  }
  return 0;
}
