#pragma once

#include <functional>
#include <string>

namespace boule {

/// Which launcher of MPI started this process.
struct MpiLauncher {
  std::string name;    ///< "OpenMPI" or "MPICH"; empty: none
  std::string module;  ///< the file of the module for it
};

/// By the variables that launchers set; `variable` gives a variable's value, or null. A launcher
/// that started one process only counts as none. OpenMPI's mpirun and srun --mpi=pmix, MPICH's
/// mpiexec and srun --mpi=pmi2 are known.
MpiLauncher find_mpi_launcher(const std::function<const char*(const char* name)>& variable);

/// How many copies of this process a launcher started that is not MPI's: srun without --mpi, or
/// with
/// --mpi=none. 1 where find_mpi_launcher() finds one, and for the one process of a batch script.
int count_copies(const std::function<const char*(const char* name)>& variable);

}  // namespace boule
