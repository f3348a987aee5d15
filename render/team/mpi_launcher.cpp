#include "render/team/mpi_launcher.h"

#include <cstdlib>

namespace boule {

MpiLauncher find_mpi_launcher(const std::function<const char*(const char* name)>& variable) {
  const auto is_team = [&variable](const char* size) {
    const char* const text = variable(size);
    return text != nullptr && std::atoi(text) > 1;
  };
  const auto is_set = [&variable](const char* name) { return variable(name) != nullptr; };
  MpiLauncher open{"OpenMPI", "boule_mpi_openmpi.so"}, mpich{"MPICH", "boule_mpi_mpich.so"};
  if (is_set("OMPI_COMM_WORLD_SIZE")) return is_team("OMPI_COMM_WORLD_SIZE") ? open : MpiLauncher{};
  if (is_set("PMI_SIZE")) return is_team("PMI_SIZE") ? mpich : MpiLauncher{};
  if (is_set("PMIX_RANK") && is_team("SLURM_STEP_NUM_TASKS")) return open;
  if (is_set("PMI_RANK") && is_team("SLURM_STEP_NUM_TASKS")) return mpich;
  return {};
}

}  // namespace boule
