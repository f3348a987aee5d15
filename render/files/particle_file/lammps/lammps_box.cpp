#include "render/files/particle_file/lammps/lammps_box.h"

#include <algorithm>
#include <array>

#include "render/files/particle_file/text/text_lines.h"

namespace boule {

LammpsBox box_in_bounds(LammpsBox bounds) {
  bounds.lo.x -= std::min({0.0, bounds.xy, bounds.xz, bounds.xy + bounds.xz});
  bounds.hi.x -= std::max({0.0, bounds.xy, bounds.xz, bounds.xy + bounds.xz});
  bounds.lo.y -= std::min(0.0, bounds.yz);
  bounds.hi.y -= std::max(0.0, bounds.yz);
  return bounds;
}

std::optional<std::string> negative_axis(const LammpsBox& box) {
  if (box.hi.x < box.lo.x) return "x";
  if (box.hi.y < box.lo.y) return "y";
  if (box.hi.z < box.lo.z) return "z";
  return std::nullopt;
}

ParticleCell cell_of(const LammpsBox& box) {
  ParticleCell cell;
  cell.origin = box.lo;
  cell.a = {box.hi.x - box.lo.x, 0, 0};
  cell.b = {box.xy, box.hi.y - box.lo.y, 0};
  cell.c = {box.xz, box.yz, box.hi.z - box.lo.z};
  cell.periodic = {true, true, true};
  return cell;
}

Diagnostic too_large_box(std::uint64_t line) {
  return error_at_line(line, "the box is larger than the largest number", "BOX BOUNDS");
}

Result<ParticleCell> cell_of_dump(const LammpsBox& box, std::uint64_t first_line) {
  if (const auto axis = negative_axis(box)) {
    const auto number = static_cast<std::uint64_t>(axis->front() - 'x');
    return error_at_line(first_line > 0 ? first_line + number : 0,
                         "the box has a negative length along " + *axis, "BOX BOUNDS");
  }
  const ParticleCell cell = cell_of(box);
  if (!is_finite(cell)) return too_large_box(first_line);
  return cell;
}

bool is_lammps_units(std::string_view units) {
  constexpr std::array known{"lj", "real", "metal", "si", "cgs", "electron", "micro", "nano"};
  return std::find(known.begin(), known.end(), units) != known.end();
}

double lammps_length_in_angstrom(std::string_view units) {
  if (units == "si") return 1e10;
  if (units == "cgs") return 1e8;
  if (units == "micro") return 1e4;
  if (units == "nano") return 10;
  if (units == "electron") return 0.529177210903;  // Bohr's radius, CODATA 2018
  return 1;                                        // real, metal: angstrom; lj: none
}

}  // namespace boule
