#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/scenes/bench_scenes.h"

namespace boule::bench {

/// Scenes that are hard on a bundle's bounds: each is u1000, with one change.
///   copies       every sphere is there three times
///   near-copies  two of the three moved by an ulp along z, to either side
///   far          4e6 radii away
///   shifted      1e5 from the origin
///   ground       on a ground sphere of radius 1e6
///   inside       the eye within a sphere, and within the cloud
std::vector<std::string> hard_scene_names();

/// None if there is no such scene.
std::optional<BenchScene> make_hard_scene(const std::string& name, BenchScene u1000);

}  // namespace boule::bench
