#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/file/mapped_text.h"
#include "render/files/particle_file/frame/particle_reader.h"

namespace boule {

/// A format of particle files: how it is known and what reads it.
struct ParticleFormat {
  std::string_view name;  ///< as --input-format takes it: "xyz"
  /// The endings of its files' names, without the dot and in lower case, without those of
  /// compression; empty entries at the end.
  std::array<std::string_view, 4> endings{};
  /// True if a file that starts with `start` (its first 64 KiB, unpacked) is likely of this
  /// format. Never for formats that only their ending tells.
  bool (*starts_like)(std::string_view start) = nullptr;
  /// A reader of the file's bytes, which finds its frames. The Diagnostic's file is set by the
  /// caller.
  Result<std::unique_ptr<ParticleReader>> (*open)(MappedText bytes,
                                                  const ParticleFileOptions& options,
                                                  const ParallelFor& parallel_for) = nullptr;
  /// Whether files hold many frames, of which the whole ones are read where the file is cut off.
  bool is_trajectory = false;
  std::string_view prefix{};   ///< that users give to names of files: "dump." of "dump.melt"
  bool names_columns = false;  ///< a file names its columns itself
  /// In place of endings: true for a file's name in lower case, without its folder and an ending of
  /// compression.
  bool (*knows_name)(std::string_view name) = nullptr;
  /// In place of `open`, for those that read the file themselves: its path, and how many particles
  /// it has if that is known from elsewhere, else 0.
  Result<std::unique_ptr<ParticleReader>> (*open_file)(const std::string& path,
                                                       const ParticleFileOptions& options,
                                                       std::size_t particles) = nullptr;
};

/// .npy files of particles: rows of numbers (x, y, z, radius and more), or a structured array whose
/// named fields are the columns.
extern const ParticleFormat npy_format;
/// PLY in its three encodings: the points are the element "vertex", all others are left out with a
/// note. "scalar_NAME" is NAME; red, green, blue and alpha of whole numbers are from 0 to 1.
extern const ParticleFormat ply_format;
/// Dumps of LAMMPS, frame after frame: text ("ITEM: ATOMS" and a row for each particle), YAML, or
/// binary.
extern const ParticleFormat dump_format;
/// Data files of LAMMPS, as read_data takes them: one frame.
extern const ParticleFormat lammps_data_format;
/// XYZ and extended XYZ: a count, a line of comment, and a line for each particle; frame after
/// frame.
extern const ParticleFormat xyz_format;
/// GRO files of GROMACS: a title, a count, a line for each atom, and the box; frame after frame.
/// Lengths are in nm.
extern const ParticleFormat gro_format;
/// PDB files: records of fixed columns; model after model. What a line's columns mean is gemmi's
/// matter, numbers are checked before.
extern const ParticleFormat pdb_format;
/// PQR: molecules with the charge and the radius of each atom, as continuum electrostatics has
/// them.
extern const ParticleFormat pqr_format;
/// CIF files: macromolecules (mmCIF), a frame for each model, and small molecules. gemmi reads
/// them, as a whole.
extern const ParticleFormat mmcif_format;
/// Tables as text: a row for each particle, columns between commas, semicolons, tabs or blanks,
/// named by a header line, a comment before the rows, or ParticleFileOptions::columns.
extern const ParticleFormat table_format;
/// HDF5: trajectories of H5MD, snapshots of GADGET and its family, and openPMD; libhdf5 reads them,
/// in a module.
extern const ParticleFormat hdf5_format;
/// All files that libraries of Python read (bridge/boule_read.py).
extern const ParticleFormat library_format;

/// All formats, in the order in which a file's content is compared with them.
std::span<const ParticleFormat> all_particle_formats();

}  // namespace boule
