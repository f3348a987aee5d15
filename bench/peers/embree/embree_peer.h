#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/contender.h"
#include "bench/peers/embree/embree_callbacks.h"
#include "simd/dispatch/cpu.h"
#include "simd/stream/aligned_array.h"

namespace boule::bench {

/// Embree on one scene, in its best form: its own spheres ("builtin") and user geometry with our
/// callbacks ("user"), capsules as its own round linear curves beside either, each asked for 1, 4,
/// 8, 16 rays at a time, and with Embree 3 for a stream ("1M"). Primary rays are declared coherent,
/// diffuse ones incoherent, the others both ("-incoherent").
///
/// In Embree's favour: its structures of rays are filled, and tfar and the ids reset, outside the
/// timed part; directions are of unit length, so that the callback need not divide; denormals are
/// flushed while it runs; no normal is computed by the callback.
class EmbreePeer {
 public:
  /// `isa`: avx2, to which Embree is then limited, or avx512. Contenders of avx2 are named
  /// "embree-avx2-...".
  EmbreePeer(const BenchScene& scene, Isa isa);
  ~EmbreePeer();
  EmbreePeer(const EmbreePeer&) = delete;
  EmbreePeer& operator=(const EmbreePeer&) = delete;

  /// All contenders for a workload of this scene; they live no longer than this and share the
  /// memory of the rays.
  std::vector<std::unique_ptr<Contender>> contenders(const Workload& workload);

 private:
  RTCScene build(RTCGeometry spheres) const;
  RTCGeometry builtin_geometry() const;
  RTCGeometry user_geometry();
  RTCGeometry curves() const;

  const BenchScene& scene_;
  RTCDevice device_;
  Isa isa_;
  EmbreeCallbacks callbacks_;
  AlignedArray<PackedSphere> packed_;
  AlignedArray<float> rays_;  ///< in the layout of whoever has prepared
  RTCScene builtin_, user_;
};

/// Version of the library that runs: "3.13.5".
std::string embree_version();

}  // namespace boule::bench
