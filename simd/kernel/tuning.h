#pragma once

#include <cstddef>

#include "simd/lanes/lanes.h"

/// The numbers of the kernels that were chosen for speed. Change them as you like: the hits stay
/// the same. (Bounds that hits depend on are in simd/abi/filter_bounds.h; the numbers of the
/// builders in simd/geometry/tuning.h.)
///
/// Each says what was measured and the command that measures it again; "set by trial" means that
/// the number won when it was chosen and that no figure was kept. The benchmarks are built with
/// -DBOULE_BENCH=ON. A figure of one run means little: build twice, run both programs in turn, and
/// compare medians. `bench_peers --json` writes its figures to a file, and `valgrind
/// --tool=callgrind` counts instructions of bench_trace or boule, which repeat without trials.
namespace boule::BOULE_KERNEL_ISA::tuning {

// ---- Scans: search/scan.h -------------------------------------------------------------------

/// Spheres whose survivors are listed before the first of them is solved: for nearest hits, and for
/// any hit, which may be over after the first one. With the hot loop's present form 1024 brought
/// the robust scan, against half-b in float at the same width, from 0.92 to 0.98 (sse42), 0.92 to
/// 0.97 (avx2) and 1.01 to 1.04 (avx512). Again: bench_intersect --benchmark_filter=sparse
inline constexpr std::size_t nearest_chunk = 1024, any_chunk = 64;

/// More spheres than this are asked by reach box, sixteen at a time, which of them short rays that
/// look for any hit reach, and only those are tested. Ambient rays by avx512, Mray/s without and
/// with: u4 178, 151; u10 101, 143; u16 77, 172; u32 48, 156; u64 31, 130.
/// Again: bench_peers --size 512 --scenes u4,u10,u32 --rays ambient
inline constexpr std::size_t most_unasked = 8;

// ---- Packets: packets.cpp, search/traverse.h, beam.h --------------------------------------

/// The rays at the end of a stream go one by one where they are no more than this. Set by trial.
/// Again: bench_peers --scenes u1000 --rays mirror, whose streams end anywhere
inline constexpr std::size_t most_single_rays = width / 2;

/// A packet is fetched into the cache so many rays before it is used. Set by trial.
/// Again: bench_peers --scenes u1000,flake4 --rays mirror,diffuse
inline constexpr std::size_t prefetch_distance = 4 * static_cast<std::size_t>(width);

/// Rays whose direction along an axis is smaller than this, of unit length, form no beam along it:
/// the intervals of where they meet its planes would be too wide. Set by trial.
/// Again: bench_peers --scenes u1000,flake4 --rays mirror
inline constexpr float least_beam_slope = 0x1p-20F;

/// Short rays of which any hit will do visit so many children of a node, or fewer, that their reach
/// box meets, without a test of the children's boxes; in a tree of one node all of them. Ambient
/// rays, Mray/s by avx512 with no, 2, 4 and 16 untested: u100 84, 93, 99, 101 (so many in a tree of
/// one node), u1000 47, 50, 50, 51, flake4 29.5, 29.9, 27.5, 19.6, u10000 22.9, 22.6, 19.3, 14.5.
/// Again: bench_peers --size 512 --scenes u100,u1000,flake4,u10000 --rays ambient
inline constexpr int most_untested = 2;

/// So few of these rays, or fewer, are tested one by one before their reach box is. Ambient rays as
/// packets with none, one and two, by avx2, Mray/s: u10000 12.7, 13.3, 14.6; protein50000 11.7,
/// 11.7, 12.6; grains200000 5.7, 5.6, 6.2; four are as good as two. Not with one lane, where each
/// ray is always alone.
/// Again: bench_peers --size 512 --scenes u10000,protein50000,grains200000 --rays ambient
inline constexpr int most_rays_alone = width == 1 ? 0 : 2;

/// Two packets of them share their visits where the box that holds all they reach has no more than
/// so many times the sides of either one's. Ambient rays as packets, Mray/s, each alone and two
/// together: by avx512 u100 104, 113; u10000 22.3, 23.8; protein50000 19.4, 20.1; u100000 and
/// grains200000 the same within 2 %; by avx2 u1000 29.6, 31.6; protein50000 13.0, 13.8. With 1.2
/// and 2.5 both lose 2 to 4 % on u100000 or grains200000.
/// Again: bench_peers --size 512 --scenes u100,u10000,protein50000,u100000 --rays ambient
inline constexpr float most_shared_growth = 1.5F;

/// With more leaves than this a tree counts as far away and what a visit will read is fetched
/// ahead: a leaf and its share of the nodes take 400 bytes, and 640 of them a quarter of a MiB, a
/// good part of a second-level cache. Set by trial.
/// Again: bench_peers --scenes u1000,u10000,u100000 --rays diffuse
inline constexpr std::size_t most_near_blocks = 640;

// ---- Bundles: search/bundle_*.h ---------------------------------------------------------------

/// Rays of a bundle, at most: 32 x 32 pixels of a stream in Morton order. The first prototype had
/// 8 x 8 and 16 x 16; the smaller ones had 0.55 to 0.95 of the larger ones' speed. 32 x 32 was set
/// by trial.
/// Again: bench_peers --scenes u1000,u10000,flake4 --rays primary,shadow
inline constexpr int bundle_size = 1024;

/// A bundle's rays are tested in so many groups: of 1024 rays, 32 in each. Set by trial.
/// Again: as bundle_size
inline constexpr int bundle_groups = 32;

/// Fewer rays go as packets. Set by trial.
/// Again: bench_peers --scenes flake4,flake6 --rays shadow
inline constexpr std::size_t fewest_bundle_rays = 32;

/// Lines that miss their common end by more than this share of their length make a poor bundle: its
/// bounds would hold but turn little away. Set by trial.
/// Again: bench_peers --scenes u1000,flake4 --rays shadow
inline constexpr float farthest_end = 0x1p-10F;

/// A disc is compared ray by ray, not packet by packet, where it lies within at most so many groups
/// and, in them, at most so many rays: at first, and once a bundle is known to be sparse, that is,
/// to have many spheres for its rays. Together with the grid of the next lines, any hit by avx2 in
/// streams of 16,384 rays: 1.45 to 2.7 Mray/s on u1000000, 4.3 to 6.4 on flake6, other scenes
/// within 2 %. Again: bench_peers --scenes u1000000,flake6 --rays shadow
struct Few {
  int groups, rays;
};
inline constexpr Few few_at_first = width < 16 ? Few{6, 24} : Few{8, 32};
inline constexpr Few few_if_sparse = width < 16 ? Few{10, 48} : Few{12, 64};

/// The grid of a bundle's rays has so many cells along each side, and for each square of so many
/// cells along a side keeps where rays end. A bundle is sparse, and its grid is filled, once it has
/// visited a leaf for so many of its rays. Set by trial.
/// Again: as few_if_sparse
inline constexpr int grid_side = 32, grid_coarse = 4;
inline constexpr std::size_t rays_per_leaf_if_sparse = 8;

/// A sparse bundle of nearest hits compares boxes with its groups, one by one. Where that turned
/// away less than a quarter of them it is left out for 1, 3, 7 and at last so many nodes. Primary
/// rays gained 1.04 to 1.08 of their speed by the comparison on flake6 and slab2000000, 512 x 512
/// pixels; without pauses 1.06 to 1.15, but u1000000 lost 3 to 4 %.
/// Again: bench_peers --size 512 --scenes flake6,slab2000000,u1000000 --rays primary,orthographic
inline constexpr int most_nodes_paused = 15;

/// A sparse bundle is given up, and its rays go as sets, where a leaf is for fewer of them than
/// this, on average. Measured when they flew. Flights divided by bundles, nearest hits, by rays of
/// a leaf: 4 and more below 2 (ring1000000 at 512 x 512, flake6 at 128 x 128), 1.4 to 2.5 between 4
/// and 10 (flake6 and slab2000000 at 256 x 256), 0.4 to 0.9 between 8 and 32 (flake6, slab2000000
/// at 512 x 512), below 0.2 from 32 on (dust: u1000000 with a tenth of its radii). Any hit: of
/// sorted rays more are near a leaf than chance would have, and 2 was already worse than 1 on
/// flake6 and ground100000 (0.79 and 0.94, AVX2). Again: bench_peers --size 512 --scenes
/// ring1000000,flake6,slab2000000,ground100000 --rays primary,orthographic,shadow
template <bool any>
inline constexpr float fewest_rays_of_a_leaf = any ? 1.0F : 8.0F;
/// That is judged once a bundle, since it is sparse, has seen a leaf for so many of its rays. With
/// half as many leaves flake6 lost its gain.
inline constexpr std::size_t rays_per_leaf_judged = 16;

/// A bundle is given up after so many double solves for each of its packets, on average, because
/// packets would be no slower. Shadow rays amid specks that are 8.7e6 of their radii from their
/// light: 0.16 Mray/s without this, 4.5 with it.
/// Again: bench_errors, and bench_peers --scenes flake6 --rays shadow
inline constexpr int most_unclear = 2;

/// Shadow rays are taken in the order of the stream until a bundle of them needs more than one leaf
/// for so many rays; from there on they are sorted. Set by trial.
/// Again: bench_peers --scenes u10000,u100000 --rays shadow
inline constexpr std::size_t rays_per_leaf_in_order = 12;

/// What a ray costs that looks for any hit, in a unit of its own: in a packet so much for each node
/// and leaf that the packet visits, and so much besides; in a set so much for each node and leaf
/// that it is tested against, for each that the set visits, and besides. Fitted to light and
/// ambient rays of eight scenes (u100, u1000, u100000, protein50000, flake4, flake6, ground100000,
/// grains200000) on an Intel Xeon; a Zen 4 is as well served. The numbers of four lanes are those
/// of eight. Again: bench_peers --isa avx512 avx2 --scenes (those) --rays light ambient, beside the
/// forms packet and set
struct CostOfRay {
  float packet_visit, packet;
  float set_step, set_visit, set;
};
inline constexpr CostOfRay cost_of_ray = width < 16 ? CostOfRay{3.74F, 0.82F, 0.45F, 1.42F, 2.56F}
                                                    : CostOfRay{8.7F, 0.53F, 0.45F, 8.2F, 3.74F};

/// Then some rays show what all would cost as packets and as sets, if there are at least so many
/// rays: so many packets, far from each other, and so many sets of set_on_trial rays, since a set
/// of fewer shares few visits. Packets are tried with sixteen lanes only: with eight they were at
/// best 1.12 times as fast as what else there is (ground100000). Again: bench_peers --size 512
/// --rays shadow with the scenes of the next lines
inline constexpr std::size_t fewest_rays_judged = bundle_size;
inline constexpr std::size_t packets_on_trial = 8, sets_on_trial = 2, set_on_trial = 128;

/// What a sorted ray costs, in the unit of cost_of_ray: at least so much, and so much more
/// for each of the tree's nodes, divided by the rays, or by fewest_rays_a_node, since a bundle of
/// few rays meets hardly more leaves than one of many; in a bundle so much for each leaf that the
/// bundle visits, divided by its rays, and so much besides. Fitted to times and counts of shadow
/// rays of the 13 scenes of docs/performance.md, 512 x 512, on a Zen 4. There a leaf takes a bundle
/// 660 to 1050 cycles with avx512 and 720 to 1230 with avx2, more among few spheres; sorting takes
/// 10 to 20 cycles a ray; and the unit is 15 to 23 cycles with avx512, 26 to 55 with avx2. Cycles a
/// ray as packets, as a set, sorted, avx512: flake6 260, 203, 311; slab2000000 406, 249, 451;
/// ground100000 77, 94, 104; protein500000 171, 234, 171; grains200000 499, 391, 351; u1000000
/// 1202, 561, 633; u100000 409, 335, 191; avx2: flake6 357, 237, 375; slab2000000 533, 298, 520;
/// u1000000 1677, 849, 726. Again: as fewest_rays_judged
inline constexpr float sorted_ray = width < 16 ? 0.7F : 1.3F;
inline constexpr float sorted_ray_a_node = width < 16 ? 49 : 95;
inline constexpr std::size_t fewest_rays_a_node = 16384;
inline constexpr float bundled_ray = width < 16 ? 0.3F : 0.6F;
inline constexpr float bundled_leaf = width < 16 ? 24 : 48;

/// Sets are tried only where a sorted ray costs at least so many times what a ray of a set costs
/// that visits nothing: a trial takes 1 to 5 % of what sorted rays cost.
inline constexpr float least_sorted_beside_set = 1.5F;

// ---- Sorted shadow rays: search/ray_pool.h, light_grid.h --------------------------------------

/// Rays that are sorted together, at most. A stack frame holds them: 1.5 MiB. Set by trial, with
/// fitting_stream_size() in simd/abi/stream.h.
/// Again: bench_peers --scenes u100000,u1000000,flake6 --rays shadow
inline constexpr std::size_t pool_size = 65536;

/// Cells along a side of the square that rays are sorted into, for a pool of so many rays. Set by
/// trial.
/// Again: as pool_size
constexpr int light_grid_side(std::size_t rays) { return rays < 1024 ? 16 : rays < 4096 ? 32 : 64; }
inline constexpr unsigned most_light_cells =
    light_grid_side(pool_size) * light_grid_side(pool_size);

/// Rays that are read, and then sorted into cells, at a time; the square is fitted to each packet
/// that starts at a multiple of this; it faces the mean of so many directions. Set by trial.
/// Again: as pool_size
inline constexpr std::size_t pool_chunk = 128;
inline constexpr std::size_t light_samples = 32;

// ---- Flights: search/flight*.h ----------------------------------------------------------------

/// Rays in flight: in a near tree (most_near_blocks), whose memory need not be waited for but whose
/// rounds want to be full, and in a far one. In the first prototype 16 rays instead of one
/// gave 1.25 on small and 1.5 to 1.7 on large scenes, and 8 most of that; these were set by trial.
/// Again: bench_peers --scenes u1000,u100000,u1000000 --rays diffuse
inline constexpr std::size_t flights_nearby = 24, most_flights = 32;

/// Steps that are taken together, at most. Set by trial.
/// Again: bench_peers --scenes u1000,u10000,flake4 --rays diffuse,light
inline constexpr std::size_t steps_together = 12;

/// Children that wait for a ray are kept in order up to this number; of more the last one is taken.
/// Set by trial; a ray seldom has more.
/// Again: bench_peers --scenes flake6,u1000000 --rays diffuse
inline constexpr std::size_t most_sorted_children = 48;

/// A ray with more candidates than this has them solved at once. Set by trial; ordinary rays have
/// one or two.
/// Again: bench_errors, and bench_peers --scenes u1000 --rays diffuse
inline constexpr unsigned most_candidates = 8;

// ---- Sets: search/ray_sets.h --------------------------------------------------------------------

/// Rays of a set, at most. Sets of 64, 256 and 512, avx512, Mray/s: short rays on u100000 13.1,
/// 15.9, 16.4, on u1000 -, 30.4, 28.7; diffuse ones on u100000 -, 5.3, 5.7, on protein50000
/// -, 11.4, 11.1. The lists of 512 take 1.5 MiB of a stack, those of 256 half of that. Again:
/// bench_peers --size 512 --scenes u1000,u100000,protein50000 --rays ambient,diffuse, beside the
/// form set
inline constexpr std::size_t set_size = 256;

// ---- The choice between sets, packets and flights: scattered.cpp -----------------------------

/// Rays that are traced each way to see which is the fastest one: as a set, as packets, in flight.
/// Of a set a whole one, since a small one shares few visits. And rays that then go that way: at
/// first, and at most, because their number grows while trials agree. Of earlier trials so much
/// still counts. Trials may be interrupted: one counts at most so many times what those before it
/// took, and they are forgotten where they took so many times what it took. The automatic choice
/// beside the fastest form, means of mirrored, diffuse and ambient rays and chords on flake4, u1000
/// and protein50000, both instruction sets, Zen 4: by counts of visits, each stream for itself
/// 0.941, with what earlier streams know 0.960; by time, 64 rays as packets and at most 32 times as
/// many afterwards 0.965 (ambient 0.89, the others 0.99), 128 and 8 times 0.959, 256 and 16 times
/// 0.970 (ambient 0.98, the others 0.97). Again: bench_peers --scenes u1000,flake4,protein50000
/// --rays mirror,diffuse,ambient,chord, beside the other forms; the last two numbers by trial
template <bool any>
inline constexpr std::size_t rays_on_trial[] = {set_size, any ? 256 : 64, 128};
inline constexpr std::size_t rays_after_trial = 1984, most_after_trial = 16 * rays_after_trial;
inline constexpr std::size_t growth_while_agreed = 4;
inline constexpr float share_of_earlier_trials = 0.75F;
inline constexpr float most_growth_of_cost = 16, most_fall_of_cost = 4;

/// Where a set makes more than so many steps in a visit, flights are not tried: they gain only
/// where rays share few visits. By avx512 they had 1.8 times the speed of sets for chords on
/// u100000 (1.9 steps a visit), 1.08 on u1000 (18), 1.04 on u100 (95), and less than sets for
/// mirrored and diffuse rays (3 to 183) but those mirrored on u100000 and grains200000 (1.02
/// to 1.04). Again: bench_peers --scenes u100,u1000,u100000 --rays chord, beside the forms flight
/// and set
inline constexpr std::size_t steps_of_shared_visit = 24;

/// Where one way took more than so many times what the other took, the next rays are as many as can
/// be. Without it u100's mirrored rays lost 5 %.
/// Again: bench_peers --scenes u100 --rays mirror, beside its form packet
inline constexpr float clearly_more = 2;

/// A way that rays do not go must take so many times less before they go that way; sets come first.
/// For any hit two ways often take about as long, and the first trial meets caches that hold
/// nothing of the tree yet. Again: bench_peers --isa avx2 --size 512 --scenes
/// ring1000000,grains200000 --rays ambient
template <bool any>
inline constexpr float gain_to_change = any ? 1.15F : 1.0F;

// ---- Path tracing: shading/path_step.h --------------------------------------------------------

/// Up to so many lights are compared with every packet's numbers; of more each lane looks up its
/// own. Set by trial.
/// Again: bench_path scenes/soft_light.toml
inline constexpr std::size_t most_compared_lights = 6;

}  // namespace boule::BOULE_KERNEL_ISA::tuning
