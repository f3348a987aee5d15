// What the headers of core say of bad input, entry by entry.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/geometry.h"
#include "core/math/light_cone.h"
#include "core/math/monotone_cubic.h"
#include "core/math/similarity.h"
#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "core/optics/lens_optics.h"
#include "core/reference.h"
#include "core/scene/group.h"
#include "core/scene/scene.h"
#include "core/surface.h"

namespace boule::test::bad_input {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr auto inf_f = std::numeric_limits<float>::infinity();
constexpr auto nan_f = std::numeric_limits<float>::quiet_NaN();
constexpr float odd_floats[] = {nan_f, inf_f, -inf_f, 0, -1, 1e30f, 1e-40f};

bool is_nan(const Vec3d& v) { return std::isnan(v.x) && std::isnan(v.y) && std::isnan(v.z); }

TEST(BadInput, MathAnswersWithNaN) {
  EXPECT_TRUE(std::isnan(monotone_cubic({}, 1)));
  EXPECT_EQ(value_before({}, 1), 0U);
  const TimedValue one{2, 3};
  EXPECT_EQ(monotone_cubic({&one, 1}, nan), 3);
  for (const double degrees : {nan, inf, -inf}) {
    EXPECT_TRUE(std::isnan(turn_of(degrees).cosine)) << degrees;
    EXPECT_TRUE(std::isnan(turn_of(degrees).sine)) << degrees;
    EXPECT_TRUE(std::isnan(rotation({0, degrees, 0}).row_x.x));
  }
  EXPECT_TRUE(is_nan(normalize({0, 0, 0})));
  EXPECT_TRUE(is_nan(normalize({1, nan, 1})));
  EXPECT_TRUE(std::isnan(normalize({inf, 1, 1}).x));
  EXPECT_EQ(normalize({1e200, 0, 0}), Vec3d{});
}

TEST(BadInput, InvalidLensesHaveNoFocus) {
  const std::vector<LensSurface> none, flat = {{0, 1, 1, 1}}, spoilt = {{nan_f, 1, 1, 1}};
  EXPECT_TRUE(std::isnan(image_distance(none, 1)));
  EXPECT_TRUE(std::isnan(stop_diameter(none, 0, 8)));
  EXPECT_TRUE(std::isnan(stop_diameter(flat, 1, 8)));
  EXPECT_TRUE(std::isnan(stop_diameter(flat, static_cast<std::size_t>(-1), 8)));
  EXPECT_FALSE(find_stop(none));
  for (const auto* surfaces : {&none, &flat, &spoilt}) {
    EXPECT_FALSE(std::isfinite(focal_length(*surfaces)));
  }
}

/// A valid lens, and what can be wrong with it.
LensCamera lens() {
  return {{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}}, {{50, 5, 1.5f, 20}, {-50, 0, 1, 20}}, 36, 0.01f, {}};
}

struct LensFault {
  std::string name;
  std::function<void(LensCamera&)> spoil;
};

const LensFault lens_faults[] = {
    {"no surfaces", [](LensCamera& c) { c.surfaces = std::vector<LensSurface>(); }},
    {"NaN radius", [](LensCamera& c) { c.surfaces[0].radius = nan_f; }},
    {"infinite thickness", [](LensCamera& c) { c.surfaces[0].thickness = inf_f; }},
    {"index 0", [](LensCamera& c) { c.surfaces[0].index = 0; }},
    {"NaN aperture", [](LensCamera& c) { c.surfaces[1].aperture = nan_f; }},
    {"aperture 0", [](LensCamera& c) { c.surfaces[1].aperture = 0; }},
    {"NaN film", [](LensCamera& c) { c.film_width = nan_f; }},
    {"NaN focus", [](LensCamera& c) { c.focus = nan_f; }},
};

TEST(BadInput, InvalidLensesStopAllRays) {
  ASSERT_FALSE(find_problem(Camera{lens()}));
  for (const LensFault& fault : lens_faults) {
    LensCamera camera = lens();
    fault.spoil(camera);
    EXPECT_TRUE(find_problem(Camera{camera})) << fault.name;
    const LensOptics optics = make_optics(camera, 64, 48);
    ASSERT_FALSE(optics.pupil.empty()) << fault.name;
    const CameraView view = build_camera(camera, 64, 48, nullptr, &optics);
    const CameraRay made = camera_ray(view, {{32.5, 24.5}});
    EXPECT_EQ(made.weight, 0) << fault.name;
  }
}

TEST(BadInput, MovedFromLensesHaveNoView) {
  LensOptics first = make_optics(lens(), 64, 48, 2);
  const LensElement* const elements = first.view().elements;
  const LensOptics second = std::move(first);
  EXPECT_EQ(second.view().elements, elements);  // the numbers stay where they are
  EXPECT_EQ(second.view().element_count, 2);
  EXPECT_EQ(first.view().element_count, 0);  // NOLINT: that is the test
  EXPECT_EQ(first.view().ring_count, 0);     // NOLINT
}

/// Every camera with each of its numbers spoilt in turn.
std::vector<Camera> spoilt_cameras() {
  std::vector<Camera> cameras;
  const CameraPose good{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  for (const float odd : odd_floats) {
    for (const CameraPose& pose : {CameraPose{{odd, 0, 5}, good.look_at, good.up},
                                   CameraPose{good.eye, {0, odd, odd}, good.up},
                                   CameraPose{good.eye, good.look_at, {odd}}}) {
      cameras.insert(cameras.end(),
                     {PinholeCamera{pose}, OrthographicCamera{pose}, FisheyeCamera{pose},
                      ThinLensCamera{pose, 45, FovAxis::x, 0.1f}});
    }
    cameras.insert(cameras.end(), {PinholeCamera{good, odd}, OrthographicCamera{good, odd},
                                   FisheyeCamera{good, odd}, ThinLensCamera{good, odd},
                                   ThinLensCamera{good, 45, FovAxis::x, odd},
                                   ThinLensCamera{good, 45, FovAxis::x, 0.1f, odd}});
  }
  return cameras;
}

TEST(BadInput, RaysOfInvalidCamerasAreHarmless) {
  const std::vector<Sphere> spheres = {{{0, 0, 0}, 1, 0}};
  int spoilt = 0;
  for (const Camera& camera : spoilt_cameras()) {
    for (const auto& [width, height] : {std::pair{64, 48}, {0, 48}, {64, -1}}) {
      const CameraView view = build_camera(camera, width, height);
      for (const double x : {32.5, nan, inf, -1e300}) {
        const Ray ray = primary_ray(view, x, 24.5);
        if (is_finite(ray.org) && is_finite(ray.dir)) continue;
        ++spoilt;
        EXPECT_EQ(reference::closest_hit(ray, spheres, {}).id, no_primitive);
      }
    }
  }
  EXPECT_GT(spoilt, 1000);
}

TEST(BadInput, UnnamedEnumeratorsActAsNamedOnes) {
  Scene scene;
  scene.image.filter = static_cast<PixelFilter>(9);
  scene.render.method = static_cast<Method>(9);
  PinholeCamera camera;
  camera.fov_axis = static_cast<FovAxis>(9);
  scene.camera = camera;
  scene.lights = {PointLight{{}, {1, 1, 1}, static_cast<Falloff>(9)}};
  EXPECT_TRUE(validate(scene));
  EXPECT_TRUE(is_finite(build_camera(camera, 4, 3).right));
}

TEST(BadInput, InvalidSpheresAreInvisible) {
  struct Case {
    Vec3d point, center;
    double radius;
    bool seen;
  };
  const Case cases[] = {{{0, 0, 5}, {0, 0, 0}, 1, true},    {{0, 0, 5}, {0, 0, 0}, -1, true},
                        {{0, 0, 5}, {0, 0, 0}, 0, false},   {{0, 0, 5}, {0, 0, 0}, nan, false},
                        {{0, 0, 5}, {0, 0, 0}, inf, false}, {{0, 0, 0}, {0, 0, 0}, 1, false},
                        {{nan, 0, 5}, {0, 0, 0}, 1, false}, {{0, inf, 5}, {0, 0, 0}, 1, false},
                        {{0, 0, 5}, {0, 0, nan}, 1, false}, {{0, 0, 0.5}, {0, 0, 0}, -1, false}};
  for (const Case& c : cases) {
    const LightCone cone(c.point, c.center, c.radius);
    EXPECT_EQ(cone.density() > 0, c.seen) << c.radius << " from " << c.point.z;
    EXPECT_EQ(cone.meets({0, 0, -1}, 100), c.seen);
    if (!c.seen) {
      EXPECT_EQ(cone.density(), 0);
    }
  }
  const LightCone plain({0, 0, 5}, {}, 1), negative({0, 0, 5}, {}, -1);
  EXPECT_EQ(negative.density(), plain.density());
}

TEST(BadInput, PlacementsBeyondFloatRangeAreRefused) {
  const Instance huge{0, {}, {}, 3e38f, {}}, nowhere{0, {nan_f, 0, 0}, {}, 1, {}};
  for (const Instance& instance : {huge, nowhere}) {
    const Similarity transform = transform_of(instance);
    EXPECT_TRUE(find_problem(transformed(Sphere{{1, 2, 3}, 4, 0}, transform, {})));
    EXPECT_TRUE(find_problem(transformed(Plane{{9, 2, 3}, {0, 1, 0}, 0}, transform, {})));
  }
  EXPECT_TRUE(find_problem(nowhere));
}

TEST(BadInput, SurfacesOfOddRaysAreFinite) {
  for (const double odd : {nan, inf, 0.0, 1e300}) {
    const Ray ray{{odd, 0, 5}, {0, 0, -1}};
    for (const Surface& surface : {find_surface(Sphere{{}, 1, 0}, ray, {odd, 0}),
                                   find_surface(Plane{{}, {0, 0, 0}, 0}, ray, {odd, 0})}) {
      EXPECT_EQ(surface.id, 0);
      EXPECT_EQ(leave(surface, Side::beyond, {0, 0, 1}).source, 0);
    }
  }
}

TEST(BadInput, EmptyScenesAreMissed) {
  const Ray ray{{0, 0, 5}, {0, 0, -1}};
  EXPECT_EQ(reference::closest_hit(ray, {}, {}).id, no_primitive);
  EXPECT_FALSE(reference::any_hit(ray, {}, {}));
  Ray foreign = ray;  // leaves what there is not
  foreign.source = 77;
  const Sphere sphere{{}, 1, 0};
  EXPECT_EQ(reference::closest_hit(foreign, {&sphere, 1}, {}).t, 4);
}

TEST(BadInput, SerialForStopsAtExceptions) {
  int calls = 0;
  EXPECT_THROW(serial_for(5,
                          [&](std::size_t i) {
                            ++calls;
                            if (i == 2) throw std::runtime_error("no");
                          }),
               std::runtime_error);
  EXPECT_EQ(calls, 3);
  EXPECT_THROW(serial_for(1, {}), std::bad_function_call);
  EXPECT_NO_THROW(serial_for(0, {}));
  EXPECT_THROW(ParallelFor{}(1, [](std::size_t) {}), std::bad_function_call);
}

TEST(BadInput, RangeErrorsNameTheAllowedRange) {
  EXPECT_TRUE(check_range("tile", 3, {.low = 1, .high = 3}));
  EXPECT_EQ(check_range("tile", 4, {.low = 1, .high = 3}).error().message, "must be 1 to 3, is 4");
  EXPECT_EQ(check_range("spp", -2147483647 - 1, {.low = 1, .high = max_count}).error().message,
            "must be 1 or above, is -2147483648");
}

}  // namespace
}  // namespace boule::test::bad_input
