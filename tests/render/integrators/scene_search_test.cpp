// Spheres and capsules that planes cut: hits against long double and against the definition, and
// pictures of them.
#include "render/integrators/scene_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "render/integrators/aovs.h"
#include "tests/render/picture_comparison.h"
#include "tests/render/renderer/measured_pictures.h"
#include "tests/support/capsule_scene.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/long_double_tracer.h"

namespace boule::test::clips {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Spheres and capsules that overlap and contain each other, cut by so many planes.
Scene cut_scene(std::uint64_t seed, int clips) {
  CaseRandom random(seed);
  const auto point = [&random](double size) {
    const double x = random.uniform(-size, size);
    const double y = random.uniform(-size, size);
    const double z = random.uniform(-size, size);
    return Vec3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  };
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  const int spheres = 3 + 40 * random.below(3);
  for (int i = 0; i < spheres; ++i) {
    const Vec3f center = point(2);
    scene.spheres.push_back({center, static_cast<float>(random.uniform(0.05, 1.2)), 0});
  }
  scene.spheres.push_back({scene.spheres[0].center, 1.5F * scene.spheres[0].radius, 0});  // nested
  for (int i = 0; i < 6; ++i) {
    const Vec3f a = point(2);
    scene.capsules.push_back({a, point(2), static_cast<float>(random.uniform(0.02, 0.5)), 0});
  }
  scene.planes.push_back({{0, -2.5F, 0}, {0, 1, 0}, 0});
  for (int i = 0; i < clips; ++i) {
    const Vec3f at = point(0.8);
    scene.clips.push_back({at, vec_cast<float>(random.direction() * random.uniform(0.1, 9))});
  }
  return scene;
}

/// Rays from everywhere to everywhere: many start within something, or where it is cut off.
std::vector<Ray> rays_through(std::uint64_t seed, std::size_t count) {
  CaseRandom random(seed, 1);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vec3d from = random.direction() * random.uniform(0, 6);
    const Vec3d to = random.direction() * random.uniform(0, 2);
    const double scale = random.uniform(0.1, 3);
    rays.push_back({from, vec_cast<float>((to - from) * scale)});
    if (random.chance(0.2)) rays.back().tmax = random.uniform(0.1, 1);
  }
  return rays;
}

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
    const auto offer = [&](double t, std::int32_t hit, std::int32_t surface) {
      if (t < nearest.hit.t) nearest = {{t, hit}, surface};
    };
    const auto cut = [&](const reference::Chord& chord, std::int32_t one) {
      if (!(chord.enter <= to) || !(from < chord.leave) || !(from < to)) return;
      if (chord.enter > from) return offer(chord.enter, one, one);
      if (enters != no_primitive) return offer(from, one, enters);
      if (chord.leave <= to) return offer(chord.leave, one, one);
      if (leaves != no_primitive) offer(to, one, leaves);
    };
    id = 0;
    for (const Sphere& sphere : scene_.spheres)
      cut(reference::find_chord(ray, sphere, false), id++);
    for (const Plane& plane : scene_.planes) {
      offer(reference::intersect(ray, plane, false), id, id);
      ++id;
    }
    id += static_cast<std::int32_t>(clips_.size());
    for (const Capsule& capsule : scene_.capsules)
      cut(reference::find_chord(ray, capsule, false), id++);
    return nearest;
  }

 private:
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

/// Where a line is within a primitive, in units of length; NaN: nowhere. A capsule is two balls and
/// a tube.
struct ChordL {
  long double enter, leave;
};
ChordL chord_of(const Vec3l& from, const Vec3l& h, const Vec3l& center, long double r) {
  const Vec3l f = center - from;
  const long double along = dot(f, h), miss = length(f - h * along);
  if (miss > r) return {NAN, NAN};
  const long double half = std::sqrt((r - miss) * (r + miss));
  return {along - half, along + half};
}
ChordL united(const ChordL& a, const ChordL& b) {
  if (std::isnan(a.enter)) return b;
  if (std::isnan(b.enter)) return a;
  return {std::min(a.enter, b.enter), std::max(a.leave, b.leave)};
}
ChordL chord_of(const Vec3l& from, const Vec3l& h, const Capsule& capsule) {
  const Vec3l a = vec_cast<long double>(capsule.a), b = vec_cast<long double>(capsule.b);
  const auto r = static_cast<long double>(capsule.radius);
  const ChordL balls = united(chord_of(from, h, a, r), chord_of(from, h, b, r));
  const Vec3l axis = unit(b - a), f = a - from;
  const Vec3l across = h - axis * dot(h, axis), off = f - axis * dot(f, axis);
  const long double aa = dot(across, across), along = dot(off, across) / aa;
  const long double miss = length(off - across * along);
  if (miss > r) return balls;
  const long double half = std::sqrt((r - miss) * (r + miss) / aa), rise = dot(h, axis);
  const long double low = dot(f, axis) / rise, high = (dot(f, axis) + length(b - a)) / rise;
  const ChordL tube{std::max(along - half, std::min(low, high)),
                    std::min(along + half, std::max(low, high))};
  return tube.enter < tube.leave ? united(balls, tube) : balls;
}

/// What a ray meets first of the scene that is cut, and how far the next event is from it or from
/// the decision, so that rounding cannot make another of it.
struct Judged {
  std::int32_t id = no_primitive;
  long double distance = infinity, doubt = infinity;
  Vec3l normal;
};
Judged judge(const Scene& scene, const Ray& ray) {
  const Vec3l from = vec_cast<long double>(ray.org), h = unit(vec_cast<long double>(ray.dir));
  const long double size = length(vec_cast<long double>(ray.dir));
  long double begin = 0, end = static_cast<long double>(ray.tmax) * size;
  Vec3l first, last;
  bool entered = false, left = false;
  for (const Clip& clip : scene.clips) {
    const Vec3l n = unit(vec_cast<long double>(clip.normal));
    const long double height = dot(vec_cast<long double>(clip.point) - from, n), rise = dot(h, n);
    const long double at = height / rise;
    if (rise < 0 && at > begin) begin = at, first = n, entered = true;
    if (rise > 0 && at < end) end = at, last = n, left = true;
  }
  Judged nearest;
  const auto closer = [&nearest](long double doubt) {
    nearest.doubt = std::min(nearest.doubt, std::fabs(doubt));
  };
  closer(end - begin);
  const auto offer = [&](long double at, std::int32_t id, const Vec3l& normal) {
    closer(at - nearest.distance);
    if (at < nearest.distance) nearest.id = id, nearest.distance = at, nearest.normal = normal;
  };
  std::int32_t id = 0;
  const auto cut = [&](const ChordL& chord, const auto& normal_at) {
    if (!std::isnan(chord.enter) && begin < end) {
      for (const long double at : {chord.enter, chord.leave}) closer(at - begin), closer(at - end);
      closer(chord.leave - chord.enter);
      if (chord.enter < end && chord.leave > begin) {
        if (chord.enter > begin) {
          offer(chord.enter, id, normal_at(from + h * chord.enter));
        } else if (entered) {
          if (begin < nearest.distance) offer(begin, id, first);
        } else if (chord.leave < end) {
          offer(chord.leave, id, normal_at(from + h * chord.leave) * -1.0L);
        } else if (left && end < nearest.distance) {
          offer(end, id, last * -1.0L);
        }
      }
    }
    ++id;
  };
  for (const Sphere& sphere : scene.spheres) {
    const Vec3l center = vec_cast<long double>(sphere.center);
    cut(chord_of(from, h, center, static_cast<long double>(sphere.radius)),
        [&](const Vec3l& p) { return unit(p - center); });
  }
  for (const Plane& plane : scene.planes) {
    const Vec3l n = unit(vec_cast<long double>(plane.normal));
    const long double at = dot(vec_cast<long double>(plane.point) - from, n) / dot(h, n);
    if (at > 0 && at < static_cast<long double>(ray.tmax) * size)
      offer(at, id, dot(h, n) > 0 ? n * -1.0L : n);
    ++id;
  }
  for (const Capsule& capsule : scene.capsules) {
    const Vec3l a = vec_cast<long double>(capsule.a), b = vec_cast<long double>(capsule.b);
    cut(chord_of(from, h, capsule), [&](const Vec3l& p) {
      const long double s = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0L, 1.0L);
      return unit(p - (a + (b - a) * s));
    });
  }
  return nearest;
}

TEST(Clips, AovsAreThoseOfLongDouble) {
  int unsure = 0, caps = 0, hits = 0;
  for (std::uint64_t seed = 100; seed < 124; ++seed) {
    const Scene scene = cut_scene(seed, 1 + static_cast<int>(seed % 3));
    const auto prepared = prepare(scene, 8, 8);
    ASSERT_TRUE(prepared);
    const std::vector<Ray> rays = rays_through(seed, 1500);
    AovTracer tracer(prepared.value(), *select_kernels("auto").value(), Solver::robust);
    RayBuffer stream = to_stream(rays);
    std::vector<Aovs> aovs(rays.size());
    tracer.trace(stream, Coherence::none, aovs.data());
    for (std::size_t k = 0; k < rays.size(); ++k) {
      Ray ray = rays[k];
      ray.tmax = float_above(ray.tmax);
      const Judged expected = judge(scene, ray);
      if (expected.doubt < 1e-6L) {
        ++unsure;
        continue;
      }
      ASSERT_EQ(aovs[k].id, static_cast<std::uint32_t>(expected.id)) << seed << ": " << k;
      if (expected.id == no_primitive) continue;
      ++hits;
      const auto away = static_cast<double>(expected.distance);
      EXPECT_NEAR(static_cast<double>(aovs[k].depth), away, 1e-6 * std::max(away, 1.0));
      const Vec3l normal = vec_cast<long double>(aovs[k].normal);
      EXPECT_LT(length(normal - expected.normal), 1e-3L) << seed << ": " << k;
      for (const Clip& clip : scene.clips) {
        const Vec3l n = unit(vec_cast<long double>(clip.normal));
        caps += length(normal - n) < 1e-6L ? 1 : 0;
      }
    }
  }
  EXPECT_LT(unsure, 400);
  EXPECT_GT(hits, 8000);
  EXPECT_GT(caps, 2000);
}

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

/// The lower id has the cap, even if the higher one is entered later.
TEST(Clips, CapBelongsToTheLowerId) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, 0}, 1, 0}, {{0.5F, 0, 0}, 1, 0}};
  scene.clips = {{{0, 0, 0}, {0, 0, 1}}};
  EXPECT_EQ(meet(scene, {{0.2, 0, 5}, {0, 0, -1}}).hit.id, 0);
  EXPECT_EQ(meet(scene, {{1.2, 0, 5}, {0, 0, -1}}).hit.id, 1);
  std::swap(scene.spheres[0], scene.spheres[1]);
  EXPECT_EQ(meet(scene, {{0.2, 0, 5}, {0, 0, -1}}).hit.id, 0);
  EXPECT_EQ(meet(scene, {{-0.7, 0, 5}, {0, 0, -1}}).hit.id, 1);
}

/// The scene of all materials, with capsules, cut through the middle of its glass.
Scene cut_picture(Method method) {
  Scene scene = capsule_scene(60, 45);
  scene.render.method = method;
  scene.image.spp = method == Method::path ? 4 : 1;
  scene.clips = {{{0, 0, 0.7F}, {0.1F, 0, 1}}, {{2, 0, 0}, {1, 0.2F, 0}}};
  return scene;
}

TEST(Clips, PicturesAreThoseOfTheReferencePath) {
  for (const Method method : {Method::whitted, Method::path}) {
    const Scene scene = cut_picture(method);
    RenderOptions options = options_of(scene);
    options.solver = Solver::reference;
    const Image expected = render(scene, options);
    options.solver = Solver::robust;
    for (const char* const isa : {"scalar", "auto"}) {
      options.isa = isa;
      options.threads = 3;
      options.tile = 7;
      EXPECT_EQ(differing_pixels(render(scene, options), expected), 0) << isa;
    }
    Scene whole = scene;
    whole.clips.clear();
    EXPECT_GT(differing_pixels(render(whole), expected), 300);
  }
}

/// One ray at a time, which knows by itself where rays go on.
TEST(Clips, RecordedRaysAddUpToThePicture) {
  const Scene scene = cut_picture(Method::whitted);
  auto renderer = Renderer::create(scene, options_of(scene)).value();
  const Image picture = renderer.render().value();
  int wrong = 0, from_caps = 0;
  for (int y = 0; y < 45; ++y) {
    for (int x = 0; x < 60; ++x) {
      RayRecord record;
      ASSERT_TRUE(renderer.record_pixel(x, y, record));
      SampleFaults faults;
      wrong += same_bits(settled(record.total(), faults), picture.at(x, y)) ? 0 : 1;
      for (const RecordedRay& ray : record.rays()) {
        const auto source = static_cast<std::size_t>(ray.ray.source);
        from_caps += source == 5 || source == 6 ? 1 : 0;  // 3 spheres, 2 planes
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(from_caps, 300);
}

TEST(Clips, WhatIsCutOffIsNotThere) {
  for (const Method method : {Method::whitted, Method::path}) {
    Scene scene = capsule_scene(60, 45);
    scene.render.method = method;
    scene.image.spp = 2;
    const Scene without = scene;
    const auto lamp = static_cast<std::uint32_t>(4);
    scene.spheres.push_back({{-40, 2, 1}, 1, lamp});
    scene.clips = {{{-30, 0, 0}, {-1, 0, 0}}};
    EXPECT_EQ(differing_pixels(render(scene), render(without)), 0);
  }
}

TEST(Clips, PlaneThatCutsNothingChangesNothing) {
  for (const Method method : {Method::whitted, Method::path}) {
    Scene scene = capsule_scene(60, 45);
    scene.render.method = method;
    scene.image.spp = 2;
    scene.spheres.push_back({{-2, 3, 1}, 0.5F, 4});  // a lamp, which paths sample
    const Image whole = render(scene);
    scene.clips = {{{0, 0, 30}, {0.1F, 0.2F, 1}}, {{0, 30, 0}, {0, 1, 0}}};
    EXPECT_EQ(differing_pixels(render(scene), whole), 0);
  }
}

/// Half a ball of glass, its flat side to the light: a ray is bent at both sides as Snell says.
TEST(Clips, GlassIsBentAtTheCap) {
  Scene scene = empty_scene(9, 9);
  add_material(scene, Glass{{1, 1, 1}, 1.5F});
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  scene.clips = {{{0, 0, 0}, {0, 0, 1}}};
  scene.camera = pinhole({2, 0, 3}, {0.25F, 0, 0}, 1);
  auto renderer = Renderer::create(scene, options_of(scene)).value();
  RayRecord record;
  ASSERT_TRUE(renderer.record_pixel(4, 4, record));
  const Vec3d view = normalize(Vec3d{-1.75, 0, -3});
  double sine = -view.x / 1.5;  // within the glass
  const RecordedRay* in = nullptr;
  for (const RecordedRay& ray : record.rays()) {
    if (in == nullptr && ray.kind == RayKind::refraction) in = &ray;
  }
  ASSERT_NE(in, nullptr);
  EXPECT_NEAR(in->ray.org.x, 0.25, 1e-6);
  EXPECT_NEAR(in->ray.org.z, 0, 1e-6);
  const Vec3d bent{-sine, 0, -std::sqrt(1 - sine * sine)};
  EXPECT_LT(length(normalize(vec_cast<double>(in->ray.dir)) - bent), 1e-6);
  // It leaves the ball behind, where |o + t d| = 1.
  const double b = 0.25 * bent.x;
  EXPECT_NEAR(in->hit.t * length(vec_cast<double>(in->ray.dir)),
              -b + std::sqrt(b * b - (0.0625 - 1)), 1e-5);
}

/// The shadow on the floor is that of what is left; the floor itself is whole.
TEST(Clips, FloorIsWholeAndShadowsAreCut) {
  Scene scene = empty_scene(9, 9);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 1, 0}, 1, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 0}};
  scene.lights = {DirectionalLight{{0, -1, 0}, {1, 1, 1}}};
  scene.clips = {{{0, 0, 0}, {1, 0, 0}}};
  scene.camera = pinhole({0.5F, 0.5F, 4}, {0.5F, 0, 0}, 1);
  const Color lit = render(scene).at(4, 4);
  EXPECT_GT(lit.r, 0.1F);
  scene.camera = pinhole({-0.5F, 0.1F, 4}, {-0.5F, 0, 0}, 1);
  EXPECT_EQ(render(scene).at(4, 4).r, 0);
}

}  // namespace
}  // namespace boule::test::clips
