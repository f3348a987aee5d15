// All chords of rays: every kernel table lists those of the scalar path, bit for bit.
#include <algorithm>
#include <tuple>

#include "tests/support/hard_case_runs.h"
#include "tests/support/placed_groups.h"

namespace boule::test::chords {
namespace {

struct Chord {
  std::uint64_t enter, leave;  ///< as bits
  std::int32_t id;

  auto operator<=>(const Chord&) const = default;
};

Chord chord_of(double enter, double leave, std::int32_t id) {
  return {std::bit_cast<std::uint64_t>(enter), std::bit_cast<std::uint64_t>(leave), id};
}

/// The chords of each ray, sorted. `capacity`: for how many there is room at first.
std::vector<std::vector<Chord>> run_chords(const KernelTable& kernels, const GeometryView& geometry,
                                           const std::vector<Ray>& rays, std::size_t capacity) {
  RayBuffer stream = to_stream(rays);
  std::vector<std::vector<Chord>> all;
  while (all.size() < rays.size()) {
    std::vector<double> enter(capacity), leave(capacity);
    std::vector<std::int32_t> id(capacity);
    std::vector<std::uint32_t> slot(capacity);
    std::vector<std::size_t> ends(rays.size());
    const std::size_t first = all.size();
    const std::size_t stop = kernels.find_chords(
        geometry, stream.view(), first,
        {enter.data(), leave.data(), id.data(), slot.data(), capacity}, ends.data());
    if (stop == first) capacity = 2 * capacity + 1;
    std::size_t at = 0;
    for (std::size_t i = first; i < stop; ++i) {
      all.emplace_back();
      for (; at < ends[i]; ++at) {
        EXPECT_TRUE(names_its_slot(geometry, {enter[at], id[at], slot[at]})) << "ray " << i;
        all[i].push_back(chord_of(enter[at], leave[at], id[at]));
      }
      std::sort(all[i].begin(), all[i].end());
    }
  }
  return all;
}

/// What the scalar path finds, every pair.
std::vector<std::vector<Chord>> reference_chords(const std::vector<Ray>& rays,
                                                 const std::vector<Sphere>& spheres,
                                                 const std::vector<Plane>& planes) {
  std::vector<std::vector<Chord>> all(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::int32_t id = 0;
    const auto add = [&](const auto& primitive) {
      const reference::Chord chord =
          reference::find_chord(rays[i], primitive, id == rays[i].source);
      if (overlaps(chord, rays[i], primitive))
        all[i].push_back(chord_of(chord.enter, chord.leave, id));
      ++id;
    };
    for (const Sphere& sphere : spheres) add(sphere);
    for (const Plane& plane : planes) add(plane);
    std::sort(all[i].begin(), all[i].end());
  }
  return all;
}

std::size_t count(const std::vector<std::vector<Chord>>& chords) {
  std::size_t sum = 0;
  for (const auto& of_ray : chords) sum += of_ray.size();
  return sum;
}

using Chords = OnEachHardCase;
TEST_P(Chords, AreThoseOfTheScalarPath) {
  const HardCase hard_case = make_hard_case(GetParam().spec, 61, 517);
  const auto expected = reference_chords(hard_case.rays, hard_case.spheres, hard_case.planes);
  EXPECT_GT(count(expected), hard_case.rays.size() / 10);
  for (const Structure structure : {Structure::scan, Structure::bvh}) {
    const Geometry geometry(hard_case.spheres, hard_case.planes, structure);
    ASSERT_TRUE(run_chords(*kernels, geometry.view(), hard_case.rays, 7) == expected);
    ASSERT_TRUE(run_chords(*kernels, geometry.view(), hard_case.rays, 100'000) == expected);
  }
}
INSTANTIATE_TEST_SUITE_P(Tables, Chords, each_hard_case(), hard_case_name);

class ChordsOfTrees : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Tables, ChordsOfTrees, each_isa(), isa_name);

std::vector<Ray> rays_through(CaseRandom& random, int count, double spread) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Ray ray{random_point(random, spread), vec_cast<float>(random.direction())};
    if (i % 3 == 1) ray.tmin = static_cast<float>(random.uniform(-1, 1) * spread);
    if (i % 4 == 1) ray.tmax = static_cast<float>(random.uniform(0, 2) * spread);
    rays.push_back(ray);
  }
  return rays;
}

TEST_P(ChordsOfTrees, OverlappingSpheresAreAllListed) {
  CaseRandom random(91);
  std::vector<Sphere> spheres = cube_of_spheres(random, 3000, {0, 0, 0}, 1, 0.3);
  for (int i = 0; i < 10; ++i) spheres.push_back(spheres[5]);  // coincident
  spheres.push_back({{0, 0, 0}, 5, 0});                        // around all others
  const std::vector<Plane> planes = {{{0, 0.5F, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 2, -3}}};
  const std::vector<Ray> rays = rays_through(random, 300, 2);
  const Geometry geometry(spheres, planes, Structure::bvh);
  const auto expected = reference_chords(rays, spheres, planes);
  EXPECT_GT(count(expected), 3'000U);
  EXPECT_TRUE(run_chords(*kernels, geometry.view(), rays, 1000) == expected);
}

TEST_P(ChordsOfTrees, PlacedGroupsHaveThoseWrittenOut) {
  CaseRandom random(92);
  PlacedGroups scene{"copies", {}, {}};
  scene.groups.push_back(cube_of_spheres(random, 200, {0, 0, 0}, 1, 0.2));
  scene.places.push_back({0, std::nullopt});
  for (int i = 0; i < 9; ++i) scene.places.push_back({0, random_placement(random, 0.5, 1.5)});
  const std::vector<Ray> rays = rays_through(random, 300, 2);
  const std::vector<Plane> planes = {{{0, 0.5F, 0}, {0, 1, 0}}};
  const Geometry geometry = scene.in_parts(planes, Structure::bvh);
  const auto expected = reference_chords(rays, scene.written_out(), planes);
  EXPECT_GT(count(expected), 500U);
  EXPECT_TRUE(run_chords(*kernels, geometry.view(), rays, 1000) == expected);
}

TEST(ReferenceTable, ListsTheChordsOfTheReferencePath) {
  CaseRandom random(93);
  const std::vector<Sphere> spheres = cube_of_spheres(random, 100, {0, 0, 0}, 1, 0.3);
  const std::vector<Ray> rays = rays_through(random, 100, 2);
  const Geometry geometry(spheres, {}, Structure::bvh);
  EXPECT_TRUE(run_chords(reference_kernels(), geometry.view(), rays, 3) ==
              reference_chords(rays, spheres, {}));
}

}  // namespace
}  // namespace boule::test::chords
