#pragma once

#include <cstddef>

/// The numbers of the tree's builders that were chosen for speed. You may change them: the hits
/// stay the same. A number without figures was set by trial, and the command shows how good it is
/// (the benchmarks: -DBOULE_BENCH=ON).
namespace boule::tuning {

/// Structure::automatic scans up to this many spheres and builds a tree over more. Random spheres
/// that fill the view, the speed by a tree divided by that by a scan, avx512, 32, 48 and 64
/// spheres: primary rays 0.99, 0.95, 1.02; shadow 0.99, 0.99, 0.95; mirrored 0.84, 0.97, 1.08;
/// diffuse 1.09, 1.18, 1.26; light 0.83, 1.07, 1.28; ambient 0.90, 0.94, 0.96; chords 0.81, 0.85,
/// 0.87. By avx2 64 spheres have 1.03, 0.99, 1.01, 1.14, 1.12, 0.76, 0.88. Again, with another
/// number here: bench_peers --size 512 --scenes u32,u48,u64 --isa avx512 avx2
inline constexpr std::size_t most_scanned = 48;

/// The number of bins, along each axis, into which the surface area heuristic sorts centres. Set by
/// trial. Again: bench_tree (areas and visits), bench_build (time).
inline constexpr int bins = 16;

/// The cut of many spheres with similar radii is chosen by a sample of at least this many, and of
/// at least every most_stride-th sphere. Set by trial: twice as many levels of the tree for the
/// same time. Again: bench_tree (areas and visits), bench_build 10000000 (time)
inline constexpr std::size_t cut_sample = 4096;
inline constexpr std::size_t most_stride = 16;

/// Radii are a fourth axis for the bins if the largest is more than this many times the smallest:
/// few large spheres are better off on their own. Set by trial. Again: bench_peers --scenes
/// flake4,flake6 --rays primary,diffuse
inline constexpr float unlike_radii = 2;

/// A sphere is a giant if its box has more than this fraction of the area of the box around all the
/// others. Giants, at most most_giants and the largest first, are kept out of the tree and tested
/// against every ray, because nearly every ray would meet their boxes anyway. Set by trial. Again:
/// bench_tree, with a ground sphere added to its scene
inline constexpr double giant_share = 0.25;
inline constexpr std::size_t most_giants = 16;

/// The number of spheres that one thread reads, bins or moves at a time, and the number from which
/// on threads pay for that. Set by trial. Again: bench_build 10000 100000 1000000
inline constexpr std::size_t chunk_size = 16'384;
inline constexpr std::size_t parallel_size = 65'536;

/// A thread builds a whole subtree of at most this many spheres: a 2048th of all, which leaves
/// enough subtrees for many threads, but at least 4096. The tree's shape depends on these numbers,
/// and is the same for any number of threads. Set by trial. Again: bench_build 1000000 10000000
inline constexpr std::size_t least_subtree = 4096;
inline constexpr std::size_t most_subtrees = 2048;

/// A subtree below 1 / twigs of the largest size is a twig: it counts to the upper part.
/// Again: BvhVisits.DoublingDistancesAreNotScanned, and bench_tree
inline constexpr std::size_t twigs = 6;

/// The subtrees are built and become leaves in this many portions, so that the binary nodes of one
/// take half a percent of the memory. Portions are at least large enough for threads to share. Set
/// by trial. Again: bench_build 100000 1000000 10000000
inline constexpr std::size_t portions = 64;
inline constexpr std::size_t least_portion = 64;

/// A tree whose spheres have moved is built anew once its boxes have this many times the area that
/// they had when it was built. Set by trial. Again: bench_trace --benchmark_filter=moved
inline constexpr double worn_tree = 1.5;

}  // namespace boule::tuning
