#pragma once

#include <cmath>
#include <gemmi/unitcell.hpp>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// A cell of gemmi's, periodic along all edges. An error if it is none, as with angles that do not
/// go together.
inline Result<ParticleCell> particle_cell(const gemmi::UnitCell& cell) {
  const auto& m = cell.orth.mat;
  const double volume = m.determinant();
  bool finite = std::isfinite(volume) && volume != 0;
  for (int i = 0; i < 9; ++i) finite = finite && std::isfinite(m[i / 3][i % 3]);
  if (!finite) return Diagnostic::of("there is no cell with these edges and angles");
  return ParticleCell{.a = {m[0][0], m[1][0], m[2][0]},
                      .b = {m[0][1], m[1][1], m[2][1]},
                      .c = {m[0][2], m[1][2], m[2][2]},
                      .origin = {},
                      .periodic = {true, true, true}};
}

}  // namespace boule
