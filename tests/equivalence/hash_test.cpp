// The same bits on every machine: one number over all inputs and one over all answers, held against
// constants that were measured once. Every kernel table, compiler and processor must find them.
#include <vector>

#include "core/math/elementary.h"
#include "core/optics/camera_builder.h"
#include "tests/support/bit_hash.h"
#include "tests/support/camera_samples.h"
#include "tests/support/case_random.h"
#include "tests/support/hard_cases.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

HardCase hashed_case(const HardCaseSpec& spec) { return make_hard_case(spec, 61, 517); }

// They change with the cases, never with the machine.
constexpr std::uint64_t all_hits = 0xb2d3e1e00f0d3908;
constexpr std::uint64_t all_primary_rays = 0xb82754bba516d2ff;
constexpr std::uint64_t curved_primary_rays = 0xb48790f2242edf32;
constexpr std::uint64_t all_elementary_values = 0x94eee7848c4d206b;

TEST(Hash, OfTheInputs) {
  for (const HardCaseSpec& spec : hard_case_specs()) {
    BitHash hash;
    hash.add(hashed_case(spec));
    EXPECT_EQ(hash.value(), spec.inputs) << name_of(spec) << " has 0x" << std::hex << hash.value();
  }
}

TEST(Hash, OfTheElementaryFunctions) {
  CaseRandom random(5);
  BitHash hash;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-750, 720);
    const double base = random.uniform(0, 4);
    const double exponent = random.uniform(-300, 300);
    const double angle = random.uniform(0, elementary::pi / 2);
    hash.add(elementary::exp(x));
    hash.add(elementary::pow(base, exponent));
    hash.add(elementary::pow_for_float(base / 4, exponent < 0 ? -exponent : exponent));
    hash.add(elementary::tan_acute(angle));
  }
  EXPECT_EQ(hash.value(), all_elementary_values);
}

TEST(Hash, OfTheReferencePath) {
  BitHash hash;
  for (const HardCaseSpec& spec : hard_case_specs()) {
    const HardCase hard_case = hashed_case(spec);
    const Geometry geometry(hard_case.spheres, hard_case.planes);
    const Query query{Solver::reference, Form::automatic, Coherence::none};
    hash.add(run_closest(reference_kernels(), geometry.view(), hard_case.rays, query));
  }
  EXPECT_EQ(hash.value(), all_hits);
}

class Kernels : public OnEachIsa {};

TEST_P(Kernels, HashOfAllHits) {
  std::vector<HardCase> cases;
  for (const HardCaseSpec& spec : hard_case_specs()) cases.push_back(hashed_case(spec));
  for (const Structure structure : {Structure::scan, Structure::bvh}) {
    for (const Form form : {Form::automatic, Form::packet, Form::single, Form::flight, Form::set}) {
      BitHash hash;
      for (const HardCase& hard_case : cases) {
        const Geometry geometry(hard_case.spheres, hard_case.planes, structure);
        const Query query{Solver::robust, form, Coherence::none};
        hash.add(run_closest(*kernels, geometry.view(), hard_case.rays, query));
      }
      EXPECT_EQ(hash.value(), all_hits)
          << "form " << static_cast<int>(form) << " structure " << static_cast<int>(structure);
    }
  }
}

/// Of cameras with a lens, with directions by polynomials, or that see less than the frame.
TEST_P(Kernels, HashOfCurvedPrimaryRays) {
  const CameraPose pose{{2.1F, 1.3F, 1.7F}, {0.1F, -0.2F, 0.3F}, {0, 0, 1}};
  const Camera cameras[] = {FisheyeCamera{pose, 360}, FisheyeCamera{pose, 60, FovAxis::y},
                            ThinLensCamera{pose, 45, FovAxis::x, 0.4F, 3.0F}};
  BitHash hash;
  for (const Camera& camera : cameras) {
    const CameraView view = build_camera(camera, 640, 361);
    SampleBuffer samples = random_samples(view, 1003, 640, 361, 8);
    RayBuffer rays(samples.size());
    kernels->primary_rays(view, samples.view(), rays.view());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const float weight = view.weighs ? samples.weight(i) : 1;
      hash.add(weight);
      if (weight != 0) hash.add(rays.get(i));
    }
  }
  EXPECT_EQ(hash.value(), curved_primary_rays);
}

TEST_P(Kernels, HashOfAllPrimaryRays) {
  const CameraPose pose{{2.1F, 1.3F, 1.7F}, {0.1F, -0.2F, 0.3F}, {0, 0, 1}};
  const Camera cameras[] = {PinholeCamera{pose, 45}, PinholeCamera{pose, 179.5F, FovAxis::y},
                            OrthographicCamera{pose, 3.7F}};
  CaseRandom random(7);
  SampleBuffer samples;
  samples.resize(1003);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = random.uniform(0, 640);
    const double y = random.uniform(0, 361);
    samples.set(i, x, y);
  }
  RayBuffer rays(samples.size());
  BitHash hash;
  for (const Camera& camera : cameras) {
    kernels->primary_rays(build_camera(camera, 640, 361), samples.view(), rays.view());
    for (std::size_t i = 0; i < rays.size(); ++i) hash.add(rays.get(i));
  }
  EXPECT_EQ(hash.value(), all_primary_rays);
}

INSTANTIATE_TEST_SUITE_P(Tables, Kernels, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
