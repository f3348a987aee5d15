// Coherent rays, traced as bundles.
#include "simd/kernel/search/bundle/bundle_stream.h"
#include "simd/kernel/search/bundle/bundled.h"
#include "simd/kernel/search/bundle/shadow_stream.h"

namespace boule::BOULE_KERNEL_ISA {

template <class Geometry>
void closest_hit_bundled(const Geometry& geometry, const PaddedStream& stream, Coherence coherence,
                         const HitStream& hits) {
  if (coherence == Coherence::common_origin) {
    closest_hit_bundled<Common::origin>(geometry, stream, hits);
  } else {
    closest_hit_bundled<Common::direction>(geometry, stream, hits);
  }
}

template <class Geometry>
void any_hit_bundled(const Geometry& geometry, const PaddedStream& stream, Coherence coherence,
                     Experience* kept, std::uint8_t* occluded) {
  Experience own;
  Experience& known = kept == nullptr ? own : *kept;
  if (coherence == Coherence::common_origin) {
    any_hit_bundled<Common::origin>(geometry, stream, known, occluded);
  } else if (coherence == Coherence::common_direction) {
    any_hit_bundled<Common::direction>(geometry, stream, known, occluded);
  } else {
    any_hit_bundled<Common::end>(geometry, stream, known, occluded);
  }
}

template void closest_hit_bundled(const GeometryView&, const PaddedStream&, Coherence,
                                  const HitStream&);
template void closest_hit_bundled(const PartsGeometry&, const PaddedStream&, Coherence,
                                  const HitStream&);
template void any_hit_bundled(const GeometryView&, const PaddedStream&, Coherence, Experience*,
                              std::uint8_t*);
template void any_hit_bundled(const PartsGeometry&, const PaddedStream&, Coherence, Experience*,
                              std::uint8_t*);

}  // namespace boule::BOULE_KERNEL_ISA
