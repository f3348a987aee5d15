#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "bench/scenes/bench_scenes.h"

namespace boule::bench {

/// The length of an angstrom in the scene proteinN.
double protein_angstrom(std::size_t n);

/// Scenes of the kinds that people draw, each about 1 in size, N a number:
///   proteinN  N atoms that overlap, in a lumpy globule of 24 domains
///   groundN   N spheres side by side on a ground sphere of radius 100
///   grainsN   N grains, radii log-normal over four decades, covering a picture four times over
///   ringN     a thin flat ring of N spheres seen edge-on, from 1 degree above it
///   slabN     N spheres in a slab of 1 x 1 x 0.1, covering it four times over, seen obliquely
/// None if the name is not of these, or N not from 10 to 10,000,000.
std::optional<BenchScene> make_particle_scene(const std::string& name);

}  // namespace boule::bench
