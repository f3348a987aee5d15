// A picture does not depend on how its rays are traced: with a scan of all spheres or with a tree,
// in bundles, in packets or one by one.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "render/frame/film.h"
#include "render/integrators/whitted.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/block_worker.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/test_scenes.h"

namespace boule::test::query_forms {
namespace {

constexpr int side = 64;

/// mixed_scene() among a thousand small spheres.
Scene crowded_scene() {
  Scene scene = mixed_scene(side, side);
  CaseRandom random(77);
  const std::size_t materials = scene.materials.size();
  for (std::size_t i = 0; i < 1000; ++i) {
    Sphere sphere;
    sphere.center = {static_cast<float>(random.uniform(-3, 3)),
                     static_cast<float>(random.uniform(0, 3)),
                     static_cast<float>(random.uniform(-3, 3))};
    sphere.radius = static_cast<float>(random.uniform(0.02, 0.12));
    sphere.material = static_cast<std::uint32_t>(i % materials);
    scene.spheres.push_back(sphere);
  }
  return scene;
}

// Kernels of one ISA that trace all rays in one form. A KernelTable has plain functions, so the
// kernels to which they forward are in a global variable.
const KernelTable* forwarded = nullptr;
std::uint64_t calls = 0;

template <Form form>
void closest_in(const GeometryView& geometry, const RayStream& rays, const Query& query,
                const HitStream& hits) {
  ++calls;
  forwarded->closest_hit(geometry, rays, {query.solver, form, query.coherence}, hits);
}
template <Form form>
void any_in(const GeometryView& geometry, const RayStream& rays, const Query& query,
            std::uint8_t* occluded) {
  ++calls;
  forwarded->any_hit(geometry, rays, {query.solver, form, query.coherence}, occluded);
}
template <Form form>
KernelTable kernels_in() {
  KernelTable kernels = *forwarded;
  kernels.closest_hit = closest_in<form>;
  kernels.any_hit = any_in<form>;
  return kernels;
}

/// The bits of the pixels.
std::vector<std::uint32_t> picture(const Scene& scene, Structure structure,
                                   const KernelTable& kernels) {
  PreparedScene prepared = prepare(scene, side, side).value();
  prepared.geometry = Geometry(scene.spheres, prepared.planes, structure);
  const BlockSetup setup{prepared, kernels, Sampler(2, 1), block_pixels(side), 16384, Alpha::none};
  BlockWorker worker(setup, std::make_unique<Whitted>(prepared, kernels, IntegratorSettings{}));
  const PixelRect all{0, 0, side, side};
  Film film(all);
  EXPECT_TRUE(worker.render(all, 2, film));
  std::vector<std::uint32_t> bits;
  for (const Color& pixel : film.to_image().pixels) {
    for (const float x : {pixel.r, pixel.g, pixel.b})
      bits.push_back(std::bit_cast<std::uint32_t>(x));
  }
  return bits;
}

class Paths : public OnEachIsa {};

TEST_P(Paths, GiveTheSamePicture) {
  forwarded = kernels;
  const Scene pinhole_scene = crowded_scene();
  Scene parallel_scene = pinhole_scene;
  parallel_scene.camera = OrthographicCamera{{{2, 4, 6}, {0, 0.5f, 0}, {0, 1, 0}}, 6};
  for (const Scene& scene : {pinhole_scene, parallel_scene}) {
    const auto expected = picture(scene, Structure::scan, reference_kernels());
    ASSERT_EQ(expected.size(), std::size_t{3} * side * side);
    for (const Structure structure : {Structure::scan, Structure::bvh}) {
      SCOPED_TRACE(structure == Structure::scan ? "scan" : "tree");
      const auto check = [&](const KernelTable& table, const char* form) {
        calls = 0;
        EXPECT_EQ(picture(scene, structure, table), expected) << form;
        EXPECT_GT(calls, 10U) << form;
      };
      check(kernels_in<Form::automatic>(), "bundles");
      check(kernels_in<Form::packet>(), "packets");
      check(kernels_in<Form::single>(), "single rays");
      check(kernels_in<Form::flight>(), "rays in flight");
      check(kernels_in<Form::set>(), "sets");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, Paths, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::query_forms
