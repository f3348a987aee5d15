#pragma once

#include <span>
#include <string_view>

#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// The effective ionic radius of an element, in angstrom: R. D. Shannon, Acta Cryst. A32, 751,
/// 1976. It is that of the most common oxidation state, with six neighbours (nitrogen: four, the
/// only ones of nitride that the source has) and, where the source tells them apart, high spin.
struct IonicRadius {
  std::string_view symbol;
  int charge;
  double radius;
};

/// Those that the source has, in the order of the atomic numbers. It lacks hydrogen as a sphere,
/// noble gases, radium with six neighbours, and what lies beyond californium.
std::span<const IonicRadius> all_ionic_radii();

/// 0 where there is none.
double ionic_radius(std::string_view symbol);

/// Whether a frame shows a salt or an oxide: in a cell that is periodic along all three edges,
/// three in ten particles or more are O, F, Cl, Br or I, and all others are elements whose ion is
/// positive and has at least 0.5 angstrom.
bool is_salt(const ParticleFrame& frame);

}  // namespace boule
