// A glass sphere against closed forms: the path by Snell's law, the light by Fresnel's equations,
// both worked out in double from the impact parameter alone.
#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "core/optics/dielectric.h"
#include "render/shading/bsdf.h"
#include "tests/render/picture_comparison.h"
#include "tests/render/prepared.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

constexpr double u = 0x1p-24;

/// A ray that meets a sphere of index `ior`, by geometry. With s = |l| / r, where l is the line's
/// closest approach, the sine of the angle of incidence is s, and inside of the sphere it is s /
/// ior. Each crossing bends the ray by the difference of the angles, towards the centre if ior > 1.
struct ClosedForm {
  Vec3d view, towards_centre;  ///< unit, at right angles
  double outside, inside;      ///< angles to the normal; inside: NaN at total reflection

  ClosedForm(const Ray& ray, const Sphere& sphere, double ior) {
    view = normalize(vec_cast<double>(ray.dir));
    const Vec3d f = vec_cast<double>(sphere.center) - ray.org;
    const Vec3d closest = f - view * dot(f, view);
    towards_centre = normalize(closest);
    const double sine = length(closest) / static_cast<double>(sphere.radius);
    outside = std::asin(sine);
    inside = std::asin(sine / ior);
  }
  [[nodiscard]] Vec3d leaving() const {
    const double bend = 2 * (outside - inside);
    return view * std::cos(bend) + towards_centre * std::sin(bend);
  }
  /// How an error of the angle inside grows on the way out: d outside / d inside, by Snell's law.
  [[nodiscard]] double growth(double ior) const {
    return ior * std::cos(inside) / std::cos(outside);
  }
  [[nodiscard]] double fresnel_share() const {
    const double s = std::sin(outside - inside) / std::sin(outside + inside);
    const double p = std::tan(outside - inside) / std::tan(outside + inside);
    return (s * s + p * p) / 2;
  }
};

/// Rays from all sides at one sphere, with impact parameters up to `widest` radii.
std::vector<Ray> rays_at(const Sphere& sphere, double widest, std::size_t count,
                         CaseRandom& random) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d direction = random.direction();
    const Vec3d across = random.perpendicular(direction);
    const double beta = widest * std::sqrt(random.uniform(1e-4, 1));
    const double distance = random.uniform(1.5, 30);
    const Vec3d from = across * beta - direction * distance;
    const Vec3d org = vec_cast<double>(sphere.center) + from * static_cast<double>(sphere.radius);
    rays.push_back({vec_cast<double>(vec_cast<float>(org)), vec_cast<float>(direction)});
  }
  return rays;
}

struct Glassy {
  const KernelTable& kernels;
  PreparedScene scene;
  FlatMaterial material;
  Sphere sphere;

  Glassy(const Sphere& s, float ior)
      : kernels(*select_kernels("auto").value()), scene(prepared({s}, {})), sphere(s) {
    material = flatten(Glass{{1, 1, 1}, ior}, Color{});
  }
  [[nodiscard]] std::vector<Surface> surfaces(const std::vector<Ray>& rays) const {
    const auto hits = run_closest(kernels, scene.geometry.view(), rays, {});
    std::vector<Surface> found;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].id == 0) found.push_back(find_surface(scene, rays[i], hits[i]));
    }
    EXPECT_EQ(found.size(), rays.size());
    found.resize(rays.size());
    return found;
  }
};

TEST(Glass, SphereRefractionObeysSnellsLaw) {
  CaseRandom random(101);
  double worst = 0;
  for (const float ior : {1.33f, 1.5f, 2.4f, 0.75f}) {
    for (const float radius : {1e-3f, 1.0f, 30.0f, 1e4f, 1e6f}) {
      const Glassy glass({{3 * radius, -2 * radius, radius}, radius, 0}, ior);
      const double widest = 0.99 * std::min(static_cast<double>(ior), 1.0);
      const std::vector<Ray> rays = rays_at(glass.sphere, widest, 50'000, random);
      std::vector<Ray> inner;
      for (const Surface& entry : glass.surfaces(rays)) {
        ASSERT_FALSE(entry.inner);
        inner.push_back(leave(entry, Side::beyond, scatter(glass.material, entry).refracted));
      }
      const std::vector<Surface> exits = glass.surfaces(inner);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(exits[i].inner);
        const Scatter out = scatter(glass.material, exits[i]);
        ASSERT_FALSE(is_black(out.refraction));  // by symmetry a ray that enters can leave
        const ClosedForm expected(rays[i], glass.sphere, static_cast<double>(ior));
        const double error = length(out.refracted - expected.leaving());
        // The direction inside is rounded to float: u in each component, so 1.74 u in its angle.
        // It turns the ray once, and the normal twice, because the exit point moves; the exit makes
        // the change of the angle inside larger.
        const double bound = 1.74 * u * (2 + 2 * expected.growth(static_cast<double>(ior)));
        ASSERT_LE(error, bound) << ior << " " << radius;
        worst = std::max(worst, error / bound);
      }
    }
  }
  EXPECT_GT(worst, 0.1);  // the bound is not far too wide
}

TEST(Glass, SplitsTheLightByFresnelsEquations) {
  CaseRandom random(102);
  for (const float ior : {1.33f, 1.5f, 2.4f, 0.75f}) {
    const Glassy glass({{5, 1, -2}, 2, 0}, ior);
    const double widest = 0.999 * std::min(static_cast<double>(ior), 1.0);
    const std::vector<Ray> rays = rays_at(glass.sphere, widest, 20'000, random);
    const std::vector<Surface> entries = glass.surfaces(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Scatter split = scatter(glass.material, entries[i]);
      const double share = ClosedForm(rays[i], glass.sphere, ior).fresnel_share();
      ASSERT_NEAR(split.reflection.r, share, u);
      ASSERT_NEAR(split.refraction.r, 1 - share, u);
      ASSERT_NEAR(split.reflection.r + split.refraction.r, 1, u);  // nothing is lost
    }
  }
}

TEST(Glass, ReflectsTotallyBeyondTheCriticalAngle) {
  // A bubble: if the impact parameter is above ior radii, nothing goes in.
  CaseRandom random(103);
  const float ior = 0.75f;
  const Glassy bubble({{5, 1, -2}, 2, 0}, ior);
  const std::vector<Ray> rays = rays_at(bubble.sphere, 0.999, 100'000, random);
  const std::vector<Surface> entries = bubble.surfaces(rays);
  int total = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const ClosedForm expected(rays[i], bubble.sphere, static_cast<double>(ior));
    const double sine = std::sin(expected.outside);
    if (std::fabs(sine - static_cast<double>(ior)) < 1e-6) continue;
    const Scatter split = scatter(bubble.material, entries[i]);
    ASSERT_EQ(is_black(split.refraction), sine > static_cast<double>(ior)) << sine;
    if (sine < static_cast<double>(ior)) continue;
    ASSERT_EQ(split.reflection, (Color{1, 1, 1}));
    ++total;
  }
  EXPECT_GT(total, 40'000);
}

/// Under a white sky a sphere of clear glass sends back all light except what is still inside after
/// the last bounce: F + (1 - F)^2 (1 + F + F^2 + ..), because every chord has the same angle to the
/// normal.
TEST(Glass, LosesOnlyTheLastBounceUnderWhite) {
  Scene scene = empty_scene(48, 48);
  scene.background = ConstantBackground{{1, 1, 1}};
  scene.camera = pinhole({0, 0, 5}, {0, 0, 0}, 25);
  scene.spheres = {{{0, 0, 0}, 1, add_material(scene, Glass{{1, 1, 1}, 1.5f})}};
  const CameraView view = build_camera(*scene.camera, 48, 48);
  for (const int depth : {0, 1, 2, 3, 5, 8}) {
    scene.render.max_depth = depth;
    const Image image = render(scene);
    int seen = 0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 48; ++x) {
        const Ray ray = primary_ray(view, x + 0.5, y + 0.5);
        const ClosedForm path(ray, scene.spheres[0], 1.5);
        double expected = 1;
        if (std::isfinite(path.outside)) {
          const double share = path.fresnel_share();
          expected = depth > 0 ? share : 0;
          double inside = 1 - share;
          for (int bounce = 2; bounce <= depth; ++bounce, inside *= share)
            expected += inside * (1 - share);
          ++seen;
        }
        ASSERT_NEAR(image.at(x, y).g, expected, 1e-6) << depth << " at " << x << " " << y;
      }
    }
    EXPECT_GT(seen, 1000);
  }
}

}  // namespace
}  // namespace boule::test
