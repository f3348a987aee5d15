#pragma once

/// Embree 4 or 3, whichever was found: BOULE_EMBREE. What differs between them is here.
#if BOULE_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace boule::bench {

alignas(64) inline constexpr int embree_all_valid[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                         -1, -1, -1, -1, -1, -1, -1, -1};

#if BOULE_EMBREE == 4

using EmbreeContext = RTCRayQueryContext;
using EmbreeHint = RTCRayQueryFlags;
inline constexpr EmbreeHint embree_coherent = RTC_RAY_QUERY_FLAG_COHERENT;
inline constexpr EmbreeHint embree_incoherent = RTC_RAY_QUERY_FLAG_INCOHERENT;
inline constexpr bool embree_has_streams = false;

/// Asks Embree. Filters see the context, which must outlive the query.
class EmbreeQuery {
 public:
  explicit EmbreeQuery(EmbreeContext& context, EmbreeHint hint = embree_incoherent) {
    rtcInitRayQueryContext(&context);
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.context = occluded_.context = &context;
    intersect_.flags = occluded_.flags = hint;
  }
  void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray, &intersect_); }
  void occluded(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray, &occluded_); }
  /// `call`: rtcIntersect4, 8 or 16.
  template <class Rays>
  void intersect(void (*call)(const int*, RTCScene, Rays*, RTCIntersectArguments*), RTCScene scene,
                 Rays& rays) {
    call(embree_all_valid, scene, &rays, &intersect_);
  }
  /// `call`: rtcOccluded4, 8 or 16.
  template <class Rays>
  void occluded(void (*call)(const int*, RTCScene, Rays*, RTCOccludedArguments*), RTCScene scene,
                Rays& rays) {
    call(embree_all_valid, scene, &rays, &occluded_);
  }
  void intersect_stream(RTCScene scene, RTCRayHit* rays, unsigned count) {
    for (unsigned i = 0; i < count; ++i) intersect(scene, rays[i]);
  }
  void occluded_stream(RTCScene scene, RTCRay* rays, unsigned count) {
    for (unsigned i = 0; i < count; ++i) occluded(scene, rays[i]);
  }

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};

#else

using EmbreeContext = RTCIntersectContext;
using EmbreeHint = RTCIntersectContextFlags;
inline constexpr EmbreeHint embree_coherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
inline constexpr EmbreeHint embree_incoherent = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
inline constexpr bool embree_has_streams = true;

/// Asks Embree. Filters see the context, which must outlive the query.
class EmbreeQuery {
 public:
  explicit EmbreeQuery(EmbreeContext& context, EmbreeHint hint = embree_incoherent)
      : context_(&context) {
    rtcInitIntersectContext(&context);
    context.flags = hint;
  }
  void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, context_, &ray); }
  void occluded(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, context_, &ray); }
  /// `call`: rtcIntersect4, 8 or 16; rtcOccluded4, 8 or 16.
  template <class Rays>
  void intersect(void (*call)(const int*, RTCScene, EmbreeContext*, Rays*), RTCScene scene,
                 Rays& rays) {
    call(embree_all_valid, scene, context_, &rays);
  }
  template <class Rays>
  void occluded(void (*call)(const int*, RTCScene, EmbreeContext*, Rays*), RTCScene scene,
                Rays& rays) {
    call(embree_all_valid, scene, context_, &rays);
  }
  void intersect_stream(RTCScene scene, RTCRayHit* rays, unsigned count) {
    rtcIntersect1M(scene, context_, rays, count, sizeof(RTCRayHit));
  }
  void occluded_stream(RTCScene scene, RTCRay* rays, unsigned count) {
    rtcOccluded1M(scene, context_, rays, count, sizeof(RTCRay));
  }

 private:
  EmbreeContext* context_;
};

#endif

}  // namespace boule::bench
