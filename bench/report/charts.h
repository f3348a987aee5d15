#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/report/chart.h"
#include "bench/report/figures.h"

namespace boule::bench {

/// Wrong decisions over all hard cases, by ISA and solver.
struct ErrorSum {
  std::size_t pairs = 0, wrong = 0;
  [[nodiscard]] double per_million() const;
};
using ErrorSums = std::map<std::pair<std::string, std::string>, ErrorSum>;
ErrorSums sum_errors(const std::vector<CaseErrors>& cases);

/// Mray/s against wrong decisions per million, a point for each solver and ISA.
Chart speed_chart(const Figures& figures, const std::string& scene, const std::string& structure);

/// Where one solver goes wrong, by distance and grazing.
HeatMap error_chart(Figures& figures, const std::string& solver);

/// False shadows and leaks of each remedy in one experiment, in percent of the points.
Chart epsilon_chart(const Figures& figures, const std::string& experiment);

/// Time of a ray over the number of spheres.
Chart growth_chart(const Figures& figures);

/// The same of rays that leave what the camera sees, by kind.
Chart secondary_chart(const Figures& figures);

/// Error over time, ours beside random samples.
Chart path_error_chart(const ScenePathErrors& scene);

/// Error over time: as many samples everywhere, in sequence and at random, and noise to order.
Chart noise_chart(const SceneNoiseErrors& scene);

/// The names, colours and shapes of solvers.
std::string solver_name(const std::string& solver);
Look solver_look(const std::string& solver, const std::string& isa);

}  // namespace boule::bench
