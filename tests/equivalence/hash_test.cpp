// The same bits on every machine: one number over all inputs and one over all answers, held against
// constants that were measured once. Every kernel table, compiler and processor must find them.
#include "core/math/elementary.h"
#include "simd/build/camera_builder.h"
#include "tests/support/case_random.h"
#include "tests/support/hard_cases.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

/// A number that depends on every bit of what was put in, and on the order.
class Hash {
 public:
  void add(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15;
    state_ ^= state_ >> 29;
  }
  /// All NaN count as one: no processor promises a payload.
  void add(double value) {
    add(value != value ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(value));
  }
  void add(float value) { add(double{value}); }
  void add(std::int32_t value) { add(static_cast<std::uint64_t>(value)); }
  template <class T>
  void add(const Vec3<T>& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  void add(const Ray& ray) {
    add(ray.org);
    add(ray.dir);
    add(ray.tmin);
    add(ray.tmax);
    add(ray.source);
    add(std::int32_t{ray.inside});
  }
  void add(const std::vector<Hit>& hits) {
    for (const Hit& hit : hits) {
      add(hit.t);
      add(hit.id);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

HardCase hashed_case(const HardCaseSpec& spec) { return make_hard_case(spec, 61, 517); }

// They change with the cases, never with the machine.
constexpr std::uint64_t all_inputs = 0x58b15a889f482968;
constexpr std::uint64_t all_hits = 0x5b282f22e9832b14;
constexpr std::uint64_t all_primary_rays = 0xb82754bba516d2ff;
constexpr std::uint64_t all_elementary_values = 0xc0d80cea32466964;

TEST(Hash, OfTheInputs) {
  Hash hash;
  for (const HardCaseSpec& spec : hard_case_specs()) {
    const HardCase hard_case = hashed_case(spec);
    for (const Sphere& sphere : hard_case.spheres) {
      hash.add(sphere.center);
      hash.add(sphere.radius);
    }
    for (const Plane& plane : hard_case.planes) {
      hash.add(plane.point);
      hash.add(plane.normal);
    }
    for (const Ray& ray : hard_case.rays) hash.add(ray);
  }
  EXPECT_EQ(hash.value(), all_inputs);
}

TEST(Hash, OfTheElementaryFunctions) {
  CaseRandom random(5);
  Hash hash;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-750, 720);
    const double base = random.uniform(0, 4);
    const double exponent = random.uniform(-300, 300);
    const double angle = random.uniform(0, elementary::pi / 2);
    hash.add(elementary::exp(x));
    hash.add(elementary::pow(base, exponent));
    hash.add(elementary::tan_acute(angle));
  }
  EXPECT_EQ(hash.value(), all_elementary_values);
}

TEST(Hash, OfTheReferencePath) {
  Hash hash;
  for (const HardCaseSpec& spec : hard_case_specs()) {
    const HardCase hard_case = hashed_case(spec);
    const Geometry geometry(hard_case.spheres, hard_case.planes);
    const Query query{Solver::reference, Form::automatic, Coherence::none};
    hash.add(run_closest(reference_kernels(), geometry.view(), hard_case.rays, query));
  }
  EXPECT_EQ(hash.value(), all_hits);
}

class Kernels : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    kernels = kernels_or_null(GetParam());
    if (kernels == nullptr) GTEST_SKIP() << "this CPU has no " << GetParam();
  }
  const KernelTable* kernels = nullptr;
};

TEST_P(Kernels, HashOfAllHits) {
  for (const Form form : {Form::automatic, Form::packet, Form::single}) {
    Hash hash;
    for (const HardCaseSpec& spec : hard_case_specs()) {
      const HardCase hard_case = hashed_case(spec);
      const Geometry geometry(hard_case.spheres, hard_case.planes);
      const Query query{Solver::robust, form, Coherence::none};
      hash.add(run_closest(*kernels, geometry.view(), hard_case.rays, query));
    }
    EXPECT_EQ(hash.value(), all_hits) << "form " << static_cast<int>(form);
  }
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
  Hash hash;
  for (const Camera& camera : cameras) {
    kernels->primary_rays(build_camera(camera, 640, 361), samples.view(), rays.view());
    for (std::size_t i = 0; i < rays.size(); ++i) hash.add(rays.get(i));
  }
  EXPECT_EQ(hash.value(), all_primary_rays);
}

INSTANTIATE_TEST_SUITE_P(Tables, Kernels, testing::ValuesIn(all_isa_names()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace boule::test
