#include "render/apps/team/mpi_launcher.h"

#include <algorithm>
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

/// A step's tasks have a number of tasks of their own; without it, that of the job counts where the
/// process belongs to a step.
int count_copies(const std::function<const char*(const char* name)>& variable) {
  const auto is_set = [&variable](const char* name) { return variable(name) != nullptr; };
  const auto number = [&variable](const char* name) { return std::atoi(variable(name)); };
  if (!find_mpi_launcher(variable).name.empty() || !is_set("SLURM_PROCID")) return 1;
  if (is_set("OMPI_COMM_WORLD_SIZE") || is_set("PMI_SIZE")) return 1;  // one process of MPI
  if (is_set("SLURM_STEP_NUM_TASKS")) return std::max(number("SLURM_STEP_NUM_TASKS"), 1);
  const bool is_step = is_set("SLURM_STEP_ID") || is_set("SLURM_STEPID");
  return is_step && is_set("SLURM_NTASKS") ? std::max(number("SLURM_NTASKS"), 1) : 1;
}

}  // namespace boule
