#include <array>
#include <span>

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

std::span<const ParticleFormat> all_particle_formats() {
  // A row for each format. The first whose content looks right is taken: the strictest come first.
  static const std::array formats{
      npy_format, ply_format, dump_format,  lammps_data_format, xyz_format,  gro_format,
      pdb_format, pqr_format, mmcif_format, table_format,       hdf5_format, library_format,
  };
  return formats;
}

}  // namespace boule
