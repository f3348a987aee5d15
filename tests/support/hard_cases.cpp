#include "tests/support/hard_cases.h"

#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "tests/support/hard_rows.h"

namespace boule::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

constexpr HardCaseSpec specs[] = {{"S0", 0, 0x594444b0b63b4a4f},   {"S1", 0, 0x98a32de3099ed38b},
                                  {"S1", 1, 0x553d3ea788a39482},   {"S1", 2, 0x69df447ba62f5eb4},
                                  {"S1", 3, 0xe1f98f6269bc9952},   {"S1", 4, 0xbcb91b94a13539ce},
                                  {"S1", 5, 0x4394870af978b423},   {"S1", 6, 0x872f35c443ba798a},
                                  {"S1", 7, 0xfd44233f3a456a36},   {"S2", 3, 0x8e7b9c10fd02c1ea},
                                  {"S2", 4, 0x63cc670dcdf7c321},   {"S2", 5, 0x1d7c7681436fbe5d},
                                  {"S2", 6, 0x697ff04740f2248f},   {"S2", 7, 0xe67569f41fc36db6},
                                  {"S3", 1, 0x36df91bbf9dc61ce},   {"S3", 2, 0x3765794af0bbd753},
                                  {"S3", 3, 0x272a4b320b566739},   {"S3", 4, 0xc09182d6b9539a16},
                                  {"S3", 5, 0xa4950f1446e2e287},   {"S3", 6, 0x9c4390526597c723},
                                  {"S3", 7, 0x3f88ed724912423a},   {"S4", 4, 0xd74ceea71d410a7d},
                                  {"S4", 8, 0x3356514fa01f01f4},   {"S4", 12, 0x864389b76d9a8e17},
                                  {"S4", 16, 0x59cad81cb7fa3877},  {"S4", 20, 0xce06a5c70097500b},
                                  {"S4", 24, 0xf04d1abd1c3d959e},  {"S4b", 4, 0xd23e771288b2552e},
                                  {"S4b", 8, 0x9fda4a51b4899b88},  {"S4b", 12, 0x5993659eff17b5f6},
                                  {"S4b", 16, 0x6fc5d57d5a13a98c}, {"S4b", 20, 0x9f6fb2f1cd5dd765},
                                  {"S4b", 24, 0x7ad8562e25b19c37}, {"S5", 0, 0xa92f9b5ffbbc11ff},
                                  {"S5", 2, 0x78f9b3830398cc72},   {"S5", 4, 0x5ab722ea02bd3eda},
                                  {"S5", 6, 0x8a9c7832775bb126},   {"S6", 4, 0x24e99ffe285dc954},
                                  {"S6", 8, 0x23ba7cda946e6d70},   {"S6", 12, 0xfa017da33fb78297},
                                  {"S6", 16, 0x5caf6172aebefa12},  {"S6", 20, 0x1c4e2246e65b6294},
                                  {"S7", 0, 0xcbd3f6a0ab65ad20},   {"S8", -18, 0xb899e16ad168b41c},
                                  {"S8", -10, 0x1568f9c7fc149a15}, {"S8", -6, 0x16b9e277a8095778},
                                  {"S8", -3, 0x14ebe3e31bf544},    {"S8", 3, 0x8e9148a96ec2f230},
                                  {"S8", 6, 0x78a60e6ef630e4de},   {"S8", 10, 0xd5279c6094774022},
                                  {"S8", 18, 0xe69587f8b476cd42},  {"S9", -36, 0x854f04eaf7143bf0},
                                  {"S9", -30, 0xff7b2e3657d382b4}, {"S9", -20, 0x948ff2cc8e57d30c},
                                  {"S9", -18, 0xe5711f8bd2befdc9}, {"S9", -12, 0xc1a04d61acde37b4},
                                  {"S9", 12, 0x2147882e25d14cf},   {"S9", 18, 0x516dfb38d654413f},
                                  {"S9", 20, 0xeb61c84778759f39},  {"S9", 30, 0xb8d5026aaaecae1a},
                                  {"S9", 36, 0x7d71fd7707ceefb8},  {"S10", 3, 0xe3e87f53ff38ffe0},
                                  {"S10", 4, 0x54ff51bf664e4391},  {"S10", 5, 0x9b09499df03b6c43},
                                  {"S10", 6, 0x2f4c96c31a0a8a9a},  {"S10", 7, 0x562cbd43ea987e51},
                                  {"S11", 1, 0x1d5ece0b3e966220},  {"S11", 2, 0xaffffc12e5e3e96e},
                                  {"S11", 3, 0xf95d9af2f8c42609},  {"S11", 4, 0x1151eb02fcea7ec1},
                                  {"S11", 5, 0x367a647bb43959ee},  {"S11", 6, 0xc85282f775784dce},
                                  {"S12", 0, 0xee9f455517bec8e6},  {"S13", 3, 0x69f721842d957d5b},
                                  {"S13", 4, 0xeaafd469a83451c1},  {"S13", 5, 0x9d970c7d6d4eeec},
                                  {"S13", 6, 0x84c3507738e1e9a1},  {"P0", 0, 0xed3853e31eca464b},
                                  {"P1", 4, 0xa84a788834fdc7ba},   {"P1", 8, 0x536d1a5bac168de},
                                  {"P1", 12, 0x5213428cb02de80a},  {"P1", 16, 0x75551af6f4473085},
                                  {"P1", 20, 0xa06de1d4ee582f65},  {"P1", 24, 0xbe975827524d620c},
                                  {"P1", 28, 0x29ceb624175129f0},  {"P2", 0, 0x454cbdce8c4a7811},
                                  {"P2", 1, 0xb5a3e03cb06f7386},   {"P2", 2, 0xbafa0eacd5663d2b},
                                  {"P2", 3, 0xeceb0b61cfe2c61},    {"P2", 4, 0x8d68010d2b28ab06},
                                  {"P2", 5, 0xf7aefd307840a62d},   {"P2", 6, 0xcfbf81f87a39f13b},
                                  {"P3", 3, 0xa086af97842dcf0},    {"P3", 4, 0x6fe253c35023d5de},
                                  {"P3", 5, 0xb801ce03ac77cae1},   {"P3", 6, 0x16412819d18be383},
                                  {"P3", 7, 0xcd9d73fbbf71e7ec},   {"P4", -30, 0x93feb7027c6ab220},
                                  {"P4", -18, 0x53ab6c764f41f6ac}, {"P4", -6, 0x775d1f1e63cbd05c},
                                  {"P4", 6, 0x31579e5c29d21eb},    {"P4", 18, 0xaaf48b04bba32493},
                                  {"P4", 30, 0x592cfa03078397e2},  {"P5", 0, 0xb29efdb2de45628c},
                                  {"P6", -36, 0x8c6bff43fe044798}, {"P6", -20, 0x3a2beb42e72e3f98},
                                  {"P6", 20, 0xbb093eb7c84cdc83},  {"P6", 36, 0xad6f6f4de1203d0d},
                                  {"L", 0, 0xb54a8745e8db386d},    {"L", 3, 0x655512584d86652c},
                                  {"L", 6, 0x102d8e85b7e94efa}};

/// Primitive j, ray i and the special values of either are drawn from streams of their own.
enum class Draw : std::uint64_t { primitive, ray, spoil_primitive, spoil_ray, plane };

CaseRandom random_for(const HardCaseSpec& spec, Draw draw, std::size_t index) {
  std::uint64_t seed = static_cast<std::uint64_t>(std::int64_t{spec.k} + 1000);
  for (const char* c = spec.row; *c != 0; ++c) seed = seed * 257 + static_cast<std::uint64_t>(*c);
  return CaseRandom(seed, static_cast<std::uint64_t>(draw) << 56U | index);
}

template <class Primitive>
const HardRow<Primitive>& row_of(std::span<const HardRow<Primitive>> rows, const char* name) {
  for (const HardRow<Primitive>& row : rows) {
    if (std::strcmp(row.name, name) == 0) return row;
  }
  return rows[0];  // S12 and L are made of the ordinary rows
}

bool is(const HardCaseSpec& spec, const char* row) { return std::strcmp(spec.row, row) == 0; }

bool has_one_primitive(const HardCaseSpec& spec) {
  return is(spec, "S2") || is(spec, "S11") || is(spec, "P5");
}

template <class Primitive>
void draw_primitives(const HardCaseSpec& spec, const HardRow<Primitive>& row, Draw draw,
                     std::size_t count, std::vector<Primitive>& out) {
  for (std::size_t j = 0; j < count; ++j) {
    CaseRandom random = random_for(spec, draw, j);
    out.push_back(row.primitive(random, spec.k));
  }
}

template <class Primitive>
void draw_rays(const HardCaseSpec& spec, const HardRow<Primitive>& row,
               const std::vector<Primitive>& primitives, std::size_t first, std::size_t count,
               std::vector<Ray>& out) {
  for (std::size_t i = first; i < first + count; ++i) {
    CaseRandom random = random_for(spec, Draw::ray, i);
    out.push_back(row.ray(random, primitives[i % primitives.size()], spec.k));
  }
}

/// L: any of the case's primitives, left on either side from a double origin.
Ray leave_any(CaseRandom& random, const HardCase& crowd, int k) {
  const auto spheres = static_cast<int>(crowd.spheres.size());
  const int id = random.below(spheres + static_cast<int>(crowd.planes.size()));
  Ray ray;
  ray.source = id;
  const Vec3d n = random.direction();
  const Vec3d dir = random.direction();
  if (id < spheres) {
    const Sphere& sphere = crowd.spheres[static_cast<std::size_t>(id)];
    ray.org = vec_cast<double>(sphere.center) + n * double{sphere.radius};
    ray.inside = dot(n, dir) < 0;
  } else {
    const Plane& plane = crowd.planes[static_cast<std::size_t>(id - spheres)];
    const Vec3d across = random.perpendicular(normalize(vec_cast<double>(plane.normal)));
    ray.org = vec_cast<double>(plane.point) + across * random.uniform(0, power_of_ten(k));
  }
  ray.dir = vec_cast<float>(dir);
  ray.tmax = random.chance(0.25) ? static_cast<float>(random.uniform(0, 2)) : inf;
  return ray;
}

/// Spheres and planes together: the crowd of S12 and L.
HardCase mixed_case(const HardCaseSpec& spec, std::size_t primitives, std::size_t rays) {
  constexpr std::size_t planes = 5;
  const HardRow<Sphere>& sphere_row = row_of(sphere_rows(), spec.row);
  const HardRow<Plane>& plane_row = row_of(plane_rows(), spec.row);
  HardCase out;
  draw_primitives(spec, sphere_row, Draw::primitive, primitives, out.spheres);
  draw_primitives(spec, plane_row, Draw::plane, planes, out.planes);
  if (is(spec, "L")) {
    for (std::size_t i = 0; i < rays; ++i) {
      CaseRandom random = random_for(spec, Draw::ray, i);
      out.rays.push_back(leave_any(random, out, spec.k));
    }
    return out;
  }
  draw_rays(spec, sphere_row, out.spheres, 0, rays - rays / 4, out.rays);
  draw_rays(spec, plane_row, out.planes, rays - rays / 4, rays / 4, out.rays);
  for (std::size_t j = 0; j < primitives + planes; ++j) {
    CaseRandom random = random_for(spec, Draw::spoil_primitive, j);
    j < primitives ? spoil(random, out.spheres[j]) : spoil(random, out.planes[j - primitives]);
  }
  for (std::size_t i = 0; i < rays; ++i) {
    CaseRandom random = random_for(spec, Draw::spoil_ray, i);
    spoil(random, out.rays[i]);
  }
  return out;
}

float special_value(CaseRandom& random) {
  constexpr float values[] = {std::numeric_limits<float>::quiet_NaN(),
                              inf,
                              -inf,
                              0.0F,
                              -0.0F,
                              1e-45F,
                              -1e-40F,
                              3e38F,
                              -3e38F,
                              1e19F,
                              -1e19F,
                              1e-19F,
                              1.0F,
                              -1.0F};
  return values[random.below(static_cast<int>(std::size(values)))];
}

void spoil(CaseRandom& random, float& component) {
  if (random.chance(0.25)) component = special_value(random);
}

void spoil(CaseRandom& random, double& component) {
  if (random.chance(0.25)) component = double{special_value(random)};
}

void spoil(CaseRandom& random, Vec3f& v) {
  for (float* component : {&v.x, &v.y, &v.z}) spoil(random, *component);
}

}  // namespace

void spoil(CaseRandom& random, Sphere& sphere) {
  spoil(random, sphere.center);
  spoil(random, sphere.radius);
}

void spoil(CaseRandom& random, Plane& plane) {
  spoil(random, plane.point);
  spoil(random, plane.normal);
}

void spoil(CaseRandom& random, Ray& ray) {
  Vec3f org = vec_cast<float>(ray.org);
  spoil(random, org);
  ray.org = vec_cast<double>(org);
  spoil(random, ray.dir);
  spoil(random, ray.tmin);
  spoil(random, ray.tmax);
}

std::string name_of(const HardCaseSpec& spec) {
  const std::string sign = spec.k < 0 ? "m" : "";
  return std::string(spec.row) + "_k" + sign + std::to_string(std::abs(spec.k));
}

std::span<const HardCaseSpec> hard_case_specs() { return specs; }

bool leaves_surfaces(const HardCaseSpec& spec) { return is(spec, "S11") || is(spec, "L"); }

HardCase make_hard_case(const HardCaseSpec& spec, std::size_t primitives, std::size_t rays) {
  if (is(spec, "S12") || is(spec, "L")) return mixed_case(spec, primitives, rays);
  if (has_one_primitive(spec)) primitives = 1;
  HardCase out;
  if (spec.row[0] == 'S') {
    const HardRow<Sphere>& row = row_of(sphere_rows(), spec.row);
    draw_primitives(spec, row, Draw::primitive, primitives, out.spheres);
    draw_rays(spec, row, out.spheres, 0, rays, out.rays);
  } else {
    const HardRow<Plane>& row = row_of(plane_rows(), spec.row);
    draw_primitives(spec, row, Draw::primitive, primitives, out.planes);
    draw_rays(spec, row, out.planes, 0, rays, out.rays);
  }
  return out;
}

}  // namespace boule::test
