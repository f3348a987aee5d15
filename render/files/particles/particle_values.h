#pragma once

#include <cstddef>
#include <vector>

#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// A value of every particle: its own, that of its text in a column, or one for all.
template <class T>
struct ParticleValues {
  std::vector<T> values;  ///< of each particle, or one for all; with `kinds`: by its texts' numbers
  const TextColumn* kinds = nullptr;  ///< a view of the frame, which outlives this

  /// Precondition: the frame has this particle.
  const T& operator[](std::size_t particle) const {
    if (kinds != nullptr) return values[kinds->indices[particle]];
    return values[values.size() > 1 ? particle : 0];
  }
};

}  // namespace boule
