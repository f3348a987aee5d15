#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "render/files/particle_file/text/frame_places.h"

namespace boule {

/// Where a frame of a PDB file is: a model, or what stands before an END.
struct PdbFrame {
  std::size_t begin = 0, end = 0;  ///< bytes of the text
  std::uint64_t line = 0;          ///< of the first byte
  std::uint64_t atoms = 0;         ///< records ATOM and HETATM
  std::size_t cell = 0;            ///< first byte of the record CRYST1 that counts,
  std::uint64_t cell_line = 0;     ///< its line; 0: there is none
};

/// Finds the frames that have atoms, at least one. A frame's cell is its own, else that of the
/// file. The file was cut off in its last frame if that has no end, and ends with a part of a
/// record or, in a trajectory, has fewer atoms than the frame before; with `is_cut`, if it has no
/// end.
Result<FramePlaces<PdbFrame>> find_pdb_frames(std::string_view text, bool is_cut);

/// True if this line is of an atom.
bool is_pdb_atom(std::string_view line);

/// True if this line is of bonds: CONECT.
bool is_pdb_bond(std::string_view line);

/// Which fields of atoms are read.
struct PdbFields {
  bool occupancy = true, b_factor = true;
  bool lenient = false;  ///< as ParticleFileOptions
};

/// Records of atoms.
struct PdbRecords {
  std::string lines;  ///< each 80 bytes and '\n'
  struct Numbers {
    Vec3d position;
    double occupancy = 1, b_factor = 0;
  };
  std::vector<Numbers> numbers;  ///< of each: the nearest doubles, positions finite
};

/// Reads the numbers of an atom's line and adds the line as every reader understands it: printable
/// bytes, without these numbers, charges, and the numbers of lines of old files. Fields that are
/// not to be read, and those that are blank, are an occupancy of 1 and a B factor of 0.
Status add_pdb_record(std::string_view line, std::uint64_t line_number, const PdbFields& fields,
                      PdbRecords& records);

/// The records CRYST1 and SCALE that begin with this line, in lines of 80 bytes; nothing if they
/// give no edges, or edges of 0 or 1, which stand for none. `text` begins with CRYST1.
Result<std::string> pdb_cell_records(std::string_view text, std::uint64_t line_number);

}  // namespace boule
