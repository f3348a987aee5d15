// Ghosts: films before what camera rays hit.
#include "render/integrators/ghost_films.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/integrators/aovs.h"
#include "tests/render/integrators/cut_scenes.h"
#include "tests/render/picture_comparison.h"
#include "tests/render/renderer/measured_pictures.h"
#include "tests/support/capsule_scene.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

constexpr float film_opacity = 0.3F;
const Color film_color{0.1F, 0.6F, 0.9F}, solid_color{0.7F, 0.2F, 0.4F}, sky{0.3F, 0.4F, 0.5F};

/// Everything that has this material.
Scene only(const Scene& scene, std::uint32_t material) {
  Scene some = scene;
  const auto is_other = [&](const auto& one) { return one.material.index() != material; };
  std::erase_if(some.spheres, is_other);
  std::erase_if(some.planes, is_other);
  std::erase_if(some.capsules, is_other);
  return some;
}

/// Each second sphere and capsule is a ghost; all others shine.
Scene mixed_scene(std::uint64_t seed, int clips) {
  Scene scene = clips::cut_scene(seed, clips);
  scene.materials[0].material = Emissive{solid_color};
  const auto film = add_material(scene, Ghost{film_color, film_opacity});
  for (std::size_t i = 0; i < scene.spheres.size(); i += 2) scene.spheres[i].material = film;
  for (std::size_t i = 1; i < scene.capsules.size(); i += 2) scene.capsules[i].material = film;
  scene.background = ConstantBackground{sky};
  scene.image.width = scene.image.height = 32;
  return scene;
}

/// A film over a colour, by its definition.
Rgb film_over(const Color& behind, const clips::Judged& film, const Ray& ray) {
  const auto a = static_cast<double>(film_opacity);
  const Vec3l view = unit(vec_cast<long double>(ray.dir));
  const auto c = static_cast<double>(-dot(film.normal, view));
  const double share = a / (a + (1 - a) * c);
  return Rgb(behind) * (1 - share) + Rgb(film_color) * share;
}

TEST(Ghosts, FilmsAreThoseOfLongDouble) {
  int films = 0, unsure = 0;
  for (std::uint64_t seed = 1; seed < 25; ++seed) {
    const Scene scene = mixed_scene(seed, static_cast<int>(seed % 3));
    const Scene solids = only(scene, 0), ghosts = only(scene, 1);
    const Image picture = render(scene);
    const CameraView view = build_camera(*scene.camera, 32, 32);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const Ray ray = primary_ray(view, x + 0.5, y + 0.5);
        const clips::CutJudge solid(solids, ray), ghost(ghosts, ray);
        const clips::Judged &behind = solid.nearest(), &film = ghost.nearest();
        const long double before = behind.distance - film.distance;
        const bool are_caps = before == 0;  // of one plane
        if (std::min(behind.doubt, film.doubt) < 1e-6L ||
            (std::fabs(before) < 1e-6L && !are_caps)) {
          ++unsure;
          continue;
        }
        const Color seen = behind.id == no_primitive ? sky : solid_color;
        const bool is_filmed = film.id != no_primitive && before > 0;
        const Rgb expected = is_filmed ? film_over(seen, film, ray) : Rgb(seen);
        ASSERT_LT(distance(picture.at(x, y), expected), 1e-4) << seed << ": " << x << ' ' << y;
        films += is_filmed ? 1 : 0;
      }
    }
  }
  EXPECT_GT(films, 5000);
  EXPECT_LT(unsure, 400);
}

/// The scene of all materials, with ghosts before, behind and around them.
Scene ghostly_scene(Method method) {
  Scene scene = capsule_scene(60, 45);
  scene.render.method = method;
  scene.image.spp = 4;
  const auto film = add_material(scene, Ghost{{0.2F, 0.5F, 0.9F}, 0.25F});
  scene.spheres.insert(scene.spheres.begin() + 1, {{0, 0.5F, 1}, 1.3F, film});
  scene.spheres.push_back({{-1, 1, 0}, 0.9F, MaterialRef::colored(film, {200, 90, 30})});
  scene.capsules.insert(scene.capsules.begin(), {{-2, 0, 2}, {2, 1, 1}, 0.3F, film});
  return scene;
}

Scene without_ghosts(Scene scene) {
  const auto film = static_cast<std::uint32_t>(scene.materials.size() - 1);
  const auto is_ghost = [&](const auto& one) { return one.material.index() == film; };
  std::erase_if(scene.spheres, is_ghost);
  std::erase_if(scene.capsules, is_ghost);
  return scene;
}

class GhostPictures : public testing::TestWithParam<Method> {
 protected:
  Scene scene_ = ghostly_scene(GetParam());
};

TEST_P(GhostPictures, AreThoseOfTheReferencePath) {
  expect_reference_picture(scene_);
  EXPECT_GT(differing_pixels(render(scene_), render(without_ghosts(scene_))), 600);
  scene_.clips = {{{0, 0.4F, 0}, {0.1F, 1, 0.3F}}};
  expect_reference_picture(scene_);
}

/// Nothing but their films is seen of ghosts: neither shadows nor mirror images.
TEST_P(GhostPictures, OfNoOpacityShowNothing) {
  std::get<Ghost>(scene_.materials.back().material).opacity = 0;
  EXPECT_EQ(differing_pixels(render(scene_), render(without_ghosts(scene_))), 0);
}

TEST_P(GhostPictures, IgnoreThreadsTilesCropsAndIsa) {
  scene_.image.transparent = true;
  scene_.image.fog = 0.4F;
  RenderOptions options = options_of(scene_);
  const Image picture = render(scene_, options);
  expect_picture_of_all_isas(scene_, picture);
  options.order = PixelOrder::progressive;
  options.crop = PixelRect{11, 7, 40, 33};
  const Image part = render(scene_, options);
  expect_crop_of(picture, part, 11, 7);
}

TEST_P(GhostPictures, AreWholeByAdaptiveSamples) {
  RenderOptions options = options_of(scene_);
  (GetParam() == Method::path ? options.noise : options.aa) =
      GetParam() == Method::path ? 0.02F : 4;
  options.min_spp = 16;
  options.spp = 32;
  const MeasuredPicture whole = measured(scene_, options);
  options.threads = 3;
  options.crop = PixelRect{16, 8, 48, 40};
  const PixelRect part{20, 12, 44, 36};
  EXPECT_EQ(hash_of(measured(scene_, options), part), hash_of(whole, part));
}

TEST_P(GhostPictures, AddTheirShareToAlpha) {
  Scene scene = empty_scene(9, 9);
  scene.render.method = GetParam();
  scene.image.transparent = true;
  scene.spheres = {{{0, 0, 0}, 1, add_material(scene, Ghost{{0.5F, 1, 0}, 0.25F})}};
  scene.camera = pinhole({0, 0, 4}, {0, 0, 0}, 1);
  const Image picture = render(scene);
  EXPECT_NEAR(picture.alpha[40], 0.25F, 0.5 / 255);
  EXPECT_NEAR(picture.at(4, 4).r, 0.125F, 1e-4);
}

/// A picture over its background is the one with that background.
TEST_P(GhostPictures, FadeInFogOfTransparentPictures) {
  Scene scene = empty_scene(9, 9);
  scene.render.method = GetParam();
  scene.spheres = {{{0, 0, 0}, 1, add_material(scene, Ghost{{0.5F, 1, 0}, 0.25F})},
                   {{0, 0, -4}, 0.1F, 0}};
  scene.camera = pinhole({0, 0, 4}, {0, 0, 0}, 1);
  const Color sky{0.4F, 0.2F, 0.6F};
  scene.background = ConstantBackground{{}};
  scene.backdrop = sky;
  scene.image.fog = 1;
  scene.image.fog_from = 2;
  scene.image.fog_to = 5;
  const Image over_sky = render(scene);
  scene.image.transparent = true;
  const Image picture = render(scene);
  const float left = 1 - picture.alpha[40];
  EXPECT_GT(left, 0.8F);
  EXPECT_NEAR(picture.at(4, 4).r + left * sky.r, over_sky.at(4, 4).r, 0.002);
  EXPECT_NEAR(picture.at(4, 4).b + left * sky.b, over_sky.at(4, 4).b, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Methods, GhostPictures, testing::Values(Method::whitted, Method::path));

/// Ids count ghosts; all else is as without them.
TEST(Ghosts, ChannelsAreThoseBehind) {
  const Scene scene = ghostly_scene(Method::whitted), bare = without_ghosts(scene);
  const auto with = prepare(scene, 60, 45), without = prepare(bare, 60, 45);
  ASSERT_TRUE(with && without);
  RayBuffer rays = to_stream(clips::rays_through(3, 2000));
  std::vector<Aovs> a(rays.size()), b(rays.size());
  const KernelTable& kernels = *select_kernels("auto").value();
  AovTracer(with.value(), kernels, Solver::robust).trace(rays, Coherence::none, a.data());
  AovTracer(without.value(), kernels, Solver::robust).trace(rays, Coherence::none, b.data());
  const auto spheres = static_cast<std::uint32_t>(bare.spheres.size());
  const auto planes = static_cast<std::uint32_t>(bare.planes.size());
  std::size_t kinds[3]{};
  for (std::size_t k = 0; k < rays.size(); ++k) {
    EXPECT_EQ(a[k].depth, b[k].depth);
    EXPECT_EQ(a[k].albedo, b[k].albedo);
    const std::uint32_t id = b[k].id;
    if (id == no_aov_id) continue;
    const int kind = id < spheres ? 0 : id < spheres + planes ? 1 : 2;
    ++kinds[kind];
    const std::uint32_t more = kind == 0 ? (id > 0 ? 1 : 0) : kind == 1 ? 2 : 3;
    ASSERT_EQ(a[k].id, id + more);
  }
  for (const std::size_t hits : kinds) EXPECT_GT(hits, 20U);
}

TEST(Ghosts, InstancesAndGroupsOfOutlines) {
  Scene scene = empty_scene(40, 30);
  const auto matte = add_material(scene, Matte{}), film = add_material(scene, Ghost{});
  scene.spheres = {{{-1, 0, 0}, 0.6F, matte},
                   {{0, 0, 1}, 0.5F, film},
                   {{0.5F, 0, 0}, 0.6F, matte},
                   {{1, 0, 0}, 0.6F, matte}};
  scene.outline_groups = {{1, 2, 3, 3}, {}, 3};
  scene.image.outline = 1;
  Scene bare = scene;
  bare.spheres.erase(bare.spheres.begin() + 1);
  bare.outline_groups = {{1, 3, 3}, {}, 3};
  std::get<Ghost>(scene.materials[film].material).opacity = 0;
  EXPECT_EQ(differing_pixels(render(scene), render(bare)), 0);
  // An instance in the material of a ghost is one.
  scene.groups = {{"balls", {{{0, 1, 0}, 0.5F, matte}}, {}, {}, {}}};
  scene.instances = {{0, {}, {}, 1, film}};
  EXPECT_EQ(differing_pixels(render(scene), render(bare)), 0);
  scene.instances[0].material.reset();
  EXPECT_GT(differing_pixels(render(scene), render(bare)), 10);
}

TEST(Ghosts, PlanesAreRefused) {
  Scene scene = empty_scene(4, 4);
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, add_material(scene, Ghost{})}};
  const auto refused = prepare(scene, 4, 4);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "planes cannot be ghosts");
  std::get<Ghost>(scene.materials[0].material).opacity = 1.5F;
  EXPECT_EQ(validate(scene).error().message, "must be from 0 to 1, is 1.5");
}

}  // namespace
}  // namespace boule::test
