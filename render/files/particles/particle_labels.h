#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// Which particles have a text on the picture, and which.
struct LabelRule {
  std::string select{};  ///< as ParticleStyle::select; empty: none
  /// The columns whose values it has, with blanks between them; none: "name", else the species,
  /// else the number of the particle, from 1.
  std::vector<std::string> text{};
};

/// A particle's text.
struct ParticleLabel {
  Vec3d position{};  ///< of its centre, as the file counts it
  double radius = 0;
  std::string text{};
};

/// More of them would hide each other.
inline constexpr std::size_t most_labels = 500;

/// The labels of a frame's particles; of images only the first. An error about "labels" for a wrong
/// expression and for more than most_labels, and about "label_text" if there is no such column.
Result<std::vector<ParticleLabel>> find_labels(const ParticleFrame& frame, const LabelRule& rule,
                                               const ParticleValues<float>& radii,
                                               const ParallelFor& parallel_for);

/// The columns that a rule reads, for messages about those that are not there.
void add_label_columns(const LabelRule& rule, std::vector<std::string>& names);

}  // namespace boule
