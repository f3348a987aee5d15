#pragma once

#include <cstddef>

#include "simd/lanes/lanes.h"

/// The numbers of the kernels that were chosen for speed. You may change them: the hits stay the
/// same. (The bounds that hits depend on are in simd/abi/filter_bounds.h; the numbers of the
/// builders are in simd/geometry/tuning.h.)
///
/// Each comment gives the measurement and the command that repeats it. "Set by trial" means that
/// the number was the fastest of those tried and that the figures were discarded. The benchmarks
/// are built with -DBOULE_BENCH=ON. A figure of one run means little: build twice, run both
/// programs in turn, and compare medians. `bench_peers --json` writes its figures to a file.
/// `valgrind --tool=callgrind` counts instructions of bench_trace or boule, which repeat without
/// trials.
namespace boule::BOULE_KERNEL_ISA::tuning {

// ---- Scans: search/leaf/scan.h
// -------------------------------------------------------------------

/// The number of spheres whose survivors of the reject are listed before the first of them is
/// solved: for nearest hits, and for any hit, where the first one may end the search. With the hot
/// loop's present form, 1024 brought the robust scan, against half-b in float at the same width,
/// from 0.92 to 0.98 (sse42), 0.92 to 0.97 (avx2) and 1.01 to 1.04 (avx512). Again: bench_intersect
/// --benchmark_filter=sparse
inline constexpr std::size_t nearest_chunk = 1024, any_chunk = 64;

/// With more spheres than this, a reach box first selects, sixteen at a time, the spheres that
/// short rays of any_hit can reach, and only those are tested. Ambient rays by avx512, Mray/s
/// without and with: u4 178, 151; u10 101, 143; u16 77, 172; u32 48, 156; u64 31, 130. Again:
/// bench_peers --size 512 --scenes u4,u10,u32 --rays ambient
inline constexpr std::size_t most_unasked = 8;

// ---- Packets: packets.cpp, search/packet/traverse.h, beam.h
// --------------------------------------

/// Up to this many rays at the end of a stream are traced one by one. Set by trial. Again:
/// bench_peers --scenes u1000 --rays mirror, whose streams end anywhere
inline constexpr std::size_t most_single_rays = width / 2;

/// A packet is prefetched into the cache this many rays before its use. Set by trial. Again:
/// bench_peers --scenes u1000,flake4 --rays mirror,diffuse
inline constexpr std::size_t prefetch_distance = 4 * static_cast<std::size_t>(width);

/// Rays whose unit direction has a smaller component than this along an axis form no beam along it:
/// the intervals in which they cross its planes would be too wide. Set by trial. Again: bench_peers
/// --scenes u1000,flake4 --rays mirror
inline constexpr float least_beam_slope = 0x1p-20F;

/// If the reach box of short any-hit rays meets at most this many children of a node, the rays
/// visit them without a test of the children's boxes. In a tree of one node they visit all. Ambient
/// rays, Mray/s by avx512 with 0, 2, 4 and 16 untested: u100 84, 93, 99, 101 (a tree of one node),
/// u1000 47, 50, 50, 51, flake4 29.5, 29.9, 27.5, 19.6, u10000 22.9, 22.6, 19.3, 14.5. Again:
/// bench_peers --size 512 --scenes u100,u1000,flake4,u10000 --rays ambient
inline constexpr int most_untested = 2;

/// Up to this many of these rays are tested one by one before their reach box is. Ambient rays as
/// packets with zero, one and two, by avx2, Mray/s: u10000 12.7, 13.3, 14.6; protein50000 11.7,
/// 11.7, 12.6; grains200000 5.7, 5.6, 6.2; four are as good as two. With one lane the number is 0,
/// because each ray is alone anyway. Again: bench_peers --size 512 --scenes
/// u10000,protein50000,grains200000 --rays ambient
inline constexpr int most_rays_alone = width == 1 ? 0 : 2;

/// Two packets of such rays share their visits if the sides of the box around both reach boxes are
/// at most this many times the sides of either one. Ambient rays as packets, Mray/s, each alone and
/// two together: by avx512 u100 104, 113; u10000 22.3, 23.8; protein50000 19.4, 20.1; u100000 and
/// grains200000 the same within 2 %; by avx2 u1000 29.6, 31.6; protein50000 13.0, 13.8. With 1.2,
/// and with 2.5, u100000 or grains200000 loses 2 to 4 %. Again: bench_peers --size 512 --scenes
/// u100,u10000,protein50000,u100000 --rays ambient
inline constexpr float most_shared_growth = 1.5F;

/// A tree with more leaves than this counts as far away, and the kernel prefetches the data of each
/// visit. A leaf and its share of the nodes take 400 bytes, so 640 of them take a quarter of a MiB,
/// a good part of a second-level cache. Set by trial. Again: bench_peers --scenes
/// u1000,u10000,u100000 --rays diffuse
inline constexpr std::size_t most_near_blocks = 640;

// ---- Capsules: capsules.cpp, search/packet/capsules_near.h ------------------------------------

/// The number of rays that are held against a few capsules together: 8 x 8 pixels of a stream in
/// Morton order. Again: bench_trace --benchmark_filter=bundle/.*/1000000
inline constexpr std::size_t capsule_group = 64;

/// Up to this many capsules near a group are tested by its packets without a search. Again: as
/// capsule_group
inline constexpr int most_capsules_alone = 4;

// ---- Bundles: search/bundle_*.h ---------------------------------------------------------------

/// The largest number of rays in a bundle: 32 x 32 pixels of a stream in Morton order. The first
/// prototype had 8 x 8 and 16 x 16; the smaller bundles had 0.55 to 0.95 of the larger ones' speed.
/// 32 x 32 was set by trial. Again: bench_peers --scenes u1000,u10000,flake4 --rays primary,shadow
inline constexpr int bundle_size = 1024;

/// The number of groups in which a bundle's rays are tested: of 1024 rays, 32 in each. Set by
/// trial. Again: as bundle_size
inline constexpr int bundle_groups = 32;

/// Fewer rays are traced as packets. Set by trial. Again: bench_peers --scenes flake4,flake6 --rays
/// shadow
inline constexpr std::size_t fewest_bundle_rays = 32;

/// If rays miss their common end by more than this fraction of their length, they are not bundled:
/// the bounds would be valid but too loose to reject much. Set by trial. Again: bench_peers
/// --scenes u1000,flake4 --rays shadow
inline constexpr float farthest_end = 0x1p-10F;

/// A disc is compared ray by ray, rather than packet by packet, if it lies within at most this many
/// groups and, in them, at most this many rays: at first, and once a bundle is known to be sparse,
/// that is, to have many spheres per ray. Together with the grid below, any hit by avx2 in streams
/// of 16,384 rays: 1.45 to 2.7 Mray/s on u1000000, 4.3 to 6.4 on flake6, other scenes within 2 %.
/// Again: bench_peers --scenes u1000000,flake6 --rays shadow
struct Few {
  int groups, rays;
};
inline constexpr Few few_at_first = width < 16 ? Few{6, 24} : Few{8, 32};
inline constexpr Few few_if_sparse = width < 16 ? Few{10, 48} : Few{12, 64};

/// The number of cells along each side of the grid of a bundle's rays, and the number of cells
/// along each side of the squares for which the grid keeps the ends of rays. A bundle is sparse,
/// and its grid is filled, once it has visited one leaf per rays_per_leaf_if_sparse of its rays.
/// Set by trial. Again: as few_if_sparse
inline constexpr int grid_side = 32, grid_coarse = 4;
inline constexpr std::size_t rays_per_leaf_if_sparse = 8;

/// A sparse bundle of nearest hits compares boxes with its groups, one by one. After a node where
/// that rejects less than a quarter of the boxes, the comparison pauses for 1, 3, 7 and finally
/// this many nodes. Primary rays gained 1.04 to 1.08 of their speed by the comparison on flake6 and
/// slab2000000, 512 x 512 pixels; without pauses 1.06 to 1.15, but u1000000 lost 3 to 4 %. Again:
/// bench_peers --size 512 --scenes flake6,slab2000000,u1000000 --rays primary,orthographic
inline constexpr int most_nodes_paused = 15;

/// A sparse bundle is given up, and its rays are traced as sets, if a leaf serves fewer of its rays
/// than this on average. Measured when the rays went in flight. Speed of flights over that of
/// bundles, nearest hits, by rays per leaf: 4 and more below 2 (ring1000000 at 512 x 512, flake6 at
/// 128 x 128), 1.4 to 2.5 between 4 and 10 (flake6 and slab2000000 at 256 x 256), 0.4 to 0.9
/// between 8 and 32 (flake6, slab2000000 at 512 x 512), below 0.2 from 32 on (dust: u1000000 with a
/// tenth of its radii). Any hit: sorted rays are nearer to a leaf than random ones, and 2 was
/// already worse than 1 on flake6 and ground100000 (0.79 and 0.94, AVX2). Again: bench_peers --size
/// 512 --scenes ring1000000,flake6,slab2000000,ground100000 --rays primary,orthographic,shadow
template <bool any>
inline constexpr float fewest_rays_of_a_leaf = any ? 1.0F : 8.0F;
/// That decision is made once a bundle, since it became sparse, has visited one leaf per this many
/// of its rays. With half as many leaves, flake6 lost its gain.
inline constexpr std::size_t rays_per_leaf_judged = 16;

/// A bundle is given up after this many double solves per packet on average, because packets would
/// be as fast. Shadow rays amid specks that are 8.7e6 of their radii from their light: 0.16 Mray/s
/// without this, 4.5 with it. Again: bench_errors, and bench_peers --scenes flake6 --rays shadow
inline constexpr int most_unclear = 2;

/// Shadow rays are traced in the order of the stream until a bundle needs more than one leaf per
/// this many rays; from then on they are sorted. Set by trial. Again: bench_peers --scenes
/// u10000,u100000 --rays shadow
inline constexpr std::size_t rays_per_leaf_in_order = 12;

// ---- Sorted shadow rays: search/bundle/ray_pool.h, light_grid.h
// --------------------------------------

/// The largest number of rays that are sorted together. A stack frame holds them: 1.5 MiB. Set by
/// trial, with fitting_stream_size() in simd/abi/stream.h. Again: bench_peers --scenes
/// u100000,u1000000,flake6 --rays shadow
inline constexpr std::size_t pool_size = 65536;

/// The number of cells along a side of the square into which the rays of a pool are sorted. Set by
/// trial. Again: as pool_size
constexpr int light_grid_side(std::size_t rays) { return rays < 1024 ? 16 : rays < 4096 ? 32 : 64; }
inline constexpr unsigned most_light_cells =
    light_grid_side(pool_size) * light_grid_side(pool_size);

/// pool_chunk is the number of rays that are read, and then sorted into cells, at a time. The
/// square is fitted to the packets that start at multiples of pool_chunk, and it faces the mean of
/// light_samples directions. Set by trial. Again: as pool_size
inline constexpr std::size_t pool_chunk = 128;
inline constexpr std::size_t light_samples = 32;

// ---- Flights: search/flock/flight*.h
// ----------------------------------------------------------------

/// The number of rays in flight: in a near tree (most_near_blocks), where memory is fast but rounds
/// should be full, and in a far one. In the first prototype 16 rays instead of one gave 1.25 on
/// small and 1.5 to 1.7 on large scenes, and 8 most of that; these were set by trial. Again:
/// bench_peers --scenes u1000,u100000,u1000000 --rays diffuse
inline constexpr std::size_t flights_nearby = 24, most_flights = 32;

/// The largest number of steps that are taken together. Set by trial. Again: bench_peers --scenes
/// u1000,u10000,flake4 --rays diffuse,light
inline constexpr std::size_t steps_together = 12;

/// Up to this number, the children that a ray has yet to visit are kept in order; beyond it, the
/// last one is visited first. Set by trial; rays seldom have more. Again: bench_peers --scenes
/// flake6,u1000000 --rays diffuse
inline constexpr std::size_t most_sorted_children = 48;

/// A ray with more candidates than this has them solved at once. Set by trial; ordinary rays have
/// one or two. Again: bench_errors, and bench_peers --scenes u1000 --rays diffuse
inline constexpr unsigned most_candidates = 8;

// ---- Sets: search/flock/ray_sets.h
// --------------------------------------------------------------------

/// The largest number of rays in a set. Sets of 64, 256 and 512, avx512, Mray/s: short rays on
/// u100000 13.1, 15.9, 16.4, on u1000 -, 30.4, 28.7; diffuse ones on u100000 -, 5.3, 5.7, on
/// protein50000 -, 11.4, 11.1. The lists of 512 rays take 1.5 MiB of a stack, those of 256 half of
/// that. Again: bench_peers --size 512 --scenes u1000,u100000,protein50000 --rays ambient,diffuse,
/// beside the form set
inline constexpr std::size_t set_size = 256;

/// The largest number of rays that are sorted together by their directions, and the cells of
/// directions along each side of either half of an octahedron. Set by trial. Again: boule render
/// scenes/crambin.xyz --isa avx2
inline constexpr std::size_t sorted_rays = 1024, sorted_side = 8;

// ---- The choice between sets, packets, flights and sorted rays: scattered.cpp -----------------

/// The settings of trials. First, the numbers of rays that are traced each way to find the fastest:
/// as a set, as packets, in flight, sorted. A set on trial is a whole one, because a small one
/// shares few visits. Then, the number of rays that go the chosen way: at first, and at most; it
/// grows while trials agree. Then the weight of earlier trials. Trials may be interrupted: a trial
/// counts at most a given multiple of the earlier cost, and the earlier trials are forgotten if
/// they cost a given multiple of the new one. The automatic choice beside the fastest form, means
/// of mirrored, diffuse and ambient rays and chords on flake4, u1000 and protein50000, both
/// instruction sets, Zen 4: by counts of visits, each stream for itself 0.941, with the experience
/// of earlier streams 0.960; by time, 64 rays as packets and at most 32 times as many afterwards
/// 0.965 (ambient 0.89, the others 0.99), 128 and 8 times 0.959, 256 and 16 times 0.970 (ambient
/// 0.98, the others 0.97). Again: bench_peers --scenes u1000,flake4,protein50000 --rays
/// mirror,diffuse,ambient,chord, beside the other forms; the last two numbers by trial
template <bool any>
inline constexpr std::size_t rays_on_trial[] = {set_size, any ? 256 : 64, 128, sorted_rays / 2};
inline constexpr std::size_t least_after_trial = 1984, most_after_trial = 16 * least_after_trial;
inline constexpr std::size_t growth_while_agreed = 4;
inline constexpr float share_of_earlier_trials = 0.75F;
inline constexpr float most_growth_of_cost = 16, most_fall_of_cost = 4;

/// If a set makes more than this many steps per visit, the trial has sorted rays in place of
/// flights, which gain only where rays share few visits. By avx512, flights had 1.8 times the speed
/// of sets for chords on u100000 (1.9 steps a visit), 1.08 on u1000 (18), 1.04 on u100 (95). For
/// mirrored and diffuse rays (3 to 183) they were slower than sets, except for rays mirrored on
/// u100000 and grains200000 (1.02 to 1.04). Again: bench_peers --scenes u100,u1000,u100000 --rays
/// chord, beside the forms flight and set
inline constexpr std::size_t steps_of_shared_visit = 24;

/// If two trials agree, and in the second one way takes more than this many times as long as the
/// other, the next rays are as many as possible. Without it u100's mirrored rays lost 5 %. Again:
/// bench_peers --scenes u100 --rays mirror, beside its form packet
inline constexpr float clearly_more = 2;

/// Rays switch to another way only if it is faster by this factor; sets come first. For any hit,
/// two ways often take about as long, and the first trial runs before the caches hold any of the
/// tree. Again: bench_peers --isa avx2 --size 512 --scenes ring1000000,grains200000 --rays ambient
template <bool any>
inline constexpr float gain_to_change = any ? 1.15F : 1.0F;

// ---- The choice whether shadow rays are sorted: search/bundle/shadow_stream.h ----------------

/// The number of sorted bundles that a trial times, if there are as many. With fewer than two
/// bundles there is no trial, because an interruption could not be told from their cost. A trial
/// sorts no more rays than it must: of whole pools, slab2000000 lost 10 % of its speed by trials
/// instead of 4 %. Again: bench_peers --size 512 --scenes
/// u1000000,flake6,slab2000000,protein500000,grains200000 --rays shadow, beside the form set
inline constexpr std::size_t bundles_judged = 4;
inline constexpr std::size_t fewest_rays_judged = 2 * bundle_size;
inline constexpr std::size_t most_rays_judged = 16384;

/// Each of four samples of unsorted rays has one ray in 128, a multiple of W, and as many go before
/// it. Sets of fewer than 64 rays share few visits. With twice as many, grains200000 is 5 % slower.
/// Again: as bundles_judged
constexpr std::size_t rays_of_sample(std::size_t rays) {
  const std::size_t some = rays / 2048 * 16;
  return some < 64 ? 64 : some;
}

/// A part of a trial was interrupted if its units take more than this many times as long as those
/// of each other part. An interruption takes some milliseconds, a part 30 to 300 microseconds, and
/// a leaf of one bundle up to four times as long as a leaf of another one.
inline constexpr float interrupted = 8;

/// The least and the largest number of rays that rely on such a trial: at first the rest of a pool.
/// Another region of a picture may need the other way (protein500000).
inline constexpr std::size_t least_after_sorting = pool_size - most_rays_judged;
inline constexpr std::size_t most_after_sorting = 16 * pool_size;

// ---- Path tracing: shading/path_step.h --------------------------------------------------------

/// Up to this many lights are compared with every packet's numbers; with more lights, each lane
/// looks up its own. Set by trial. Again: bench_path scenes/soft_light.toml
inline constexpr std::size_t most_compared_lights = 6;

}  // namespace boule::BOULE_KERNEL_ISA::tuning
