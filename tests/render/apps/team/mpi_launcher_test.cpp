// Which variables of the environment say that a launcher started several ranks.
#include "render/apps/team/mpi_launcher.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

namespace boule::test {
namespace {

using Environment = std::map<std::string, std::string>;

std::function<const char*(const char*)> finder(const Environment& environment) {
  return [&environment](const char* name) {
    const auto at = environment.find(name);
    return at == environment.end() ? nullptr : at->second.c_str();
  };
}
std::string launcher(const Environment& environment) {
  return find_mpi_launcher(finder(environment)).name;
}
int copies(const Environment& environment) { return count_copies(finder(environment)); }

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

/// As srun sets them since Slurm 17, in steps without MPI.
TEST(MpiLauncher, CopiesOfSrunAreCounted) {
  EXPECT_EQ(copies({{"SLURM_PROCID", "2"}, {"SLURM_STEP_ID", "0"}, {"SLURM_STEP_NUM_TASKS", "4"}}),
            4);
  EXPECT_EQ(copies({{"SLURM_PROCID", "0"}, {"SLURM_STEP_ID", "0"}, {"SLURM_NTASKS", "4"}}), 4);
  EXPECT_EQ(copies({{"SLURM_PROCID", "0"}, {"SLURM_STEPID", "3"}, {"SLURM_NTASKS", "2"}}), 2);
}

TEST(MpiLauncher, OthersAreNoCopies) {
  EXPECT_EQ(copies({}), 1);
  // The script of a job, and a step of one task in a job of many.
  EXPECT_EQ(copies({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "16"}}), 1);
  EXPECT_EQ(copies({{"SLURM_PROCID", "0"},
                    {"SLURM_STEP_ID", "0"},
                    {"SLURM_NTASKS", "16"},
                    {"SLURM_STEP_NUM_TASKS", "1"}}),
            1);
  EXPECT_EQ(copies({{"SLURM_STEP_NUM_TASKS", "4"}}), 1);
  const Environment step = {
      {"SLURM_PROCID", "1"}, {"SLURM_STEP_ID", "0"}, {"SLURM_STEP_NUM_TASKS", "4"}};
  for (const char* const mpi : {"PMIX_RANK", "PMI_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    Environment ranks = step;
    ranks[mpi] = "1";
    EXPECT_EQ(copies(ranks), 1) << mpi;
  }
}

}  // namespace
}  // namespace boule::test
