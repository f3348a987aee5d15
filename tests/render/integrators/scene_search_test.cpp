// Hits of spheres and capsules that planes cut, against the definition.
#include "render/integrators/scene_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "tests/render/integrators/cut_scenes.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::clips {
namespace {

/// A hit, and the surface that it has.
struct Met {
  Hit hit;
  std::int32_t surface = no_primitive;
};

std::vector<Met> found_by(const PreparedScene& scene, const KernelTable& kernels,
                          const std::vector<Ray>& rays, Solver solver = Solver::robust) {
  SceneSearch search(scene, kernels);
  RayBuffer stream = to_stream(rays);
  HitBuffer hits(rays.size()), room;
  AlignedArray<std::uint8_t> occluded;
  occluded.resize(rays.size());
  search.any_hit(stream.view(), {solver}, occluded.data());
  search.closest_hit(stream.view(), {solver}, hits.view());
  const HitStream met = search.surfaces(hits.view(), room);
  std::vector<Met> all;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    all.push_back({hits.get(k), met.id[k]});
    EXPECT_EQ(occluded[k] != 0, all.back().hit.id != no_primitive);
  }
  return all;
}

/// The definition, in double: each primitive's chord, cut, and the first end within the ray.
class Definition {
 public:
  explicit Definition(const PreparedScene& scene, const Scene& given)
      : scene_(given), clips_(scene.clip_planes()) {
    first_clip_ = static_cast<std::int32_t>(given.spheres.size() + given.planes.size());
  }

  [[nodiscard]] Met closest(Ray ray) const {
    ray.tmin = float_below(ray.tmin);
    ray.tmax = float_above(ray.tmax);
    double from = ray.tmin, to = ray.tmax;
    std::int32_t enters = no_primitive, leaves = no_primitive, id = first_clip_;
    for (const Plane& clip : clips_) {
      const reference::Chord kept = reference::find_chord(ray, clip, false);
      if (kept.enter > from) from = kept.enter, enters = id;
      if (kept.leave < to) to = kept.leave, leaves = id;
      ++id;
    }
    Met nearest;
    double nearest_share = 0;
    const auto offer = [&](double t, std::int32_t hit, std::int32_t surface, double share = 0) {
      if (t > nearest.hit.t || (t == nearest.hit.t && !(share < nearest_share))) return;
      nearest = {{t, hit}, surface};
      nearest_share = share;
    };
    const auto cut = [&](const reference::Chord& chord, const auto& primitive, std::int32_t one) {
      const auto share_at = [&](double t) { return share_of(primitive, point_at(ray, t)); };
      if (!(chord.enter <= to) || !(from < chord.leave) || !(from < to)) return;
      if (chord.enter > from) return offer(chord.enter, one, one);
      if (enters != no_primitive) return offer(from, one, enters, share_at(from));
      if (chord.leave <= to) return offer(chord.leave, one, one);
      if (leaves != no_primitive) offer(to, one, leaves, share_at(to));
    };
    id = 0;
    for (const Sphere& sphere : scene_.spheres)
      cut(reference::find_chord(ray, sphere, false), sphere, id++);
    for (const Plane& plane : scene_.planes) {
      offer(reference::intersect(ray, plane, false), id, id);
      ++id;
    }
    id += static_cast<std::int32_t>(clips_.size());
    for (const Capsule& capsule : scene_.capsules)
      cut(reference::find_chord(ray, capsule, false), capsule, id++);
    return nearest;
  }

 private:
  static Vec3d point_at(const Ray& ray, double t) {
    return ray.org + vec_cast<double>(ray.dir) * t;
  }
  static double share_of(const Sphere& sphere, const Vec3d& point) {
    const Vec3d off = point - vec_cast<double>(sphere.center);
    return dot(off, off) / (double{sphere.radius} * double{sphere.radius});
  }
  static double share_of(const Capsule& capsule, const Vec3d& point) {
    const Vec3d a = vec_cast<double>(capsule.a), u = vec_cast<double>(capsule.b) - a;
    const double along = std::clamp(dot(point - a, u) / dot(u, u), 0.0, 1.0);
    return share_of(Sphere{{}, capsule.radius}, point - (a + u * along));
  }

  const Scene& scene_;
  std::span<const Plane> clips_;
  std::int32_t first_clip_;
};

class WideClips : public OnEachIsa {};

TEST_P(WideClips, HaveTheDefinitionsBits) {
  int caps = 0, others = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Scene scene = cut_scene(seed, 1 + static_cast<int>(seed % 4));
    const auto prepared = prepare(scene, 8, 8);
    ASSERT_TRUE(prepared);
    const Definition definition(prepared.value(), scene);
    const std::vector<Ray> rays = rays_through(seed, 1500);
    const std::vector<Met> found = found_by(prepared.value(), *kernels, rays);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const Met expected = definition.closest(rays[k]);
      ASSERT_EQ(found[k].hit.t, expected.hit.t) << "seed " << seed << " ray " << k;
      ASSERT_EQ(found[k].hit.id, expected.hit.id) << "seed " << seed << " ray " << k;
      ASSERT_EQ(found[k].surface, expected.surface) << "seed " << seed << " ray " << k;
      ++(expected.surface == expected.hit.id ? others : caps);
    }
  }
  EXPECT_GT(caps, 3000);
  EXPECT_GT(others, 3000);
}

INSTANTIATE_TEST_SUITE_P(AllIsas, WideClips, each_isa(), isa_name);

/// What one ray meets.
Met meet(const Scene& scene, const Ray& ray) {
  const auto prepared = prepare(scene, 8, 8);
  return found_by(prepared.value(), *select_kernels("auto").value(), {ray})[0];
}

TEST(Clips, SphereThatTouchesThePlane) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  const Ray along{{0, 0, 5}, {0, 0, -1}};
  scene.clips = {{{0, 0, 1}, {0, 0, 1}}};  // it is left whole
  EXPECT_EQ(meet(scene, along).hit.t, 4);
  scene.clips = {{{0, 0, 1}, {0, 0, -1}}};  // one point of it is left
  EXPECT_EQ(meet(scene, along).hit.t, 4);
  EXPECT_EQ(meet(scene, {{0.5, 0, 5}, {0, 0, -1}}).hit.id, no_primitive);
}

TEST(Clips, ThinSliceBetweenTwoPlanes) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, 0}, 2, 0}, {{0, 0, 0}, 1, 0}};
  scene.clips = {{{0, 0, 0.25F}, {0, 0, 1}}, {{0, 0, -0.25F}, {0, 0, -1}}};
  const Met front = meet(scene, {{0, 0, 5}, {0, 0, -1}});
  EXPECT_EQ(front.hit.t, 4.75);
  EXPECT_EQ(front.hit.id, 0);
  EXPECT_EQ(front.surface, 2);
  const Met back = meet(scene, {{0.1, 0, -5}, {0, 0, 1}});
  EXPECT_EQ(back.hit.t, 4.75);
  EXPECT_EQ(back.surface, 3);
  const Met within = meet(scene, {{0, 0, 0}, {0, 0, -1}});
  EXPECT_EQ(within.hit.t, 0.25);
  EXPECT_EQ(within.hit.id, 0);
  EXPECT_EQ(within.surface, 3);
  EXPECT_EQ(meet(scene, {{5, 0, 0.3}, {-1, 0, 0}}).hit.id, no_primitive);  // along the planes
  EXPECT_EQ(meet(scene, {{5, 0, 0.2}, {-1, 0, 0}}).hit.id, 0);
}

/// At equal shares of the radius it is that of the lower id.
TEST(Clips, CapBelongsToTheNearestCentre) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, 0}, 1, 0}, {{0.5F, 0, 0}, 1, 0}};
  scene.clips = {{{0, 0, 0}, {0, 0, 1}}};
  const auto at = [&](double x) { return meet(scene, {{x, 0, 5}, {0, 0, -1}}).hit.id; };
  EXPECT_EQ(at(-0.7), 0);
  EXPECT_EQ(at(0.2), 0);
  EXPECT_EQ(at(0.25), 0);
  EXPECT_EQ(at(0.3), 1);
  EXPECT_EQ(at(1.2), 1);
  std::swap(scene.spheres[0], scene.spheres[1]);
  EXPECT_EQ(at(0.2), 1);
  EXPECT_EQ(at(0.25), 0);
  EXPECT_EQ(at(0.3), 0);
  scene.spheres[0].radius = 2;  // it reaches farther
  EXPECT_EQ(at(0.16), 1);
  EXPECT_EQ(at(0.17), 0);
  scene.capsules = {{{0.1F, -1, 0}, {0.1F, 1, 0}, 0.5F, 0}};
  EXPECT_EQ(at(0.1), 3);  // behind two spheres and the plane that cuts
}

}  // namespace
}  // namespace boule::test::clips
