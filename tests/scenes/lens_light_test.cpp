// How bright a lens' picture is: a white world is 1 in its middle, whatever the aperture. Against
// the area of the directions that pass a twin in long double.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/math/sobol.h"
#include "core/optics/camera_builder.h"
#include "core/optics/lens_optics.h"
#include "simd/dispatch/dispatch.h"
#include "tests/scenes/shipped_lens.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/lens_twin.h"

namespace boule::test::lens_light {
namespace {

/// A shipped lens, its film as long as a picture of 301 x 225 pixels has it.
struct Shipped {
  const char* file;
  const char* keys;
};
std::ostream& operator<<(std::ostream& out, const Shipped& lens) { return out << lens.file; }

class LensLight : public testing::TestWithParam<Shipped> {
 protected:
  static LensCamera open() { return shipped_lens(GetParam().file, GetParam().keys); }

  /// The same stopped down, from wide open to the narrowest that is legal: 0 .. 1.
  static LensCamera stopped(double share) {
    LensCamera camera = open();
    LensSurface& stop = camera.surfaces[*find_stop(camera.surfaces)];
    const double narrowest = least_width * static_cast<double>(camera.surfaces.back().aperture);
    stop.aperture =
        static_cast<float>(static_cast<double>(stop.aperture) *
                           std::pow(narrowest / static_cast<double>(stop.aperture), share));
    return camera;
  }
};

constexpr int apertures = 100, width = 301, height = 225;

/// What a picture shows of a white world in its middle: the mean of so many samples.
double picture_of(const LensCamera& camera, const LensOptics& optics, std::size_t many) {
  const CameraView view = build_camera(camera, width, height, nullptr, &optics);
  SampleBuffer samples;
  samples.resize(many, view);
  for (std::size_t i = 0; i < many; ++i) {
    const UnitPair at = sobol_pair(17, RandomSet::lens, static_cast<std::uint32_t>(i));
    samples.set(i, width / 2.0, height / 2.0);
    samples.set_lens(i, at.u, at.v);
  }
  RayBuffer rays(many);
  select_kernels("auto").value()->primary_rays(view, samples.view(), rays.view());
  double sum = 0;
  for (std::size_t i = 0; i < many; ++i) sum += static_cast<double>(samples.weight(i));
  return sum / static_cast<double>(many);
}

/// Only the rings of the film's middle are made: a film of a few of its pixels.
LensOptics optics_of_the_middle(LensCamera camera) {
  camera.film_width *= 3.0F / width;
  LensOptics optics = make_optics(camera, 3, 3, 1);
  optics.half_width *= width / 3.0;
  optics.half_height *= height / 3.0;
  return optics;
}

TEST_P(LensLight, WhiteWorldIsOneAtTheCentre) {
  for (int i = 0; i < apertures; ++i) {
    const LensCamera camera = stopped(i / (apertures - 1.0));
    const LensOptics optics = optics_of_the_middle(camera);
    const double stop = static_cast<double>(camera.surfaces[*find_stop(camera.surfaces)].aperture);
    const long double film = film_place(camera, 3000);
    ASSERT_NEAR(static_cast<double>(film), optics.film, 1e-5) << stop;
    const long double light = gathered_on(camera, film, 0, 2, 500);
    EXPECT_NEAR(static_cast<double>(light) * optics.exposure, 1, 2e-6) << stop;
    EXPECT_NEAR(gathered_light(camera) * optics.exposure, 1, 1e-12) << stop;
    // The samples' own error is some 1e-4 at most.
    EXPECT_NEAR(picture_of(camera, optics, 1U << 17U), 1, 0.0005) << stop;
  }
}

/// A lens that its fault once left without a centre: of a medium that there is, it is whole.
TEST(LensLightBeyond, NarrowPupilBehindWideRimIsFound) {
  LensCamera camera = shipped_lens("double_gauss_50mm.lens", "film_width = 20\n");
  camera.surfaces[8] = {-13.68F, 0.5F, 0.1875F, 26};
  const LensOptics optics = make_optics(camera, 64, 48);
  const long double film = film_place(camera, 3000);
  EXPECT_NEAR(static_cast<double>(gathered_on(camera, film, 0, 2, 500)) * optics.exposure, 1, 1e-5);
  // Towards the corners nothing passes; on the way there no ring is lost.
  bool seen = true;
  for (const PupilRing& ring : optics.pupil) {
    const bool light = ring.inner.x0 < ring.inner.x1;
    EXPECT_TRUE(seen || !light);
    seen = light;
  }
  EXPECT_FALSE(seen);
}

/// In the middle of the film the middle of the lens is on its axis; from there its place goes on
/// without a step, or AOVs would show rings.
TEST_P(LensLight, CentreIsOnAxisAndMovesSmoothly) {
  for (const double share : {0.0, 0.5}) {
    const LensCamera camera = stopped(share);
    const LensOptics optics = make_optics(camera, width, height);
    const auto middle_of = [](const PupilBox& box) { return (box.x0 + box.x1) / 2; };
    EXPECT_EQ(middle_of(optics.pupil.front().inner), 0);
    for (std::size_t i = 1; i < optics.pupil.size(); ++i) {
      EXPECT_NEAR(middle_of(optics.pupil[i - 1].outer), middle_of(optics.pupil[i].inner), 1e-12);
    }
    const CameraView view = build_camera(camera, width, height, nullptr, &optics);
    SampleBuffer samples;
    samples.resize(1, view);  // in the lens' centre
    samples.set(0, width / 2.0, height / 2.0);
    RayBuffer rays(1);
    reference_kernels().primary_rays(view, samples.view(), rays.view());
    EXPECT_EQ(rays.get(0).dir, (Vec3f{0, 0, -1}));
    EXPECT_EQ(rays.get(0).org, (Vec3d{0, 0, 0}));
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, LensLight,
                         testing::Values(Shipped{"double_gauss_50mm.lens", "film_width = 20\n"},
                                         Shipped{"wide_angle_22mm.lens", "film_width = 30\n"}));

}  // namespace
}  // namespace boule::test::lens_light
