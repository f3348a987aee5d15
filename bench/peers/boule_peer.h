#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/contender.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/aligned_array.h"

namespace boule::bench {

/// Boule on one scene: streams of 1024 rays, as the renderer has them, asked by the queries it
/// would use and by each form.
class BoulePeer {
 public:
  /// `isas`: names of supported instruction sets.
  BoulePeer(const BenchScene& scene, std::vector<std::string> isas);

  /// All contenders for a workload of this scene; they live no longer than this and share memory
  /// for the answers. boule-ISA: Form::automatic; -single, -flight, -set, -packet: that form;
  /// -fast: that solver, in packets.
  std::vector<std::unique_ptr<Contender>> contenders(const Workload& workload);

 private:
  Geometry geometry_;
  std::vector<std::string> isas_;
  HitBuffer hits_;
  AlignedArray<std::uint8_t> occluded_;
};

}  // namespace boule::bench
