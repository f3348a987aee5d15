// Geometry and rays of any bits: every kernel table, structure, form and hint against the scalar
// path.
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "core/reference.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"
#include "tests/fuzz/input_budget.h"
#include "tests/fuzz/require.h"

namespace {

using namespace boule;
using fuzz::require;

/// The fuzzer's bytes one after the other; behind the last, zeros.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  template <class T>
  T take() {
    T value{};
    const std::size_t count = left_ < sizeof value ? left_ : sizeof value;
    if (count > 0) std::memcpy(&value, at_, count);
    at_ += count;
    left_ -= count;
    return value;
  }
  unsigned below(unsigned end) { return take<std::uint8_t>() % end; }

  /// Mostly on a coarse grid, so that contacts, tangents and ties happen; the rest any bits.
  float any_float() {
    const auto grid = take<std::int8_t>();
    return grid == -128 ? std::bit_cast<float>(take<std::uint32_t>())
                        : static_cast<float>(grid) * 0.25F;
  }
  Vec3f any_vector() {
    const float x = any_float(), y = any_float(), z = any_float();
    return {x, y, z};
  }
  /// Never `inside`: that promises an origin on the sphere.
  Ray any_ray(int primitives) {
    const unsigned what = take<std::uint8_t>();
    Ray ray;
    ray.org = vec_cast<double>(any_vector());
    if ((what & 1) != 0) ray.org.x += 0.1;  // no float
    ray.dir = any_vector();
    if ((what & 2) != 0) ray.tmin = any_float();
    if ((what & 4) != 0) ray.tmax = any_float();
    if ((what & 8) != 0) ray.source = static_cast<int>(below(256)) % (primitives + 1);
    return ray;
  }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

struct Case {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  std::vector<Ray> rays;
  std::vector<Hit> expected;
};

Case make_case(Bytes& bytes) {
  Case made;
  for (unsigned i = bytes.below(200); i > 0; --i) {
    const Vec3f center = bytes.any_vector();
    made.spheres.push_back({center, bytes.any_float(), 0});
  }
  for (unsigned i = bytes.below(4); i > 0; --i) {
    const Vec3f point = bytes.any_vector();
    made.planes.push_back({point, bytes.any_vector(), 0});
  }
  const auto primitives = static_cast<int>(made.spheres.size() + made.planes.size());
  const Ray first = bytes.any_ray(primitives);
  const unsigned shared = bytes.below(3);  // by all rays: nothing, the origin, the direction
  for (unsigned i = 1 + bytes.below(80); i > 0; --i) {
    Ray ray = bytes.any_ray(primitives);
    if (shared == 1) ray.org = first.org;
    if (shared == 2) ray.dir = first.dir;
    made.rays.push_back(ray);
    made.expected.push_back(reference::closest_hit(ray, made.spheres, made.planes));
  }
  return made;
}

std::string text_of(const KernelTable& kernels, const Query& query, std::size_t ray) {
  return std::to_string(kernels.width) + " lanes, form " +
         std::to_string(static_cast<int>(query.form)) + ", hint " +
         std::to_string(static_cast<int>(query.coherence)) + ": ray " + std::to_string(ray);
}

void compare(const KernelTable& kernels, const GeometryView& geometry, const Query& query,
             const Case& made, RayBuffer& rays) {
  HitBuffer hits(made.rays.size());
  kernels.closest_hit(geometry, rays.view(), query, hits.view());
  AlignedArray<std::uint8_t> occluded(made.rays.size(), 255);
  kernels.any_hit(geometry, rays.view(), query, occluded.data());
  for (std::size_t i = 0; i < made.rays.size(); ++i) {
    const Hit hit = hits.get(i), expected = made.expected[i];
    const bool same = hit.id == expected.id && std::bit_cast<std::uint64_t>(hit.t) ==
                                                   std::bit_cast<std::uint64_t>(expected.t);
    require(same, "the scalar path's hit, " + text_of(kernels, query, i));
    require(occluded[i] == (expected.id == no_primitive ? 0 : 1),
            "the scalar path's shadow, " + text_of(kernels, query, i));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputBudget budget;
  Bytes bytes(data, size);
  const Case made = make_case(bytes);
  RayBuffer rays(made.rays.size());
  for (std::size_t i = 0; i < made.rays.size(); ++i) rays.set(i, made.rays[i]);
  for (const Structure structure : {Structure::scan, Structure::bvh}) {
    const Geometry geometry(made.spheres, made.planes, structure);
    for (const IsaInfo& isa : list_isas()) {
      if (!isa.supported) continue;
      const KernelTable& kernels = *select_kernels(isa.name).value();
      for (const Form form : {Form::automatic, Form::packet, Form::single, Form::flight, Form::set})
        compare(kernels, geometry.view(), {Solver::robust, form, Coherence::none}, made, rays);
      for (const Coherence hint : {Coherence::common_origin, Coherence::common_direction})
        compare(kernels, geometry.view(), {Solver::robust, Form::automatic, hint}, made, rays);
    }
  }
  return 0;
}
