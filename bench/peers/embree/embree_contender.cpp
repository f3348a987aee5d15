#include "bench/peers/embree/embree_contender.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/math/geometry.h"

namespace boule::bench {
namespace {

// Fields of Embree's structures, in arrays of as many rays as there are in one.
constexpr std::size_t tnear_field = 3, dir_field = 4, time_field = 7, tfar_field = 8;
constexpr std::size_t mask_field = 9, id_field = 10, flags_field = 11;
constexpr std::size_t ray_fields = 12, prim_id_field = 17, geom_id_field = 18;
constexpr std::size_t instance_field = 19;

constexpr float all_bits = std::bit_cast<float>(RTC_INVALID_GEOMETRY_ID);
constexpr float secondary_start = 1e-5F;

std::size_t group_of(EmbreeCall call) {
  switch (call) {
    case EmbreeCall::rays4:
      return 4;
    case EmbreeCall::rays8:
      return 8;
    case EmbreeCall::rays16:
      return 16;
    case EmbreeCall::rays1:
    case EmbreeCall::stream:
      return 1;
  }
  return 1;
}

/// Of a structure for so many rays, padding included; most for one ray.
constexpr std::size_t ray_hit_fields(std::size_t group) {
  return (group == 1 ? sizeof(RTCRayHit) : sizeof(RTCRayHit16) / 16) / sizeof(float);
}

/// Denormals are zero while it lives, as Embree recommends.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040U); }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

struct Call {
  RTCScene scene;
  EmbreeQuery& query;
  float* rays;
  unsigned count;  ///< rays, of a stream
};

template <class Rays>
Rays& as(float* rays) {
  return *reinterpret_cast<Rays*>(rays);
}

void intersect(EmbreeCall kind, const Call& c) {
  switch (kind) {
    case EmbreeCall::rays1:
      return c.query.intersect(c.scene, as<RTCRayHit>(c.rays));
    case EmbreeCall::rays4:
      return c.query.intersect(rtcIntersect4, c.scene, as<RTCRayHit4>(c.rays));
    case EmbreeCall::rays8:
      return c.query.intersect(rtcIntersect8, c.scene, as<RTCRayHit8>(c.rays));
    case EmbreeCall::rays16:
      return c.query.intersect(rtcIntersect16, c.scene, as<RTCRayHit16>(c.rays));
    case EmbreeCall::stream:
      return c.query.intersect_stream(c.scene, &as<RTCRayHit>(c.rays), c.count);
  }
}

void occluded(EmbreeCall kind, const Call& c) {
  switch (kind) {
    case EmbreeCall::rays1:
      return c.query.occluded(c.scene, as<RTCRay>(c.rays));
    case EmbreeCall::rays4:
      return c.query.occluded(rtcOccluded4, c.scene, as<RTCRay4>(c.rays));
    case EmbreeCall::rays8:
      return c.query.occluded(rtcOccluded8, c.scene, as<RTCRay8>(c.rays));
    case EmbreeCall::rays16:
      return c.query.occluded(rtcOccluded16, c.scene, as<RTCRay16>(c.rays));
    case EmbreeCall::stream:
      return c.query.occluded_stream(c.scene, &as<RTCRay>(c.rays), c.count);
  }
}

}  // namespace

EmbreeRay embree_ray(const Ray& ray) {
  const double size = length(vec_cast<double>(ray.dir));
  const Vec3f org = vec_cast<float>(ray.org);
  const Vec3f dir = vec_cast<float>(vec_cast<double>(ray.dir) * (1 / size));
  return {{org.x, org.y, org.z},
          ray.source == no_primitive ? 0.0F : secondary_start,
          {dir.x, dir.y, dir.z},
          static_cast<float>(double{ray.tmax} * size)};
}

double ray_t(const Ray& ray, double embree_t) {
  return embree_t / length(vec_cast<double>(ray.dir));
}

EmbreeContender::EmbreeContender(Info info, const Workload& workload, RTCScene scene,
                                 EmbreeCall call, EmbreeHint hint, AlignedArray<float>& memory)
    : Contender(std::move(info)),
      workload_(workload),
      scene_(scene),
      call_(call),
      hint_(hint),
      group_(group_of(call)),
      fields_(asks_any(workload.kind) ? ray_fields : ray_hit_fields(group_)),
      memory_(memory) {}

void EmbreeContender::put(std::size_t i, const Ray& ray) {
  const EmbreeRay r = embree_ray(ray);
  float* const begin = memory_.data() + place(i);
  const auto set = [&](std::size_t field, float value) { begin[field * group_] = value; };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    set(axis, r.org[axis]);
    set(dir_field + axis, r.dir[axis]);
  }
  set(tnear_field, r.tnear);
  set(tfar_field, r.tfar);
  set(time_field, 0);
  set(mask_field, all_bits);
  set(id_field, 0);
  set(flags_field, 0);
  for (std::size_t field = ray_fields; field < fields_; ++field) set(field, 0);
  if (fields_ == ray_fields) return;
  for (const std::size_t field : {prim_id_field, geom_id_field, instance_field})
    set(field, all_bits);
}

/// The last structure is filled with copies of the last ray.
void EmbreeContender::prepare() {
  const std::size_t size = workload_.rays->size();
  memory_.resize(padded(size) * ray_hit_fields(1));
  for (std::size_t i = 0; i < padded(size); ++i) {
    put(i, workload_.rays->get(std::min(i, size - 1)));
  }
}

void EmbreeContender::trace(std::size_t first, std::size_t last) {
  const FlushDenormals flush;
  EmbreeContext context;
  EmbreeQuery query(context, hint_);
  const std::size_t step = call_ == EmbreeCall::stream ? embree_stream_size : group_;
  const bool any = asks_any(workload_.kind);
  for (; first < last; first += step) {
    const auto count = static_cast<unsigned>(std::min(step, last - first));
    const Call call = {scene_, query, memory_.data() + first * fields_, count};
    any ? occluded(call_, call) : intersect(call_, call);
  }
}

void EmbreeContender::answer(Answers& answers) const {
  const std::size_t size = workload_.rays->size();
  const auto get = [&](std::size_t i, std::size_t field) {
    return memory_[place(i) + field * group_];
  };
  if (asks_any(workload_.kind)) {
    answers.occluded.resize(size);
    for (std::size_t i = 0; i < size; ++i) answers.occluded[i] = get(i, tfar_field) < 0 ? 1 : 0;
    return;
  }
  answers.hits.assign(size, {});
  for (std::size_t i = 0; i < size; ++i) {
    const auto geometry = std::bit_cast<std::uint32_t>(get(i, geom_id_field));
    if (geometry == RTC_INVALID_GEOMETRY_ID) continue;
    const std::size_t before = geometry == 0 ? 0 : workload_.scene->spheres.size();
    const auto id = std::bit_cast<std::uint32_t>(get(i, prim_id_field)) + before;
    answers.hits[i] = {ray_t(workload_.rays->get(i), double{get(i, tfar_field)}),
                       static_cast<std::int32_t>(id)};
  }
}

}  // namespace boule::bench
