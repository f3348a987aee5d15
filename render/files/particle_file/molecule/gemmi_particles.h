#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_reader.h"
#include "render/files/particle_file/molecule/molecule_columns.h"
#include "render/files/particle_file/molecule/pdb_records.h"

// What gemmi does for the readers of PDB and mmCIF. No other file sees its headers, which take long
// to compile.

namespace boule {

/// False in a build without gemmi. Then the other functions must not be called.
bool has_gemmi();

/// Adds the atoms of PDB records in their order.
Status add_pdb_atoms(PdbRecords records, MoleculeColumns& columns);

/// Adds the bonds of records CONECT among the lines. Serial numbers that atoms share, or that no
/// kept atom has, have none.
void add_pdb_bonds(std::string_view lines, MoleculeColumns& columns);

/// The cell of PDB records CRYST1 and SCALE, in lines of 80 bytes. An error if there is none with
/// these edges and angles.
Result<ParticleCell> read_pdb_cell(const std::string& records);

/// The frames of a CIF file, macromolecules or small molecules; the Diagnostic has a line where
/// gemmi tells it.
Result<std::vector<ParticleFrame>> read_cif_frames(std::string_view text,
                                                   const ParticleFileOptions& options);

}  // namespace boule
