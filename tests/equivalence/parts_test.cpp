// Groups that are shown many times, and not written out: the answers are, bit for bit, those of the
// scene written out.
#include <algorithm>
#include <cmath>

#include "core/reference.h"
#include "core/surface.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/placed_groups.h"

namespace boule::test::parts {
namespace {

/// Turned, scaled and shifted copies that overlap, one sphere a giant among the others.
PlacedGroups overlapping() {
  CaseRandom random(81);
  PlacedGroups scene{"overlapping copies", {}, {}};
  scene.groups.push_back(cube_of_spheres(random, 200, {0, 0, 0}, 1, 0.1));
  scene.groups.push_back(cube_of_spheres(random, 40, {0.5, 0, 0}, 1, 0.2));
  scene.groups[1].push_back({{0, -0.4F, 0}, 0.9F, 0});
  scene.places.push_back({1, std::nullopt});
  for (std::size_t i = 0; i < 20; ++i)
    scene.places.push_back({i % 2, random_placement(random, 0.5, 1.5)});
  return scene;
}

/// Every place three times, in turn with others: equal t, which goes to the lower id. Turned by
/// quarters and moved by whole numbers, spheres on whole numbers meet each other exactly, too.
PlacedGroups ties() {
  PlacedGroups scene{"ties", {}, {}};
  scene.groups.emplace_back();
  for (int i = 0; i < 64; ++i) {
    const Vec3f at{static_cast<float>(i % 4), static_cast<float>(i / 4 % 4),
                   static_cast<float>(i / 16)};
    scene.groups[0].push_back({at, 0.5F, 0});
  }
  scene.groups.push_back(scene.groups[0]);
  std::reverse(scene.groups[1].begin(), scene.groups[1].end());
  for (std::size_t i = 0; i < 24; ++i) {
    const auto turn = static_cast<double>(i % 4);
    scene.places.push_back(
        {i % 2, placed({90 * turn, 180 * turn, 0}, 1, {1 - turn, 2, static_cast<double>(i % 3)})});
  }
  scene.places.push_back({0, std::nullopt});
  return scene;
}

/// Copies of few spheres, so that a leaf's box is that of one sphere, which rays touch where the
/// sphere touches its box. `far`: how far the group is from its own origin; the places bring it
/// back, and then move it by `away`.
PlacedGroups tight_boxes(const std::string& name, double far, double radius, double scale,
                         const Vec3d& away = {}) {
  CaseRandom random(82);
  PlacedGroups scene{name, {}, {}};
  scene.groups.emplace_back();
  const Vec3d center{far, -far, far};
  for (int i = 0; i < 12; ++i)
    scene.groups[0].push_back({vec_cast<float>(center + random_point(random, 20 * radius)),
                               static_cast<float>(radius), 0});
  for (std::size_t i = 12; i < 420; ++i) scene.groups[0].push_back(scene.groups[0][i % 12]);
  for (int i = 0; i < 6; ++i) {
    const Vec3d turned = i % 2 == 0 ? Vec3d{0, 0, 90.0 * i} : random_point(random, 180);
    Similarity transform = placed(turned, scale, {});
    const Vec3d by = random_point(random, 30 * radius * scale);
    transform.shift = transform.apply(center) * -1.0 + by + away;
    scene.places.push_back({0, transform});
  }
  return scene;
}

PlacedGroups far_away() {
  PlacedGroups scene = overlapping();
  scene.name = "1e6 from the origin";
  scene.places[0].transform = placed({}, 1, {});
  for (auto& place : scene.places)
    place.transform->shift = place.transform->shift + Vec3d{1e6, 0, -1e6};
  return scene;
}

PlacedGroups of_sizes() {
  CaseRandom random(83);
  PlacedGroups scene{"of very different sizes", {cube_of_spheres(random, 100, {}, 1, 0.2)}, {}};
  for (int i = 0; i < 24; ++i)
    scene.places.push_back({0, random_placement(random, std::pow(10.0, i % 8 - 4), 1)});
  return scene;
}

/// A group near the end of what floats can hold, brought back by its scale.
PlacedGroups of_denormals() {
  CaseRandom random(84);
  PlacedGroups scene{"of denormals", {cube_of_spheres(random, 100, {}, 2e-40, 2e-41)}, {}};
  for (int i = 0; i < 6; ++i) {
    const Vec3d degrees = random_point(random, 180);
    scene.places.push_back({0, placed(degrees, 3e38, random_point(random, 0.05))});
  }
  return scene;
}

std::vector<PlacedGroups> scenes() {
  return {overlapping(),
          ties(),
          tight_boxes("tight boxes", 0, 1, 1),
          tight_boxes("tight boxes far away in their group", 1e5, 0.1, 1),
          tight_boxes("specks far away in their group", 1e6, 0.01, 3),
          tight_boxes("tight boxes in units of 1e12", 1e13, 1e9, 0.1),
          tight_boxes("tight boxes that are shown far away", 0, 1, 1, {1e6, 0.7e6, -1.3e6}),
          tight_boxes("tight boxes of denormals", 0, 2e-41, 3e38),
          tight_boxes("tight boxes of the smallest floats", 0, 100 * 0x1p-149, 3e38),
          far_away(),
          of_sizes(),
          of_denormals()};
}

/// Towards the rim of a sphere, one in three where that lies farthest along an axis.
Vec3d rim_of(CaseRandom& random, const Sphere& sphere, const Vec3d& eye) {
  const Vec3d center = vec_cast<double>(sphere.center);
  const Vec3d view = normalize(center - eye);
  const double beta = 1 + random.sign() * random.decade(-8, -1);
  Vec3d side = random.perpendicular(view);
  if (random.chance(0.4)) {
    const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Vec3d axis = axes[random.below(3)], upright = axis - view * dot(axis, view);
    if (length(upright) > 1e-3) side = normalize(upright) * random.sign();
  }
  return center + side * (beta * double{sphere.radius});
}

double size_of(const Sphere& sphere) { return 40 * double{sphere.radius}; }

/// Rays of nothing in common: from near spheres, from surfaces, of all lengths.
std::vector<Ray> scattered_rays(const std::vector<Sphere>& spheres, int count) {
  CaseRandom random(91);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const Sphere& sphere =
        spheres[static_cast<std::size_t>(random.below(static_cast<int>(spheres.size())))];
    const Vec3d center = vec_cast<double>(sphere.center);
    Vec3d eye = center + random.direction() * (size_of(sphere) * random.decade(-1, 1));
    if (i % 3 != 0) eye = vec_cast<double>(vec_cast<float>(eye));
    Ray ray{eye, vec_cast<float>(rim_of(random, sphere, eye) - eye)};
    if (i % 7 == 0) ray.tmax = static_cast<float>(random.uniform(0.5, 1.5));
    if (i % 11 == 0) ray.tmin = -1;
    if (i % 13 == 0) ray.dir = vec_cast<float>(random.direction());
    const Hit hit = reference::closest_hit(ray, spheres, {});
    if (i % 2 == 0 && hit.id >= 0) {
      const Surface surface = find_surface(spheres, {}, ray, hit);
      ray = leave(surface, i % 4 == 0 ? Side::viewer : Side::beyond, random.direction());
    }
    rays.push_back(ray);
  }
  return rays;
}

/// Tiles of 256 rays that share an origin, a direction, or an end.
std::vector<Ray> tile_of_rays(CaseRandom& random, const std::vector<Sphere>& spheres,
                              Coherence coherence) {
  const Sphere& sphere =
      spheres[static_cast<std::size_t>(random.below(static_cast<int>(spheres.size())))];
  const Vec3d center = vec_cast<double>(sphere.center);
  const Vec3d eye = vec_cast<double>(
      vec_cast<float>(center + random.direction() * (size_of(sphere) * random.decade(-1, 1))));
  const Vec3d middle = rim_of(random, sphere, eye), view = middle - eye;
  const double width = std::min(0.2 * length(view), double{sphere.radius} * random.decade(-3, 1.5));
  const Vec3d right = random.perpendicular(normalize(view)) * width;
  const Vec3d up = normalize(cross(view, right)) * width;
  std::vector<Ray> rays;
  for (int i = 0; i < 256; ++i) {
    const Vec3d offset = right * ((i % 16 - 7.5) / 8) + up * ((i / 16 - 7.5) / 8);
    if (coherence == Coherence::common_origin) {
      rays.push_back({eye, vec_cast<float>(view + offset)});
    } else if (coherence == Coherence::common_direction) {
      rays.push_back({eye + offset, vec_cast<float>(view)});
    } else {
      const Vec3d org = middle + offset;
      rays.push_back({org, vec_cast<float>(eye - org)});
      rays.back().tmax = static_cast<float>(short_of_the_end);
    }
  }
  return rays;
}

class Parts : public OnEachIsa {
 protected:
  void check(const std::string& name, const Geometry& geometry, const std::vector<Ray>& rays,
             const std::vector<Hit>& expected, const Query& query) {
    if (query.coherence != Coherence::common_end) {
      const auto hits = run_closest(*kernels, geometry.view(), rays, query);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(same_bits(hits[i], expected[i]))
            << name << " ray " << i << " form " << static_cast<int>(query.form) << " common "
            << static_cast<int>(query.coherence) << ": " << hits[i].id << " " << hits[i].t
            << ", expected " << expected[i].id << " " << expected[i].t;
        met += expected[i].id == no_primitive ? 0U : 1U;
      }
    }
    const auto occluded = run_any(*kernels, geometry.view(), rays, query);
    for (std::size_t i = 0; i < rays.size(); ++i)
      ASSERT_EQ(occluded[i], expected[i].id == no_primitive ? 0 : 1) << name << " ray " << i;
  }
  static std::vector<Hit> hits_of(const std::vector<Ray>& rays, const std::vector<Sphere>& spheres,
                                  const std::vector<Plane>& planes) {
    std::vector<Hit> hits;
    for (const Ray& ray : rays) hits.push_back(reference::closest_hit(ray, spheres, planes));
    return hits;
  }
  std::size_t met = 0;
};

TEST_P(Parts, ScatteredRaysMatchTheExpandedScene) {
  for (const PlacedGroups& scene : scenes()) {
    const std::vector<Sphere> all = scene.written_out();
    const std::vector<Ray> rays = scattered_rays(all, 700);
    const std::vector<Hit> expected = hits_of(rays, all, {});
    met = 0;
    for (const Structure structure : {Structure::bvh, Structure::scan}) {
      const Geometry geometry = scene.in_parts({}, structure);
      for (const Form form : {Form::automatic, Form::packet, Form::single})
        check(scene.name, geometry, rays, expected, {Solver::robust, form, Coherence::none});
    }
    EXPECT_GT(met, rays.size()) << scene.name;
  }
}

TEST_P(Parts, BundlesMatchTheExpandedScene) {
  for (const PlacedGroups& scene : scenes()) {
    CaseRandom random(92);
    const std::vector<Sphere> all = scene.written_out();
    const Geometry geometry = scene.in_parts({}, Structure::bvh);
    met = 0;
    for (int tile = 0; tile < 24; ++tile) {
      for (const Coherence common :
           {Coherence::common_origin, Coherence::common_direction, Coherence::common_end}) {
        const std::vector<Ray> rays = tile_of_rays(random, all, common);
        check(scene.name, geometry, rays, hits_of(rays, all, {}),
              {Solver::robust, Form::automatic, common});
      }
    }
    EXPECT_GT(met, 1000U) << scene.name;
  }
}

TEST_P(Parts, SolverFastMatchesTheExpandedScene) {
  const PlacedGroups scene = overlapping();
  const std::vector<Sphere> all = scene.written_out();
  const std::vector<Ray> rays = scattered_rays(all, 700);
  const Query query{Solver::fast, Form::packet, Coherence::none};
  const auto expected = run_closest(*kernels, Geometry(all, {}).view(), rays, query);
  check(scene.name, scene.in_parts({}, Structure::bvh), rays, expected, query);
}

TEST_P(Parts, PlanesHaveTheIdsAfterAllSpheres) {
  const PlacedGroups scene = overlapping();
  const std::vector<Sphere> all = scene.written_out();
  const std::vector<Plane> planes{{{0, -1, 0}, {0, 1, 0}, 0}, {{0, 0, -3}, {0, 0, 1}, 0}};
  const std::vector<Ray> rays = scattered_rays(all, 700);
  const Geometry geometry = scene.in_parts(planes, Structure::bvh);
  EXPECT_EQ(geometry.sphere_count(), all.size());
  check(scene.name, geometry, rays, hits_of(rays, all, planes), {});
  check(scene.name, geometry, rays, run_closest(reference_kernels(), geometry.view(), rays, {}),
        {});
}

/// More parts than one node has children, and few rays that meet many of them.
TEST_P(Parts, ThousandsOfThemAreFound) {
  CaseRandom random(85);
  PlacedGroups scene{"thousands", {cube_of_spheres(random, 20, {}, 1, 0.3)}, {}};
  for (int i = 0; i < 3000; ++i) scene.places.push_back({0, random_placement(random, 0.1, 3)});
  const std::vector<Sphere> all = scene.written_out();
  std::vector<Ray> rays;
  for (int i = 0; i < 100; ++i) {
    const Vec3d org = random.direction() * 6.0;
    rays.push_back({org, vec_cast<float>(random_point(random, 3) - org)});
  }
  check(scene.name, scene.in_parts({}, Structure::bvh), rays, hits_of(rays, all, {}), {});
  EXPECT_GT(met, 50U);
}

TEST_P(Parts, SurfacesMatchTheExpandedScene) {
  const PlacedGroups scene = overlapping();
  const std::vector<Sphere> all = scene.written_out();
  const std::vector<Ray> rays = scattered_rays(all, 300);
  const Geometry geometry = scene.in_parts({}, Structure::bvh), whole(all, {});
  for (std::size_t slot = 0; slot < all.size(); ++slot) {
    const auto hits = run_closest(*kernels, geometry.view(), {rays[slot % rays.size()]}, {});
    if (hits[0].id < 0) continue;
    const Sphere found = geometry.sphere(hits[0].slot);
    const Sphere& expected = all[static_cast<std::size_t>(hits[0].id)];
    ASSERT_TRUE(found.center == expected.center && found.radius == expected.radius) << slot;
    if (slot > rays.size()) break;
  }
}

/// 30,000 copies of 100,000 spheres side by side, over a plane; one is shown a second time.
struct ManyCopies {
  static constexpr std::uint32_t copies = 30'000, spheres = 100'000, again = 25'000, first = 10;
  std::vector<Sphere> group;
  Geometry geometry = Geometry({}, {});

  ManyCopies() {
    CaseRandom random(86);
    group = cube_of_spheres(random, spheres, {}, 1, 0.02);
    const auto tree = std::make_shared<const Geometry>(group, std::vector<Plane>(), Structure::bvh);
    std::vector<GeometryPart> parts;
    for (std::uint32_t i = 0; i < copies; ++i) parts.push_back({tree, place(i), {}});
    geometry = Geometry::of_parts(std::move(parts), {{{0, 0, -2}, {0, 0, 1}, 0}});
  }
  static Similarity place(std::uint32_t copy) {
    const std::uint32_t i = copy == again ? first : copy;
    const Vec3d degrees{0, 0, 90.0 * (i % 4)};
    return placed(degrees, 1, {3.0 * (i % 200), 3.0 * (i / 200), 0});
  }
  [[nodiscard]] std::vector<Sphere> shown_by(std::uint32_t copy) const {
    std::vector<Sphere> all;
    for (const Sphere& one : group) all.push_back(transformed(one, place(copy), {}));
    return all;
  }
};

/// Rays to one of the copies, and what they meet: its spheres, or the plane.
struct RaysToCopy {
  std::vector<Sphere> spheres;
  std::vector<Ray> primary, all;  ///< the primary ones share their origin
  std::vector<Hit> expected;      ///< of all, the primary ones first

  RaysToCopy(const ManyCopies& scene, std::uint32_t copy) : spheres(scene.shown_by(copy)) {
    CaseRandom random(87);
    const Vec3d middle = ManyCopies::place(copy).shift, eye = middle + Vec3d{0, 0, 2};
    for (int i = 0; i < 48; ++i) {
      const Vec3d to = middle + random_point(random, 0.9);
      add({eye, vec_cast<float>(Vec3d{to.x, to.y, -1} - eye)});
    }
    primary = all;
    for (std::size_t i = 0; i < 16; ++i) {  // rays that leave what the others have met
      const Surface surface = find_surface(spheres, planes_, all[i], expected[i]);
      const Vec3d way = random.direction() * 0.1 + Vec3d{0, 0, i % 2 == 0 ? 1.0 : -1.0};
      const bool out = dot(way, surface.normal) > 0;
      add(leave(surface, out ? Side::viewer : Side::beyond, way));
    }
    for (Ray& ray : all) ray.source = moved(ray.source, copy);
    for (Hit& hit : expected) hit.id = moved(hit.id, copy);
  }

 private:
  void add(const Ray& ray) {
    all.push_back(ray);
    expected.push_back(reference::closest_hit(ray, spheres, planes_));
  }
  /// The id in the whole scene.
  [[nodiscard]] std::int32_t moved(std::int32_t id, std::uint32_t copy) const {
    if (id == no_primitive) return id;
    const auto own = static_cast<std::uint32_t>(id);
    const bool is_plane = own == spheres.size();
    return static_cast<std::int32_t>(is_plane ? 3'000'000'000U : own + copy * ManyCopies::spheres);
  }

  std::vector<Plane> planes_{{{0, 0, -2}, {0, 0, 1}, 0}};
};

TEST_P(Parts, IdsAndSlotsBeyond31BitsAreRight) {
  static const ManyCopies scene;
  const GeometryView view = scene.geometry.view();
  ASSERT_EQ(scene.geometry.sphere_count(), 3'000'000'000U);
  std::uint32_t last_slot = 0;
  for (const std::uint32_t copy : {0U, ManyCopies::first, 21'474U, ManyCopies::copies - 1}) {
    const RaysToCopy rays(scene, copy);
    for (const Form form : {Form::automatic, Form::packet, Form::single}) {
      const Query query{Solver::robust, form, Coherence::none};
      check("many", scene.geometry, rays.all, rays.expected, query);
    }
    check("many", scene.geometry, rays.primary, rays.expected,
          {Solver::robust, Form::automatic, Coherence::common_origin});
    for (const Hit& hit : run_closest(*kernels, view, rays.all, {})) {
      if (scene.geometry.is_plane(hit) || hit.id == no_primitive) continue;
      last_slot = std::max(last_slot, hit.slot);
      const Sphere found = scene.geometry.sphere(hit.slot);
      const Sphere& sphere =
          rays.spheres[static_cast<std::uint32_t>(hit.id) - copy * ManyCopies::spheres];
      ASSERT_TRUE(found.center == sphere.center && found.radius == sphere.radius) << copy;
    }
  }
  EXPECT_GT(last_slot, 3'000'000'000U);
}

INSTANTIATE_TEST_SUITE_P(Tables, Parts, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::parts
