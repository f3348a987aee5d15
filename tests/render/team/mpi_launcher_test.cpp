// Which variables of the environment say that a launcher started several ranks.
#include "render/team/mpi_launcher.h"

#include <gtest/gtest.h>

#include <map>

namespace boule::test {
namespace {

std::string launcher(const std::map<std::string, std::string>& environment) {
  const auto find = [&](const char* name) {
    const auto at = environment.find(name);
    return at == environment.end() ? nullptr : at->second.c_str();
  };
  return find_mpi_launcher(find).name;
}

TEST(MpiLauncher, IsFoundByItsVariables) {
  EXPECT_EQ(launcher({{"OMPI_COMM_WORLD_SIZE", "4"}, {"PMIX_RANK", "0"}}), "OpenMPI");
  EXPECT_EQ(launcher({{"PMI_SIZE", "2"}, {"PMI_RANK", "1"}}), "MPICH");
  EXPECT_EQ(launcher({{"PMIX_RANK", "1"}, {"SLURM_STEP_NUM_TASKS", "16"}}), "OpenMPI");
  EXPECT_EQ(launcher({{"PMI_RANK", "1"}, {"SLURM_STEP_NUM_TASKS", "16"}}), "MPICH");
}

TEST(MpiLauncher, SingleProcessesHaveNoLauncher) {
  EXPECT_EQ(launcher({}), "");
  EXPECT_EQ(launcher({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "16"}}), "");
  EXPECT_EQ(launcher({{"OMPI_COMM_WORLD_SIZE", "1"}}), "");
  EXPECT_EQ(launcher({{"PMI_SIZE", "1"}}), "");
  EXPECT_EQ(launcher({{"OMPI_COMM_WORLD_SIZE", "many"}}), "");
}

}  // namespace
}  // namespace boule::test
