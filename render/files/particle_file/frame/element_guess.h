#pragma once

#include <cstddef>
#include <string_view>

#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// The symbol of an atom's element by its name and that of its residue, where a file does not tell
/// the element: "C" for the atom CA of the residue ALA, "Ca" for that of the residue CA. What comes
/// before the name's first letter does not count. In this order it is
/// - two letters as symbols are written: "Fe2";
/// - an ion, whose residue has the same letters, or is called ION, or has another name of this ion:
///   NA, CL, ZN, and those of CHARMM (SOD, CLA, ...);
/// - one of BR, CL, FE, MG, SE, SI, ZN at the start of the name;
/// - the first letter, if that is a symbol (or D);
/// - else the whole name, which is no element: a grain of a coarse model, a virtual site.
/// The result is a view of `atom` or of memory that stays.
std::string_view element_of_atom(std::string_view atom, std::string_view residue);

/// Of these rules the one of ions alone: "Na" for the atom SOD of the residue SOD; empty for what
/// is no ion.
std::string_view ion_of_atom(std::string_view atom, std::string_view residue);

/// The symbol of an element by its atomic number, "X" for 0; empty above `last_element`.
std::string_view element_of_number(std::size_t number);
inline constexpr std::size_t last_element = 118;

/// What a note says where elements are not in the file.
inline constexpr const char* elements_are_guessed =
    "the elements are guessed from the names of atoms and residues";

/// Makes such elements the species, with a note, of a frame that has names of atoms: the columns
/// "name" and, if it is there, "resname".
void guess_species(ParticleFrame& frame);

}  // namespace boule
