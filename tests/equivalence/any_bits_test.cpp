// Any bits at all: small scenes and rays drawn from the whole of float, by rapidcheck, which
// shrinks what fails. Every kernel table equals the scalar path.
#include <rapidcheck.h>

#include <bit>
#include <cstdint>
#include <sstream>

#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

/// Mostly numbers of a scene's size, on a coarse grid so that contacts, tangents and ties happen;
/// the rest is any bit pattern. Shrinks towards 0.
rc::Gen<float> any_float() {
  const auto grid =
      rc::gen::map(rc::gen::inRange(-40, 41), [](int i) { return static_cast<float>(i) * 0.25F; });
  const auto bits = rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                                 [](std::uint32_t b) { return std::bit_cast<float>(b); });
  return rc::gen::weightedOneOf<float>({{8, grid}, {1, bits}});
}

Vec3f any_vector() {
  const float x = *any_float();
  const float y = *any_float();
  const float z = *any_float();
  return {x, y, z};
}

Ray any_ray(int primitives) {
  Ray ray;
  ray.org = vec_cast<double>(any_vector());
  ray.dir = any_vector();
  if (*rc::gen::inRange(0, 4) == 0) ray.tmin = *any_float();
  if (*rc::gen::inRange(0, 4) == 0) ray.tmax = *any_float();
  if (*rc::gen::inRange(0, 4) == 0) ray.source = *rc::gen::inRange(0, primitives);
  return ray;  // never `inside`: that promises an origin on the sphere (row L of the hard cases)
}

std::string text_of(const Ray& ray, const Hit& expected, const Hit& found) {
  std::ostringstream out;
  out << std::hexfloat << "org " << ray.org.x << " " << ray.org.y << " " << ray.org.z << " dir "
      << ray.dir.x << " " << ray.dir.y << " " << ray.dir.z << " in " << ray.tmin << " .. "
      << ray.tmax << " source " << ray.source << (ray.inside ? " inside" : "") << ": expected id "
      << expected.id << " t " << expected.t << ", found " << found.id << " " << found.t;
  return out.str();
}

TEST(AnyBits, EveryTableEqualsTheScalarPath) {
  const bool passed = rc::check([] {
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    for (int i = *rc::gen::inRange(0, 30); i > 0; --i) {
      const Vec3f center = any_vector();
      spheres.push_back({center, *any_float(), 0});
    }
    for (int i = *rc::gen::inRange(0, 3); i > 0; --i) {
      const Vec3f point = any_vector();
      planes.push_back({point, any_vector(), 0});
    }
    std::vector<Ray> rays;
    for (int i = *rc::gen::inRange(1, 20); i > 0; --i) {
      rays.push_back(any_ray(static_cast<int>(spheres.size() + planes.size()) + 1));
    }
    const Structure structure = *rc::gen::element(Structure::scan, Structure::bvh);
    const Geometry geometry(spheres, planes, structure);
    std::vector<Hit> expected;
    for (const Ray& ray : rays) expected.push_back(reference::closest_hit(ray, spheres, planes));
    const auto check_nearest = [&](const std::vector<Hit>& hits) {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!same_bits(hits[i], expected[i])) RC_FAIL(text_of(rays[i], expected[i], hits[i]));
      }
    };
    for (const IsaInfo& isa : list_isas()) {
      if (!isa.supported) continue;
      const KernelTable& kernels = *select_kernels(isa.name).value();
      if (geometry.view().bvh.size > 0) check_nearest(run_sorted(kernels, geometry.view(), rays));
      for (const Form form : {Form::packet, Form::single, Form::flight, Form::set}) {
        const Query query{Solver::robust, form, Coherence::none};
        check_nearest(run_closest(kernels, geometry.view(), rays, query));
        const auto occluded = run_any(kernels, geometry.view(), rays, query);
        for (std::size_t i = 0; i < rays.size(); ++i)
          RC_ASSERT(occluded[i] == (expected[i].id == no_primitive ? 0 : 1));
      }
    }
  });
  EXPECT_TRUE(passed);
}

}  // namespace
}  // namespace boule::test
