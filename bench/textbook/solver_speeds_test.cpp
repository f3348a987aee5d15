// The speeds of all solvers are measured, and all of them answer.
#include "bench/textbook/solver_speeds.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "bench/textbook/book_solvers.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

TEST(SolverSpeeds, AreGivenForEverySolver) {
  const std::vector<SolverSpeed> speeds = measure_solver_speeds({"u500", "u3000"}, 1, 32);
  std::size_t solvers = 0;
  for (const IsaInfo& info : list_isas())
    solvers += info.supported ? 3 + book_solvers(info.isa).size() : 0;
  EXPECT_EQ(speeds.size(), 3 * solvers);  // the greater scene is not scanned
  for (const SolverSpeed& speed : speeds) {
    const std::string name = speed.scene + speed.structure + speed.isa + speed.solver;
    const bool exact = speed.solver == "robust" || speed.solver == "bundle";
    EXPECT_GT(speed.least, 0) << name;
    EXPECT_LE(speed.least, speed.mrays_per_s) << name;
    EXPECT_LE(speed.mrays_per_s, speed.most) << name;
    EXPECT_EQ(speed.rays, 1024U) << name;
    EXPECT_LE(speed.differ, exact ? 0U : 10U) << name;
  }
}

TEST(SolverSpeeds, RefuseASceneThatThereIsNot) {
  EXPECT_THROW(measure_solver_speeds({"moon"}, 1, 32), std::runtime_error);
}

}  // namespace
}  // namespace boule::bench
