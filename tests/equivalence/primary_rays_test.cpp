// Camera rays of every kernel table against the scalar path, bit for bit.
#include <type_traits>
#include <variant>

#include "core/optics/camera_builder.h"
#include "tests/support/camera_samples.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::primary_rays {
namespace {

class PrimaryRays : public OnEachIsa {};

void expect_same(const KernelTable& kernels, const Camera& camera, int width, int height,
                 const DistortionMap* map = nullptr) {
  const CameraView view = build_camera(camera, width, height, map);
  SampleBuffer samples = random_samples(view, 203, width, height, 3);
  RayBuffer wide(samples.size()), shared(samples.size(), common_part(view.kind));
  kernels.primary_rays(view, samples.view(), wide.view());
  kernels.primary_rays(view, samples.view(), shared.view());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto [b, weight] = camera_ray(view, sample_of(samples, view, i));
    const Ray a = wide.get(i), same = shared.get(i);
    ASSERT_EQ(view.weighs ? samples.weight(i) : 1, weight) << i;
    if (weight == 0) continue;
    ASSERT_EQ(a.org, b.org) << i;
    ASSERT_EQ(a.dir, b.dir) << i;
    ASSERT_EQ(a.tmin, b.tmin);
    ASSERT_EQ(a.tmax, b.tmax);
    ASSERT_EQ(a.source, no_primitive);
    ASSERT_FALSE(a.inside);
    ASSERT_TRUE(have_in_common({a, same}, CommonPart::origin)) << i;
    ASSERT_TRUE(have_in_common({a, same}, CommonPart::direction)) << i;
    ASSERT_EQ(same.tmax, b.tmax);
  }
}

TEST_P(PrimaryRays, EqualTheScalarPath) {
  const CameraPose pose{{2.1F, 1.3F, 1.7F}, {0.1F, -0.2F, 0.3F}, {0, 0, 1}};
  for (const FovAxis axis : {FovAxis::x, FovAxis::y, FovAxis::max}) {
    expect_same(*kernels, PinholeCamera{pose, 45, axis}, 640, 361);
    expect_same(*kernels, PinholeCamera{pose, 179.5F, axis}, 3, 65535);
  }
  expect_same(*kernels, OrthographicCamera{pose, 3.7F}, 640, 361);
  expect_same(*kernels, FisheyeCamera{pose, 360, FovAxis::x}, 640, 361);
  expect_same(*kernels, FisheyeCamera{pose, 100, FovAxis::y}, 640, 361);
  expect_same(*kernels, ThinLensCamera{pose, 45, FovAxis::x, 0.3F, 2.5F}, 640, 361);
}

/// Calls visit(camera) with each kind of camera that needs no file, as it is by default.
template <class Visitor, class... Kinds>
void each_kind(const CameraPose& pose, const std::variant<Kinds...>&, const Visitor& visit) {
  const auto visit_one = [&]<class Kind>(Kind camera) {
    camera.pose = pose;
    if constexpr (!std::is_same_v<Kind, LensCamera>) visit(camera);
  };
  (visit_one(Kinds{}), ...);
}

TEST_P(PrimaryRays, OfEveryKindEqualTheScalarPath) {
  const CameraPose pose{{2.1F, 1.3F, 1.7F}, {0.1F, -0.2F, 0.3F}, {0, 0, 1}};
  const DistortionMap map = random_map(7, 5, 0.1);
  each_kind(pose, Camera{}, [&](const Camera& camera) {
    expect_same(*kernels, camera, 640, 361);
    expect_same(*kernels, camera, 640, 361, &map);
  });
}

TEST_P(PrimaryRays, EqualTheScalarPathThroughAMap) {
  const CameraPose pose{{2.1F, 1.3F, 1.7F}, {0.1F, -0.2F, 0.3F}, {0, 0, 1}};
  const DistortionMap map = random_map(7, 5, 0.1);
  expect_same(*kernels, PinholeCamera{pose, 45, FovAxis::x}, 640, 361, &map);
  expect_same(*kernels, OrthographicCamera{pose, 3.7F}, 640, 361, &map);
  expect_same(*kernels, FisheyeCamera{pose, 300, FovAxis::x}, 640, 361, &map);
  expect_same(*kernels, ThinLensCamera{pose, 45, FovAxis::x, 0.3F, 2.5F}, 640, 361, &map);
}

INSTANTIATE_TEST_SUITE_P(Tables, PrimaryRays, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::primary_rays
