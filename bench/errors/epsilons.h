#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/errors/epsilon_scenes.h"
#include "render/image/image.h"

namespace boule::bench {

/// The errors of one remedy against false shadows on the points that a camera sees. All remedies
/// get the same hits, normals and N.L; only their shadow rays differ. The tests' tracer in long
/// double is the truth; points that it is unsure of are left out.
struct EpsilonFigure {
  std::string experiment, remedy;
  double x = 0;
  std::size_t points = 0;         ///< judged
  std::size_t undecided = 0;      ///< left out on the way to them
  std::size_t wrong_hits = 0;     ///< the first hit is not the truth's: left out too
  std::size_t lit = 0;            ///< in truth
  std::size_t false_shadows = 0;  ///< in truth lit
  std::size_t leaks = 0;          ///< in truth in shadow
};

/// The names of the remedies: those in float (float_remedies.h), then "ours", the renderer's.
std::vector<std::string> epsilon_remedies();

/// Every remedy on `points` random points of a scene (fewer if it is hard to find them).
std::vector<EpsilonFigure> epsilon_figures(const EpsilonScene& scene, std::size_t points,
                                           std::uint64_t seed);

/// The same for all of epsilon_scenes(), scene by scene.
std::vector<EpsilonFigure> run_epsilon_experiment(std::size_t points_per_figure,
                                                  std::uint64_t seed);

/// Pictures of a scene under one remedy, in linear grey with one sample per pixel: as it is, and
/// with false shadows in red and leaks in blue.
struct EpsilonPicture {
  std::string remedy;
  Image plain, marked;
  std::size_t false_shadows = 0, leaks = 0;
};

/// One for each of epsilon_remedies().
std::vector<EpsilonPicture> draw_epsilon_pictures(const EpsilonScene& scene, int width, int height);

}  // namespace boule::bench
