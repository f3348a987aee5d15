// The contenders, compiled once per ISA. F = c - o throughout, h = d / |d|, one division and one
// root a ray; the hot loop asks for the sign of the discriminant alone.
#include "bench/textbook/book_solvers.h"

#include <cstdint>
#include <limits>

#include "bench/textbook/book_tree.h"
#include "bench/textbook/vectors.h"
#include "core/base/platform.h"

namespace boule::bench::BOULE_KERNEL_ISA {
namespace {

template <class V>
struct Line {
  V ox, oy, oz, dx, dy, dz;
  V hx, hy, hz;         ///< unit
  V a, inverse_length;  ///< d.d, 1 / |d|
};

template <class V>
struct Ball {
  V x, y, z, r;
};

/// Roots in t; meaningless where the discriminant is negative.
template <class V>
struct Roots {
  V discriminant, first, second;
};

template <class V>
struct Apart {
  V x, y, z;
};

template <class V>
BOULE_INLINE Apart<V> from_origin(const Line<V>& line, const Ball<V>& ball) {
  return {ball.x - line.ox, ball.y - line.oy, ball.z - line.oz};
}

template <class V>
BOULE_INLINE V dot(const Apart<V>& a, V x, V y, V z) {
  return multiply_add(a.z, z, multiply_add(a.y, y, a.x * x));
}

/// r^2 - F.F, in the order that keeps the chain short.
template <class V>
BOULE_INLINE V power_of_point(const Apart<V>& f, V r) {
  return negated_multiply_add(
      f.z, f.z, negated_multiply_add(f.y, f.y, negated_multiply_add(f.x, f.x, r * r)));
}

template <class V>
BOULE_INLINE V with_sign_of(V magnitude, V sign) {
  return pick(sign < all<V>(0.0F), -magnitude, magnitude);
}

/// The quadratic formula of school, for A t^2 + B t + C = 0 with o - c, unsimplified.
struct Textbook {
  using V = Floats;
  BOULE_INLINE static V discriminant(const Line<V>& line, const Ball<V>& ball) {
    const Apart<V> f = from_origin(line, ball);
    const V b = all<V>(-2.0F) * dot(f, line.dx, line.dy, line.dz);
    return multiply_add(b, b, all<V>(4.0F) * line.a * power_of_point(f, ball.r));
  }
  BOULE_INLINE static Roots<V> roots(const Line<V>& line, const Ball<V>& ball) {
    const V b = all<V>(-2.0F) * dot(from_origin(line, ball), line.dx, line.dy, line.dz);
    const V d = discriminant(line, ball), s = root(d), twice = line.a + line.a;
    return {d, (-b - s) / twice, (-b + s) / twice};
  }
};

/// The lecture's even b, with unit directions: t = b -/+ sqrt(b^2 - (F.F - r^2)).
template <class Vector>
struct HalfB {
  using V = Vector;
  BOULE_INLINE static V discriminant(const Line<V>& line, const Ball<V>& ball) {
    const Apart<V> f = from_origin(line, ball);
    const V b = dot(f, line.hx, line.hy, line.hz);
    return multiply_add(b, b, power_of_point(f, ball.r));
  }
  BOULE_INLINE static Roots<V> roots(const Line<V>& line, const Ball<V>& ball) {
    const V b = dot(from_origin(line, ball), line.hx, line.hy, line.hz);
    const V d = discriminant(line, ball), s = root(d);
    return {d, (b - s) * line.inverse_length, (b + s) * line.inverse_length};
  }
};

/// With unit directions, one root as q = b +/- sqrt(d), d the discriminant, whose terms have one
/// sign, the other as (F.F - r^2) / q.
template <class V>
BOULE_INLINE Roots<V> stable_roots(const Line<V>& line, const Ball<V>& ball, V d) {
  const Apart<V> f = from_origin(line, ball);
  const V b = dot(f, line.hx, line.hy, line.hz), q = b + with_sign_of(root(d), b);
  const V other = -power_of_point(f, ball.r) / q;
  return {d, least(q, other) * line.inverse_length, most(q, other) * line.inverse_length};
}

struct StableQ {
  using V = Floats;
  BOULE_INLINE static V discriminant(const Line<V>& line, const Ball<V>& ball) {
    return HalfB<V>::discriminant(line, ball);
  }
  BOULE_INLINE static Roots<V> roots(const Line<V>& line, const Ball<V>& ball) {
    return stable_roots(line, ball, discriminant(line, ball));
  }
};

/// Kahan's b^2 - a c: fused operations compute the rounding errors of the products, and these are
/// added. An ISA without fused operations has no such contender.
struct Kahan {
  using V = Floats;
  BOULE_INLINE static V difference(V b, V a, V c) {
    const V square = b * b, product = a * c;
    const V lost = multiply_add(b, b, -square) - multiply_add(a, c, -product);
    return (square - product) + lost;
  }
  BOULE_INLINE static V discriminant(const Line<V>& line, const Ball<V>& ball) {
    const Apart<V> f = from_origin(line, ball);
    return difference(dot(f, line.dx, line.dy, line.dz), line.a, -power_of_point(f, ball.r));
  }
  BOULE_INLINE static Roots<V> roots(const Line<V>& line, const Ball<V>& ball) {
    const Apart<V> f = from_origin(line, ball);
    const V b = dot(f, line.dx, line.dy, line.dz), c = -power_of_point(f, ball.r);
    const V d = difference(b, line.a, c), q = b + with_sign_of(root(d), b);
    const V one = q / line.a, other = c / q;
    return {d, least(one, other), most(one, other)};
  }
};

/// r^2 minus the squared distance of the centre from the line, |F - (F.h) h|^2, as in Ray Tracing
/// Gems, chapter 7, in Embree and in Cycles.
template <class Vector>
struct ClosestApproach {
  using V = Vector;
  BOULE_INLINE static V discriminant(const Line<V>& line, const Ball<V>& ball) {
    const Apart<V> f = from_origin(line, ball);
    const V b = dot(f, line.hx, line.hy, line.hz);
    const Apart<V> l = {negated_multiply_add(b, line.hx, f.x),
                        negated_multiply_add(b, line.hy, f.y),
                        negated_multiply_add(b, line.hz, f.z)};
    return power_of_point(l, ball.r);
  }
  BOULE_INLINE static Roots<V> roots(const Line<V>& line, const Ball<V>& ball) {
    return stable_roots(line, ball, discriminant(line, ball));
  }
};

template <class V>
BOULE_INLINE Line<V> get_line(const BookData& data, std::size_t ray) {
  Line<V> line;
  line.ox = get<V>(data.org_x + ray);
  line.oy = get<V>(data.org_y + ray);
  line.oz = get<V>(data.org_z + ray);
  line.dx = get<V>(data.dir_x + ray);
  line.dy = get<V>(data.dir_y + ray);
  line.dz = get<V>(data.dir_z + ray);
  line.a = multiply_add(line.dz, line.dz, multiply_add(line.dy, line.dy, line.dx * line.dx));
  line.inverse_length = all<V>(1.0F) / root(line.a);
  line.hx = line.dx * line.inverse_length;
  line.hy = line.dy * line.inverse_length;
  line.hz = line.dz * line.inverse_length;
  return line;
}

template <class V>
BOULE_INLINE Ball<V> one_for_all(const BookData& data, std::size_t i) {
  return {all<V>(data.center_x[i]), all<V>(data.center_y[i]), all<V>(data.center_z[i]),
          all<V>(data.radius[i])};
}

template <class V>
BOULE_INLINE V nearer(const Roots<V>& roots, V best) {
  const V zero = all<V>(0.0F), t = pick(roots.first > zero, roots.first, roots.second);
  const auto hit = (roots.discriminant >= zero) & (t > zero) & (t < best);
  return pick(hit, t, best);
}

template <class Solver>
void nearest(const BookData& data) {
  using V = typename Solver::V;
  constexpr std::size_t chunk = 256;
  std::uint32_t list[chunk + 4];
  const V zero = all<V>(0.0F);
  for (std::size_t ray = 0; ray < data.rays; ray += lanes_of<V>) {
    const Line<V> line = get_line<V>(data, ray);
    V best = all<V>(std::numeric_limits<float>::infinity());
    for (std::size_t begin = 0; begin < data.spheres; begin += chunk) {
      const std::size_t end = begin + chunk < data.spheres ? begin + chunk : data.spheres;
      std::size_t count = 0;
      for (std::size_t i = begin; i < end; i += 4) {  // padded: four may be read
        const auto in = [&](std::size_t k) {
          return Solver::discriminant(line, one_for_all<V>(data, i + k)) >= zero;
        };
        const auto in0 = in(0), in1 = in(1), in2 = in(2), in3 = in(3);
        if (none(in0 | in1 | in2 | in3)) continue;
        list[count] = static_cast<std::uint32_t>(i);
        count += none(in0) ? 0 : 1;
        list[count] = static_cast<std::uint32_t>(i + 1);
        count += none(in1) ? 0 : 1;
        list[count] = static_cast<std::uint32_t>(i + 2);
        count += none(in2) ? 0 : 1;
        list[count] = static_cast<std::uint32_t>(i + 3);
        count += none(in3) ? 0 : 1;
      }
      for (std::size_t k = 0; k < count; ++k)
        best = nearer(Solver::roots(line, one_for_all<V>(data, list[k])), best);
    }
    put(data.t + ray, best);
  }
}

template <class Solver>
void pairs(const BookData& data) {
  using V = typename Solver::V;
  for (std::size_t i = 0; i < data.rays; i += lanes_of<V>) {
    const Ball<V> ball = {get<V>(data.center_x + i), get<V>(data.center_y + i),
                          get<V>(data.center_z + i), get<V>(data.radius + i)};
    const V none_yet = all<V>(std::numeric_limits<float>::infinity());
    put(data.t + i, nearer(Solver::roots(get_line<V>(data, i), ball), none_yet));
  }
}

/// As many rays as a register has floats, in one part or, where the solver is in double, in two,
/// and the nearest t of each so far.
template <class Solver>
struct Packet {
  using V = typename Solver::V;
  static constexpr int parts = lanes_of<Floats> / lanes_of<V>;
  Line<V> line[parts];
  V best[parts];

  BOULE_INLINE Packet(const BookData& data, std::size_t ray) {
    for (int part = 0; part < parts; ++part) {
      line[part] = get_line<V>(data, ray + static_cast<std::size_t>(part * lanes_of<V>));
      best[part] = all<V>(std::numeric_limits<float>::infinity());
    }
  }
  BOULE_INLINE void put_best(float* t) const {
    for (int part = 0; part < parts; ++part) put(t + part * lanes_of<V>, best[part]);
  }
  [[nodiscard]] BOULE_INLINE Floats limit() const {
    alignas(64) float t[lanes_of<Floats>];
    put_best(t);
    return get<Floats>(t);
  }
  BOULE_INLINE void meet(const SphereBlock& block, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) {
      const Ball<V> ball = {all<V>(block.center_x[k]), all<V>(block.center_y[k]),
                            all<V>(block.center_z[k]), all<V>(block.radius[k])};
      for (int part = 0; part < parts; ++part) {
        if (none(Solver::discriminant(line[part], ball) >= all<V>(0.0F))) continue;
        best[part] = nearer(Solver::roots(line[part], ball), best[part]);
      }
    }
  }
};

template <class Solver>
BOULE_INLINE void walk(const BookData& data, const BoxRays& boxes, Packet<Solver>& packet) {
  const SphereBlock* const leaves = data.blocks + data.apart;
  Floats limit = packet.limit();
  float farthest = most_lane(limit);
  VisitStack stack;
  boxes.push_children(data.nodes[0], limit, stack);
  while (stack.count > 0) {
    const Visit visit = stack.visits[--stack.count];
    if (farthest < visit.near) continue;
    if (visit.leaf_size == 0) {
      boxes.push_children(data.nodes[visit.child], limit, stack);
      continue;
    }
    packet.meet(leaves[index_of(visit.child)], visit.leaf_size);
    limit = packet.limit();
    farthest = most_lane(limit);
  }
}

template <class Solver>
void traverse(const BookData& data) {
  const float extent = data.nodes == nullptr ? 0 : extent_of(data.nodes[0]);
  for (std::size_t ray = 0; ray < data.rays; ray += lanes_of<Floats>) {
    Packet<Solver> packet(data, ray);
    for (std::size_t k = 0; k < data.apart; ++k) packet.meet(data.blocks[k], bvh_leaf_size);
    if (data.nodes != nullptr) walk(data, BoxRays(data, ray, extent), packet);
    packet.put_best(data.t + ray);
  }
}

template <class Solver>
constexpr BookSolver solver(const char* name) {
  return {name, nearest<Solver>, pairs<Solver>, traverse<Solver>};
}

constexpr BookSolver all_solvers[] = {
    solver<Textbook>("textbook"),
    solver<HalfB<Floats>>("half_b"),
    solver<StableQ>("stable_q"),
    solver<ClosestApproach<Floats>>("closest_approach"),
    solver<HalfB<Doubles>>("half_b_double"),
    solver<ClosestApproach<Doubles>>("closest_approach_double"),
    solver<Kahan>("kahan"),
};

}  // namespace

extern const std::span<const BookSolver> book_solvers;
const std::span<const BookSolver> book_solvers(all_solvers,
                                               std::size(all_solvers) - (fuses ? 0 : 1));

}  // namespace boule::bench::BOULE_KERNEL_ISA
