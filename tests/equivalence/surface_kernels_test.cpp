// Hit points, normals and shadow rays of every kernel table against the scalar path, bit for bit.
#include <optional>

#include "core/math/geometry.h"
#include "core/surface.h"
#include "simd/stream/surface_buffer.h"
#include "tests/support/expect_same.h"
#include "tests/support/hard_case_runs.h"

namespace boule::test {
namespace {

constexpr std::size_t ray_count = 517;  // the last packet is not whole

/// Memory for a ShadowRayStream.
struct ShadowRayArrays {
  RayBuffer rays{ray_count};
  VectorBuffer to_light;
  AlignedArray<double> cosine{ray_count};
  AlignedArray<std::uint32_t> point{ray_count};

  ShadowRayArrays() { to_light.resize(ray_count); }
  ShadowRayStream stream() { return {rays.view(), to_light.view(), cosine.data(), point.data()}; }
};

void expect_same_ray(const Ray& a, const Ray& b) {
  expect_same(a.org, b.org);
  EXPECT_EQ(a.dir, b.dir);
  EXPECT_EQ(a.tmin, b.tmin);
  EXPECT_EQ(a.tmax, b.tmax);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.inside, b.inside);
}

Vec3d point_of(const ShadowTarget& light) {
  return {light.target[0], light.target[1], light.target[2]};
}
Vec3d direction_to(const ShadowTarget& light, const Vec3d& point) {
  return light.directional ? point_of(light) : normalize(point_of(light) - point);
}
Ray shadow_ray(const ShadowTarget& light, const Surface& surface) {
  if (!light.directional) return shadow_ray_to(surface, point_of(light));
  const Departure departure = depart(surface, Side::viewer);
  return from_surface({departure.org, {light.dir[0], light.dir[1], light.dir[2]}}, departure);
}

/// A hard case's surfaces, and what any table needs to find them.
class SurfacesOfHardCases : public OnEachHardCase {
 protected:
  void SetUp() override {
    OnEachHardCase::SetUp();
    if (IsSkipped()) return;
    hard_case = make_hard_case(GetParam().spec, 61, ray_count);
    // Rays that begin elsewhere than at their origin, and rays that leave what they meet.
    for (std::size_t k = 0; k < ray_count; k += 5) hard_case.rays[k].tmin = -1e30F;
    geometry.emplace(hard_case.spheres, hard_case.planes);
    rays = to_stream(hard_case.rays);
    hits.resize(ray_count);
    reference_kernels().closest_hit(geometry->view(), rays.view(), {}, hits.view());
    for (std::size_t k = 0; k < ray_count; k += 7) rays.view().source[k] = hits.get(k).id;
  }

  void find(const KernelTable& table, SurfaceBuffer& found) {
    table.find_surfaces(geometry->view(), rays.view(), hits.view(), found.stream());
  }

  HardCase hard_case;
  std::optional<Geometry> geometry;
  RayBuffer rays;
  HitBuffer hits;
};

TEST_P(SurfacesOfHardCases, EqualTheScalarPath) {
  SurfaceBuffer wide(ray_count);
  find(*kernels, wide);
  std::size_t met = 0;
  for (std::size_t k = 0; k < ray_count && !HasFailure(); ++k) {
    const Hit hit = hits.get(k);
    if (hit.id == no_primitive) continue;
    ++met;
    SCOPED_TRACE(k);
    const Surface surface = find_surface(hard_case.spheres, hard_case.planes, rays.get(k), hit);
    const Departure departure = depart(surface, Side::viewer);
    expect_same(wide.point.get(k), surface.point);
    expect_same(wide.normal.get(k), surface.normal);
    expect_same(wide.view.get(k), surface.view);
    expect_same(wide.mirrored.get(k), surface.mirrored);
    expect_same(wide.org.get(k), departure.org);
    expect_same(wide.cosine[k], surface.cosine);
    expect_same(wide.reach[k], surface.reach);
    EXPECT_EQ(wide.inner[k] != 0, surface.inner);
    EXPECT_EQ(wide.inside[k] != 0, departure.inside);
  }
  EXPECT_GT(met, ray_count / 10);
}

TEST_P(SurfacesOfHardCases, ShadowRaysEqualTheScalarPath) {
  SurfaceBuffer surfaces(ray_count);
  find(reference_kernels(), surfaces);
  AlignedArray<std::uint8_t> lit(ray_count, 0);
  for (std::size_t k = 0; k < ray_count; ++k) {
    lit[k] = hits.get(k).id != no_primitive && k % 3 != 0 && (k < 100 || k > 140) ? 1 : 0;
  }
  const LitStream points{surfaces.point.view(),
                         surfaces.normal.view(),
                         surfaces.org.view(),
                         hits.view().id,
                         surfaces.inside.data(),
                         lit.data(),
                         ray_count};
  const Vec3d eye = hard_case.rays[0].org;
  for (const ShadowTarget& light :
       {ShadowTarget{false, {eye.x, eye.y, eye.z}, {}}, ShadowTarget{false, {3, 70, -20}, {}},
        ShadowTarget{true, {0.6, 0, -0.8}, {6, 0, -8}}}) {
    ShadowRayArrays wide;
    const std::size_t count = kernels->make_shadow_rays(light, points, wide.stream());
    std::size_t k = 0;
    for (std::size_t i = 0; i < ray_count && !HasFailure(); ++i) {
      if (lit[i] == 0) continue;
      const Surface surface =
          find_surface(hard_case.spheres, hard_case.planes, rays.get(i), hits.get(i));
      const Vec3d to_light = direction_to(light, surface.point);
      const double cosine = dot(surface.normal, to_light);
      if (!(cosine > 0)) continue;
      SCOPED_TRACE(i);
      ASSERT_LT(k, count);
      expect_same_ray(wide.rays.get(k), shadow_ray(light, surface));
      expect_same(wide.to_light.get(k), to_light);
      expect_same(wide.cosine[k], cosine);
      EXPECT_EQ(wide.point[k], i);
      ++k;
    }
    EXPECT_EQ(k, count);
  }
}

class SurfacesOfSpecks : public OnEachIsa {};

/// A sphere so small, for its coordinates, that the hit point is its centre: the normal then faces
/// the viewer.
TEST_P(SurfacesOfSpecks, FaceTheViewer) {
  const std::vector<Sphere> specks{{{1, 2, 3}, 1e-30F, 0}};
  const std::vector<Ray> all(ray_count, Ray{{1, 2, -1}, {0, 0, 2}});
  const Geometry geometry(specks, {});
  RayBuffer rays = to_stream(all);
  HitBuffer hits(ray_count);
  for (std::size_t k = 0; k < ray_count; ++k) {
    hits.view().t[k] = 2;
    hits.view().id[k] = 0;
    hits.view().slot[k] = 0;
  }
  SurfaceBuffer wide(ray_count);
  kernels->find_surfaces(geometry.view(), rays.view(), hits.view(), wide.stream());
  for (std::size_t k = 0; k < ray_count; ++k) {
    ASSERT_EQ(wide.point.get(k), (Vec3d{1, 2, 3}));
    ASSERT_EQ(wide.normal.get(k), (Vec3d{0, 0, -1}));
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, SurfacesOfSpecks, each_isa(), isa_name);
INSTANTIATE_TEST_SUITE_P(Tables, SurfacesOfHardCases, each_hard_case(), hard_case_name);

}  // namespace
}  // namespace boule::test
