#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace boule::bench {

/// Time of a ray among n random spheres (the scene uN), one thread, CPU time.
struct Growth {
  std::size_t spheres;
  std::string rays;        ///< as name_of(RayKind) has it
  std::string isa, form;   ///< bundle, packet, single; of other than camera rays automatic
  double ns, least, most;  ///< per ray: median and range of the repetitions
};

/// Solver robust, all wide ISAs that this CPU has, for n = 10^2 .. 10^most_decades; pictures of
/// side x side and one secondary ray of each kind from every hit, ISAs and forms interleaved.
std::vector<Growth> measure_growth(int most_decades, int side, int repetitions);

}  // namespace boule::bench
