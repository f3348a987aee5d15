// Every kernel table x form x closest/any hit x hard case against the scalar path, bit for bit.
#include "tests/support/hard_case_runs.h"

namespace boule::test {
namespace {

class Equivalence : public OnEachHardCase {
 protected:
  void SetUp() override {
    OnEachHardCase::SetUp();
    // 61 primitives and 517 rays: neither fills whole packets or chunks.
    hard_case = make_hard_case(GetParam().spec, 61, 517);
  }
  HardCase hard_case;
};

TEST_P(Equivalence, RobustEqualsTheScalarPath) {
  std::vector<Hit> expected;
  for (const Ray& ray : hard_case.rays)
    expected.push_back(reference::closest_hit(ray, hard_case.spheres, hard_case.planes));
  for (const Structure structure : {Structure::scan, Structure::bvh}) {
    const Geometry geometry(hard_case.spheres, hard_case.planes, structure);
    if (geometry.view().bvh.size > 0) {
      const auto sorted = run_sorted(*kernels, geometry.view(), hard_case.rays);
      for (std::size_t i = 0; i < sorted.size(); ++i)
        ASSERT_TRUE(same_bits(sorted[i], expected[i])) << "ray " << i << ", sorted";
    }
    for (const Form form : {Form::automatic, Form::packet, Form::single, Form::flight, Form::set}) {
      const Query query{Solver::robust, form, Coherence::none};
      const auto hits = run_closest(*kernels, geometry.view(), hard_case.rays, query);
      const auto occluded = run_any(*kernels, geometry.view(), hard_case.rays, query);
      for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_TRUE(same_bits(hits[i], expected[i]))
            << "ray " << i << " structure " << static_cast<int>(structure) << " form "
            << static_cast<int>(form) << ": id " << hits[i].id << " t " << hits[i].t
            << ", expected " << expected[i].id << " " << expected[i].t;
        ASSERT_EQ(occluded[i], expected[i].id == no_primitive ? 0 : 1) << "ray " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, Equivalence, each_hard_case(), hard_case_name);

/// A case proves nothing if its rays all miss.
TEST(HardCases, EveryRowHasHitsAndMisses) {
  for (const HardCaseSpec& spec : hard_case_specs()) {
    const HardCase hard_case = make_hard_case(spec, 61, 517);
    std::size_t hits = 0;
    for (const Ray& ray : hard_case.rays) {
      hits += reference::any_hit(ray, hard_case.spheres, hard_case.planes) ? 1U : 0U;
    }
    EXPECT_GT(hits, hard_case.rays.size() / 10) << name_of(spec);
    const bool from_the_centre = std::string(spec.row) == "S7";
    const bool planes_fill_the_view = spec.row[0] == 'P' || spec.row[0] == 'L';
    EXPECT_TRUE(planes_fill_the_view || from_the_centre || hits < hard_case.rays.size())
        << name_of(spec);
  }
}

TEST(ReferenceTable, AnswersAsTheReferencePath) {
  const HardCase hard_case = make_hard_case({"L", 3}, 61, 517);
  const Geometry geometry(hard_case.spheres, hard_case.planes, Structure::bvh);
  const Query query{Solver::reference, Form::automatic, Coherence::none};
  const auto hits = run_closest(reference_kernels(), geometry.view(), hard_case.rays, query);
  const auto occluded = run_any(reference_kernels(), geometry.view(), hard_case.rays, query);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Hit expected =
        reference::closest_hit(hard_case.rays[i], hard_case.spheres, hard_case.planes);
    ASSERT_TRUE(same_bits(hits[i], expected)) << "ray " << i;
    ASSERT_EQ(occluded[i], expected.id == no_primitive ? 0 : 1) << "ray " << i;
  }
}

}  // namespace
}  // namespace boule::test
