#include <array>
#include <span>

#include "render/particle_file/dump_reader.h"
#include "render/particle_file/gro_reader.h"
#include "render/particle_file/lammps_data_reader.h"
#include "render/particle_file/mmcif_reader.h"
#include "render/particle_file/npy_particles.h"
#include "render/particle_file/particle_format.h"
#include "render/particle_file/pdb_reader.h"
#include "render/particle_file/ply_reader.h"
#include "render/particle_file/pqr_reader.h"
#include "render/particle_file/table_reader.h"
#include "render/particle_file/xyz_reader.h"

namespace boule {

std::span<const ParticleFormat> all_particle_formats() {
  // A row for each format. The first whose content looks right is taken: the strictest come first.
  static const std::array formats{
      npy_format, ply_format, dump_format, lammps_data_format, xyz_format,
      gro_format, pdb_format, pqr_format,  mmcif_format,       table_format,
  };
  return formats;
}

}  // namespace boule
