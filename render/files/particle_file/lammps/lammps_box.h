#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// A box of LAMMPS: the edges are (hi.x - lo.x, 0, 0), (xy, hi.y - lo.y, 0), (xz, yz, hi.z - lo.z).
/// What a data file does not say is as read_data takes it.
struct LammpsBox {
  Vec3d lo{-0.5, -0.5, -0.5}, hi{0.5, 0.5, 0.5};
  double xy = 0, xz = 0, yz = 0;
};

/// The box whose bounding box a dump gives in place of `lo` and `hi`
/// (docs.lammps.org/Howto_triclinic.html).
LammpsBox box_in_bounds(LammpsBox bounds);

/// "x", "y" or "z": the first axis along which `hi` is below `lo`; none if there is no such axis.
std::optional<std::string> negative_axis(const LammpsBox& box);

ParticleCell cell_of(const LammpsBox& box);

/// The cell of a dump's box, whose axes are lines from `first_line` on (0: it has no lines). An
/// error if it has a negative length or numbers that are not finite.
Result<ParticleCell> cell_of_dump(const LammpsBox& box, std::uint64_t first_line);
/// The error for a cell that is not finite.
Diagnostic too_large_box(std::uint64_t line);

/// True for the names of the `units` styles: "real", "metal", "lj" ...
bool is_lammps_units(std::string_view units);

/// How many angstrom the unit of length of this `units` style has; 1 for "lj" and unknown ones.
double lammps_length_in_angstrom(std::string_view units);

}  // namespace boule
