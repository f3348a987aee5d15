// A few capsules, or the boxes of more, against which kernels hold groups of rays before they load
// any: the answers are the scalar path's, also of rays that graze a capsule.
#include <limits>

#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

Hit reference_hit(const Ray& ray, const std::vector<Capsule>& capsules) {
  return reference::closest_hit(ray, {}, {}, capsules);
}

class FewCapsules : public OnEachIsa {
 protected:
  /// Holds all forms against the scalar path. Returns the number of hits.
  std::size_t expect_reference_hits(const std::vector<Capsule>& capsules,
                                    const std::vector<Ray>& rays, Coherence coherence) {
    Geometry geometry({}, {});
    geometry.add_capsules(capsules);
    std::size_t met = 0;
    for (const Form form : {Form::automatic, Form::packet, Form::single}) {
      const Query query{Solver::robust, form, coherence};
      const auto hits = run_closest(*kernels, geometry.view(), rays, query);
      const auto occluded = run_any(*kernels, geometry.view(), rays, query);
      for (std::size_t i = 0; i < hits.size() && !HasFailure(); ++i) {
        const Hit expected = reference_hit(rays[i], capsules);
        EXPECT_TRUE(same_bits(hits[i], expected)) << "ray " << i << ", expected " << expected.id;
        EXPECT_EQ(occluded[i], expected.id == no_primitive ? 0 : 1) << "ray " << i;
        met += expected.id == no_primitive ? 0U : 1U;
      }
    }
    return met;
  }
};
INSTANTIATE_TEST_SUITE_P(Tables, FewCapsules, each_isa(), isa_name);

/// Edges of a cell, and some capsules at random.
std::vector<Capsule> edges_and_others(CaseRandom& random, float radius, int others) {
  std::vector<Capsule> capsules;
  for (const float u : {-1.0F, 1.0F}) {
    for (const float v : {-1.0F, 1.0F}) {
      capsules.push_back({{-1, u, v}, {1, u, v}, radius, {}});
      capsules.push_back({{u, -1, v}, {u, 1, v}, -radius, {}});
      capsules.push_back({{u, v, -1}, {u, v, 1}, radius, {}});
    }
  }
  for (int i = 0; i < others; ++i) {
    const Vec3d a = random.direction() * 0.8;
    const Vec3d b = random.direction() * 0.8;
    capsules.push_back({vec_cast<float>(a), vec_cast<float>(b), radius, {}});
  }
  return capsules;
}

/// Rays through tiles of 8 x 8 points, large and small, around places near the origin: from one
/// point, along one direction, or to one end.
std::vector<Ray> tiles(CaseRandom& random, Coherence coherence, double distance) {
  std::vector<Ray> rays;
  const Vec3d apex = random.direction() * distance;
  for (int tile = 0; tile < 40; ++tile) {
    const double size = random.decade(-4, -0.5);
    const Vec3d across = random.direction() * size;
    const Vec3d aside = random.direction() * size;
    const Vec3d away = random.direction();
    const Vec3d middle = away * random.uniform(0, 1.8);
    for (int k = 0; k < 64; ++k) {
      const Vec3d at = middle + across * (k % 8 - 3.5) + aside * (k / 8 - 3.5);
      const Vec3f along = vec_cast<float>(at - apex);
      if (coherence == Coherence::common_origin) {
        rays.push_back({apex, along});
      } else if (coherence == Coherence::common_direction) {
        rays.push_back({at - apex, vec_cast<float>(apex)});
      } else {
        rays.push_back({apex + vec_cast<double>(along), -along});
        rays.back().tmax = distance < 1 ? 3 : 1;  // from within a cell also beyond the end
      }
    }
  }
  return rays;
}

TEST_P(FewCapsules, CoherentRaysEqualTheScalarPath) {
  CaseRandom random(31);
  std::size_t hits = 0, rays = 0;
  for (const Coherence coherence :
       {Coherence::common_origin, Coherence::common_direction, Coherence::common_end}) {
    for (const double distance : {0.3, 3.0, 50.0, 1e6}) {
      for (const int others : {0, 4, 5, 70, 400}) {
        if (others == 400 && distance != 3) continue;  // a tree of two levels
        SCOPED_TRACE(distance);
        const std::vector<Capsule> capsules = edges_and_others(random, 0.02F, others);
        const std::vector<Ray> some = tiles(random, coherence, distance);
        hits += expect_reference_hits(capsules, some, coherence);
        rays += some.size();
        if (HasFailure()) return;
      }
    }
  }
  EXPECT_GT(hits, rays / 20);
}

TEST_P(FewCapsules, OddRaysEqualTheScalarPath) {
  constexpr float odd[] = {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(),
                           0,
                           -0.0F,
                           1e-45F,
                           3e38F,
                           -1e19F};
  CaseRandom random(32);
  const auto spoil = [&](auto& number) {
    using Number = std::remove_reference_t<decltype(number)>;
    if (random.chance(0.05)) number = static_cast<Number>(odd[random.below(7)]);
  };
  for (int run = 0; run < 12; ++run) {
    const int trial = run % 6;
    const bool has_end = run >= 6;
    std::vector<Capsule> capsules = edges_and_others(random, 0.05F, 4);
    std::vector<Ray> rays =
        tiles(random, has_end ? Coherence::common_end : Coherence::common_origin, 3);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Ray& ray = rays[i];
      if (trial % 2 == 0 && i / 64 % 4 == 0) ray.tmin = -2;
      if (trial % 3 == 0) ray.dir = -ray.dir;
      spoil(ray.dir.x), spoil(ray.dir.z), spoil(ray.tmin), spoil(ray.tmax);
      if (trial > 3) spoil(ray.org.y);
      ray.tmin = float_below(ray.tmin), ray.tmax = float_above(ray.tmax);
    }
    if (trial > 1) {
      for (Capsule& capsule : capsules)
        spoil(capsule.a.x), spoil(capsule.b.z), spoil(capsule.radius);
    }
    expect_reference_hits(capsules, rays, has_end ? Coherence::common_end : Coherence::none);
    if (HasFailure()) return;
  }
}

/// Moves a ray's origin away from a capsule, until another step would make it miss.
void graze(Ray& ray, const Capsule& capsule, const Vec3d& away) {
  const Vec3d from = ray.org;
  double hit = 0, miss = 4;
  for (int i = 0; i < 90; ++i) {
    const double middle = (hit + miss) / 2;
    ray.org = from + away * middle;
    (reference_hit(ray, {capsule}).id == no_primitive ? miss : hit) = middle;
  }
  ray.org = from + away * hit;
}

/// The capsule, and so many others aside from it that they lie in a tree: kernels then know no
/// angles of capsules, and look for planes between them and the rays.
std::vector<Capsule> among_others(const Capsule& capsule, const Vec3d& aside) {
  std::vector<Capsule> capsules{capsule};
  for (int i = 0; i < 20; ++i) {
    const Vec3f by = vec_cast<float>(aside * (40.0 + 3.0 * i));
    capsules.push_back({capsule.a + by, capsule.b + by, capsule.radius, {}});
  }
  return capsules;
}

TEST_P(FewCapsules, GrazingRaysEqualTheScalarPath) {
  CaseRandom random(33);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3d a = random.direction();
    const Vec3d along = random.direction();
    const Vec3d b = a + along * random.decade(-2, 0);
    const auto radius = static_cast<float>(random.decade(-3, -0.5));
    const Capsule capsule{vec_cast<float>(a), vec_cast<float>(b), radius, {}};
    const Vec3d middle = (vec_cast<double>(capsule.a) + vec_cast<double>(capsule.b)) * 0.5;
    const Vec3d dir = random.direction(), other = random.direction();
    Ray ray{middle, vec_cast<float>(dir)};
    ray.org = middle - vec_cast<double>(ray.dir) * 5.0;
    const Vec3d away = other - dir * dot(other, dir);
    graze(ray, capsule, away);
    ASSERT_NE(reference_hit(ray, {capsule}).id, no_primitive);
    expect_reference_hits({capsule}, {ray}, Coherence::common_origin);
    expect_reference_hits(among_others(capsule, normalize(away)), {ray}, Coherence::common_origin);
    if (HasFailure()) return;
  }
}

/// Gives the capsule the least radius at which the ray hits it.
void shrink_to(const Ray& ray, Capsule& capsule) {
  float hit = 20, miss = 0;
  for (int i = 0; i < 60; ++i) {
    capsule.radius = (hit + miss) / 2;
    (reference_hit(ray, {capsule}).id == no_primitive ? miss : hit) = capsule.radius;
  }
  capsule.radius = hit;
}

TEST_P(FewCapsules, GrazingRaysToAnEndToo) {
  CaseRandom random(34);
  for (int trial = 0; trial < 1000; ++trial) {
    const double far = random.decade(1, 7);
    const Vec3d dir = random.direction();
    Ray ray{{}, vec_cast<float>(dir * far)};
    ray.org = -vec_cast<double>(ray.dir);  // it ends at the origin
    ray.tmax = 1;
    const Vec3d middle = dir * -random.decade(-2, 1) + random.direction() * random.decade(-4, -1);
    const Vec3d half = random.direction() * random.decade(-3, 0);
    Capsule capsule{vec_cast<float>(middle - half), vec_cast<float>(middle + half), 0, {}};
    shrink_to(ray, capsule);
    expect_reference_hits({capsule}, {ray}, Coherence::common_end);
    if (HasFailure()) return;
  }
}

// The ray starts at the origin, where its rounding to float leaves no room. An end of the capsule
// is as near to it as rounding allows, so that steps of the radius come near to those of double.
TEST_P(FewCapsules, GrazingRaysOfOneDirectionToo) {
  CaseRandom random(35);
  std::size_t hits = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Ray ray{{}, vec_cast<float>(random.direction())};
    const Vec3f end = vec_cast<float>(vec_cast<double>(ray.dir) * random.uniform(1, 4));
    const Vec3f other = end + vec_cast<float>(random.direction() * random.decade(-3, 0));
    Capsule capsule{end, trial % 2 == 0 ? end : other, 0, {}};
    shrink_to(ray, capsule);
    hits += expect_reference_hits({capsule}, {ray}, Coherence::common_direction);
    if (HasFailure()) return;
  }
  EXPECT_GT(hits, 3900U);
}

}  // namespace
}  // namespace boule::test
