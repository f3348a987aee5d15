#pragma once

#include <optional>
#include <string>

#include "bench/scenes/bench_scenes.h"

namespace boule::bench {

/// Scenes with capsules, N a number:
///   sticksN  balls and sticks: the atoms of proteinN at a quarter of their radius, and bonds of
///            radius 0.15 angstrom, 51 for 50 atoms: the shortest of all pairs that are 1 to 2.5
///            angstrom apart. N from 24 to 1,000,000
///   cellN    uN and the edges of a cell, 12 thin capsules: a cube half as wide in its middle,
///   which
///            the camera sees whole. N from 1 to 10,000,000
/// None if the name is not of these.
std::optional<BenchScene> make_stick_scene(const std::string& name);

}  // namespace boule::bench
