// A ray's hit does not depend on its neighbours in a packet, on dead lanes, or on the order of rays
// and spheres.
#include <algorithm>
#include <limits>
#include <numeric>

#include "tests/support/case_random.h"
#include "tests/support/hard_cases.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

constexpr Form forms[] = {Form::automatic, Form::packet, Form::single, Form::flight, Form::set};

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  CaseRandom random(seed);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) {
    const auto j = static_cast<std::size_t>(random.below(static_cast<int>(i)));
    std::swap(order[i - 1], order[j]);
  }
  return order;
}

class LaneIndependence : public OnEachIsa {
 protected:
  /// Nearest hits for every form and both solvers; calls check(hits, solver) with each.
  template <class Check>
  void for_all_queries(const HardCase& scene, const std::vector<Ray>& rays, const Check& check) {
    const Geometry geometry(scene.spheres, scene.planes);
    for (const Solver solver : {Solver::fast, Solver::robust}) {
      for (const Form form : forms) {
        check(run_closest(*kernels, geometry.view(), rays, {solver, form, Coherence::none}),
              solver);
      }
    }
  }
  /// What the kernels say of one ray alone.
  Hit alone(const HardCase& scene, const Ray& ray, Solver solver) const {
    const Geometry geometry(scene.spheres, scene.planes);
    return run_closest(*kernels, geometry.view(), {ray},
                       {solver, Form::single, Coherence::none})[0];
  }

  HardCase hard_case = make_hard_case({"L", 0}, 37, 80);
};

TEST_P(LaneIndependence, AnswersDoNotDependOnStreamLength) {
  for (std::size_t count = 0; count <= 35; ++count) {
    const std::vector<Ray> rays(hard_case.rays.begin(),
                                hard_case.rays.begin() + static_cast<std::ptrdiff_t>(count));
    for_all_queries(hard_case, rays, [&](const std::vector<Hit>& hits, Solver solver) {
      ASSERT_EQ(hits.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_TRUE(same_bits(hits[i], alone(hard_case, rays[i], solver))) << count << " " << i;
      }
    });
  }
}

TEST_P(LaneIndependence, NothingBeyondTheStreamIsWritten) {
  const Geometry geometry(hard_case.spheres, hard_case.planes);
  for (std::size_t count = 1; count <= 35; ++count) {
    RayBuffer stream = to_stream(
        {hard_case.rays.begin(), hard_case.rays.begin() + static_cast<std::ptrdiff_t>(count)});
    AlignedArray<std::uint8_t> occluded(64, 77);
    HitBuffer hits(64);
    HitStream view = hits.view();
    for (std::size_t i = 0; i < 64; ++i) view.id[i] = 77;
    for (const Form form : forms) {
      const Query query{Solver::robust, form, Coherence::none};
      kernels->any_hit(geometry.view(), stream.view(), query, occluded.data());
      kernels->closest_hit(geometry.view(), stream.view(), query, view);
    }
    for (std::size_t i = count; i < 64; ++i) {
      ASSERT_EQ(occluded[i], 77) << count;
      ASSERT_EQ(view.id[i], 77) << count;
    }
  }
}

TEST_P(LaneIndependence, PermutedRaysGiveThePermutedAnswers) {
  const auto order = shuffled(hard_case.rays.size(), 5);
  std::vector<Ray> rays;
  for (const std::size_t i : order) rays.push_back(hard_case.rays[i]);
  for_all_queries(hard_case, rays, [&](const std::vector<Hit>& hits, Solver solver) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_TRUE(same_bits(hits[i], alone(hard_case, rays[i], solver))) << i;
    }
  });
}

TEST_P(LaneIndependence, HostileNeighboursChangeNothing) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  std::vector<Ray> rays = hard_case.rays;
  for (std::size_t i = 0; i < rays.size(); i += 3) {
    rays[i].dir = std::vector<Vec3f>{{nan, 0, 1}, {0, 0, 0}, {inf, 1, 0}}[i % 9 / 3];
    if (i % 2 == 0) rays[i].org.x = double{nan};
  }
  for_all_queries(hard_case, rays, [&](const std::vector<Hit>& hits, Solver solver) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (i % 3 == 0) {
        ASSERT_EQ(hits[i].id, no_primitive) << i;
      } else {
        ASSERT_TRUE(same_bits(hits[i], alone(hard_case, rays[i], solver))) << i;
      }
    }
  });
}

TEST_P(LaneIndependence, PermutedSpheresChangeIdsOnly) {
  HardCase ordered = make_hard_case({"S0"}, 37, 200);
  const auto order = shuffled(ordered.spheres.size(), 9);
  HardCase permuted = ordered;
  for (std::size_t i = 0; i < order.size(); ++i) permuted.spheres[i] = ordered.spheres[order[i]];
  const Geometry a(ordered.spheres, {}), b(permuted.spheres, {});
  for (const Form form : forms) {
    const Query query{Solver::robust, form, Coherence::none};
    const auto before = run_closest(*kernels, a.view(), ordered.rays, query);
    const auto after = run_closest(*kernels, b.view(), ordered.rays, query);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const std::int32_t id =
          after[i].id < 0 ? -1
                          : static_cast<std::int32_t>(order[static_cast<std::size_t>(after[i].id)]);
      ASSERT_TRUE(same_bits(before[i], {after[i].t, id})) << i;
    }
  }
}

TEST_P(LaneIndependence, EqualDistancesGoToTheLowerId) {
  HardCase copies;
  for (int i = 0; i < 300; ++i) copies.spheres.push_back({{0, 0, -5}, i < 7 ? 0.5F : 1.0F, 0});
  for (int i = 0; i < 20; ++i) copies.planes.push_back({{0, 0, -4}, {0, 0, 1}, 0});
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  for_all_queries(copies, std::vector<Ray>(19, ray), [](const std::vector<Hit>& hits, Solver) {
    for (const Hit& hit : hits) {
      EXPECT_EQ(hit.t, 4);
      EXPECT_EQ(hit.id, 7);
    }
  });
  copies.spheres.clear();
  for_all_queries(copies, std::vector<Ray>(19, ray), [](const std::vector<Hit>& hits, Solver) {
    for (const Hit& hit : hits) EXPECT_EQ(hit.id, 0);
  });
}

TEST_P(LaneIndependence, AnEmptySceneIsMissed) {
  for_all_queries({}, hard_case.rays, [](const std::vector<Hit>& hits, Solver) {
    for (const Hit& hit : hits) {
      EXPECT_EQ(hit.id, no_primitive);
      EXPECT_EQ(hit.t, std::numeric_limits<double>::infinity());
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Tables, LaneIndependence, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
