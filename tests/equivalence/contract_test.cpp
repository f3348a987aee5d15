// The contract for degenerate inputs, case by case: every kernel table, packet and single, closest
// and any hit, and the scalar path give the stated t.
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/kernel_runs.h"

namespace boule::test::contract {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float largest = std::numeric_limits<float>::max();
constexpr double miss = std::numeric_limits<double>::infinity();

struct Case {
  std::string name;
  std::variant<Sphere, Plane> primitive;
  Ray ray;
  double t;
};

Ray with(Ray ray, float tmin, float tmax) {
  ray.tmin = tmin;
  ray.tmax = tmax;
  return ray;
}

const Sphere ahead{{0, 0, -5}, 1, 0};  // met at 4 and 6
const Sphere unit{{0, 0, 0}, 1, 0};
const Plane wall{{0, 0, -5}, {0, 0, 2}, 0};
const Ray forward{{0, 0, 0}, {0, 0, -1}};

std::vector<Case> sphere_cases() {
  return {
      {"plain", ahead, forward, 4},
      {"negative radius is its size", Sphere{{0, 0, -5}, -1, 0}, forward, 4},
      {"minus zeros", ahead, {{-0.0, -0.0, 0}, {-0.0F, -0.0F, -1}}, 4},
      {"tangent", Sphere{{1, 0, -5}, 1, 0}, forward, 5},
      {"tangent, beside", Sphere{{1.0000001F, 0, -5}, 1, 0}, forward, miss},
      {"point through its centre", Sphere{{0, 0, -5}, 0, 0}, forward, 5},
      {"point, beside", Sphere{{1e-30F, 0, -5}, 0, 0}, forward, miss},
      {"behind", ahead, {{0, 0, -10}, {0, 0, -1}}, miss},
      {"from inside", ahead, {{0, 0, -5}, {0, 0, -1}}, 1},
      {"from the surface outward", unit, {{1, 0, 0}, {1, 0, 0}}, miss},
      {"from the surface along it", unit, {{1, 0, 0}, {0, 1, 0}}, miss},
      {"from the surface inward", unit, {{1, 0, 0}, {-1, 0, 0}}, 2},
      {"tmax is live", ahead, with(forward, 0, 4), 4},
      {"before tmax", ahead, with(forward, 0, 3.9999998F), miss},
      {"tmin is not live: the other root", ahead, with(forward, 4, inf), 6},
      {"beyond both roots", ahead, with(forward, 6, inf), miss},
      {"negative tmin sees behind", unit, with({{0, 0, -5}, {0, 0, -1}}, -10, inf), -6},
      {"empty interval", ahead, with(forward, 5, 3), miss},
      {"NaN in tmin", ahead, with(forward, nan, inf), miss},
      {"NaN in tmax", ahead, with(forward, 0, nan), miss},
      {"infinite tmin", ahead, with(forward, -inf, inf), 4},
      {"direction 0", unit, {{0, 0, 0}, {0, 0, 0}}, miss},
      {"long direction", ahead, {{0, 0, 0}, {0, 0, -0x1p100F}}, 0x4p-100},
      {"short direction", ahead, {{0, 0, 0}, {0, 0, -0x1p-100F}}, 0x4p100},
      {"denormal direction",
       Sphere{{0, 0, -0x1p-120F}, 0x1p-121F, 0},
       {{0, 0, 0}, {0, 0, -0x1p-149F}},
       0x1p28},
      {"t is the largest float", Sphere{{0, 0, -largest}, 0, 0}, forward, double{largest}},
      {"t above the largest float",
       Sphere{{0, 0, -16}, 1, 0},
       {{0, 0, 0}, {0, 0, -0x1p-126F}},
       miss},
      {"huge sphere from outside", Sphere{{0, 0, -0x1p90F}, 0x1p89F, 0}, forward, 0x1p89},
      {"infinite radius is no sphere", Sphere{{0, 0, -5}, inf, 0}, forward, miss},
      // l.l overflows in float where r^2 does not (F / r = 4e5).
      {"overflow beside the rim",
       Sphere{{0x1.74922p+80F, -0x1.ed391p+79F, -0x1.6bfa2ep+77F}, 0x1.ffffbp+63F, 0},
       {{0, 0, 0}, {0x1.a8be82p-1F, -0x1.1926a8p-1F, -0x1.9ef60ap-4F}},
       2.1208418323257283e24},
      // The discriminant is 0 and b is 1e-16: cc / q would be noise over noise.
      {"tangent at the origin's own point",
       unit,
       {{0x1.5ebe53f526312p-4, -0x1.ee00c0d76ad3dp-1, -0x1.fcd913716db71p-3},
        {-0x1.f9eb8p-1F, -0x1.d3a9bap-4F, 0x1.a52d5cp-4F}},
       miss},
  };
}

std::vector<Case> plane_cases() {
  return {
      {"plain", wall, forward, 5},
      {"from the back", wall, {{0, 0, -10}, {0, 0, 1}}, 5},
      {"away", wall, {{0, 0, 0}, {0, 0, 1}}, miss},
      {"parallel", wall, {{0, 0, 0}, {1, 0, 0}}, miss},
      {"in the plane", wall, {{0, 0, -5}, {1, 0, 0}}, miss},
      {"from the plane", wall, {{0, 0, -5}, {0, 0, 1}}, miss},
      {"nearly parallel", wall, {{0, 0, 0}, {1, 0, -0x1p-100F}}, 0x5p100},
      {"nearly parallel, by the last bit of the sum",
       Plane{{0, -3, 0}, {1, 1, 1}, 0},
       {{0, 0, 0}, {1, -0x1p-60F, -1}},
       0x3p60},
      {"t above the largest float", wall, {{0, 0, 0}, {1, 0, -0x1p-126F}}, miss},
      {"tmax is live", wall, with(forward, 0, 5), 5},
      {"tmin is not live", wall, with(forward, 5, inf), miss},
      {"negative tmin sees behind", wall, with({{0, 0, -7}, {0, 0, -1}}, -10, inf), -2},
      {"NaN in tmin", wall, with(forward, nan, inf), miss},
      {"NaN in tmax", wall, with(forward, 0, nan), miss},
      {"normal 0", Plane{{0, 0, -5}, {0, 0, 0}, 0}, forward, miss},
      {"long normal", Plane{{0, 0, -5}, {0, 0, 0x1p100F}, 0}, forward, 5},
      {"short normal", Plane{{0, 0, -5}, {0, 0, 0x1p-100F}, 0}, forward, 5},
      {"direction 0", wall, {{0, 0, 0}, {0, 0, 0}}, miss},
  };
}

/// Each component of each vector, and the radius, replaced by NaN and the infinities: misses.
std::vector<Case> spoiled_cases() {
  std::vector<Case> cases;
  for (const float value : {nan, inf, -inf}) {
    for (int i = 0; i < 3; ++i) {
      const auto spoilt = [&](Vec3f v) {
        (i == 0 ? v.x : i == 1 ? v.y : v.z) = value;
        return v;
      };
      const std::string at = std::to_string(value) + " in component " + std::to_string(i) + " of ";
      Ray org = forward, dir = forward;
      org.org = vec_cast<double>(spoilt({0, 0, 0}));
      dir.dir = spoilt(forward.dir);
      Sphere sphere = ahead;
      sphere.center = spoilt(ahead.center);
      Plane point = wall, normal = wall;
      point.point = spoilt(wall.point);
      normal.normal = spoilt(wall.normal);
      for (const std::variant<Sphere, Plane>& primitive :
           {std::variant<Sphere, Plane>(ahead), std::variant<Sphere, Plane>(wall)}) {
        cases.push_back({at + "org", primitive, org, miss});
        cases.push_back({at + "dir", primitive, dir, miss});
      }
      cases.push_back({at + "center", sphere, forward, miss});
      cases.push_back({at + "point", point, forward, miss});
      cases.push_back({at + "normal", normal, forward, miss});
    }
  }
  cases.push_back({"NaN radius", Sphere{{0, 0, -5}, nan, 0}, forward, miss});
  return cases;
}

struct Primitives {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  explicit Primitives(const std::variant<Sphere, Plane>& one) {
    if (const auto* sphere = std::get_if<Sphere>(&one)) spheres = {*sphere};
    if (const auto* plane = std::get_if<Plane>(&one)) planes = {*plane};
  }
};

Hit expected_hit(const Case& c) { return {c.t, c.t == miss ? no_primitive : 0}; }

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& some : {sphere_cases(), plane_cases(), spoiled_cases()})
    cases.insert(cases.end(), some.begin(), some.end());
  return cases;
}

TEST(Contract, HoldsForTheScalarPath) {
  for (const Case& c : all_cases()) {
    const Primitives p(c.primitive);
    const Hit hit = reference::closest_hit(c.ray, p.spheres, p.planes);
    EXPECT_TRUE(same_bits(hit, expected_hit(c))) << c.name << ": " << std::hexfloat << hit.t;
  }
}

class ContractOf : public OnEachIsa {};

TEST_P(ContractOf, HoldsBesideOtherRays) {
  for (const Case& c : all_cases()) {
    const Primitives p(c.primitive);
    const Geometry geometry(p.spheres, p.planes);
    for (const Form form : {Form::packet, Form::single, Form::flight, Form::set}) {
      // The case in every third lane, a plain ray between.
      std::vector<Ray> rays(25, forward);
      for (std::size_t i = 0; i < rays.size(); i += 3) rays[i] = c.ray;
      const Query query{Solver::robust, form, Coherence::none};
      const auto hits = run_closest(*kernels, geometry.view(), rays, query);
      const auto occluded = run_any(*kernels, geometry.view(), rays, query);
      const Hit expected = expected_hit(c);
      for (std::size_t i = 0; i < rays.size(); i += 3) {
        ASSERT_TRUE(same_bits(hits[i], expected)) << c.name << ": " << hits[i].t;
        ASSERT_EQ(occluded[i], expected.id == 0 ? 1 : 0) << c.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, ContractOf, each_isa(), isa_name);

/// A tangent behind the eye, from a point on the sphere, with tmin < 0: the true root is at 0, and
/// the other sphere's at -5.5 comes first.
TEST_P(ContractOf, TangentsAtTheOriginHaveOneRoot) {
  const Ray ray = with({{-0x1.1d19c9902ff0cp-2, 0x1.855af0af86df4p-4, -0x1.e9575053d36c9p-1},
                        {0x1.f43226p-3F, 0x1.f05371p-1F, 0x1.9df39ep-6F}},
                       -10, inf);
  const Vec3d behind = ray.org - vec_cast<double>(ray.dir) * 5.0;
  const std::vector<Sphere> spheres = {unit, {vec_cast<float>(behind), 0.5F, 0}};
  const Hit expected = reference::closest_hit(ray, spheres, {});
  EXPECT_EQ(expected.id, 1);
  EXPECT_NEAR(expected.t, -5.5, 1e-6);
  const Geometry geometry(spheres, {});
  for (const Form form : {Form::packet, Form::single, Form::flight, Form::set}) {
    const Query query{Solver::robust, form, Coherence::none};
    for (const Hit& hit :
         run_closest(*kernels, geometry.view(), std::vector<Ray>(17, ray), query)) {
      ASSERT_TRUE(same_bits(hit, expected)) << hit.id << " " << hit.t;
    }
  }
}

}  // namespace
}  // namespace boule::test::contract
