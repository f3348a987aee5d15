#include "bench/peers/double_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/reference.h"

namespace boule::bench {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::uint32_t leaf_size = 4;
constexpr int stack_size = 64;  // halves: 2^31 primitives are 31 deep

double component(const Vec3f& v, int axis) {
  return static_cast<double>(axis == 0 ? v.x : axis == 1 ? v.y : v.z);
}

/// Where a primitive lies along an axis.
struct Extent {
  double min, max;
};
Extent extent(const Sphere& sphere, int axis) {
  const double center = component(sphere.center, axis), radius{sphere.radius};
  return {center - radius, center + radius};
}
Extent extent(const Capsule& capsule, int axis) {
  const double a = component(capsule.a, axis), b = component(capsule.b, axis);
  const double radius{capsule.radius};
  return {std::min(a, b) - radius, std::max(a, b) + radius};
}
Extent extent(const BenchScene& scene, std::int32_t id, int axis) {
  return with_primitive(scene, id, [&](const auto& one) { return extent(one, axis); });
}

double intersect(const BenchScene& scene, std::int32_t id, const Ray& ray) {
  return with_primitive(
      scene, id, [&](const auto& one) { return reference::intersect(ray, one, id == ray.source); });
}

/// A ray as box tests see it.
struct BoxRay {
  double org[3], dir[3], inverse[3], tmin;

  explicit BoxRay(const Ray& ray)
      : org{ray.org.x, ray.org.y, ray.org.z},
        dir{double{ray.dir.x}, double{ray.dir.y}, double{ray.dir.z}},
        inverse{1 / dir[0], 1 / dir[1], 1 / dir[2]},
        tmin(ray.tmin) {}
};

/// Where the ray enters a box before `limit`, or inf.
template <class Node>
double entry(const BoxRay& ray, const Node& node, double limit) {
  double near = ray.tmin, far = limit;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.dir[axis] == 0) {
      if (ray.org[axis] < node.min[axis] || ray.org[axis] > node.max[axis]) return inf;
      continue;
    }
    const double a = (node.min[axis] - ray.org[axis]) * ray.inverse[axis];
    const double b = (node.max[axis] - ray.org[axis]) * ray.inverse[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? near : inf;
}

}  // namespace

DoubleTree::DoubleTree(const BenchScene& scene) : scene_(scene) {
  order_.resize(scene.spheres.size() + scene.capsules.size());
  std::iota(order_.begin(), order_.end(), 0);
  double size = 0;
  for (const std::int32_t id : order_) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto [min, max] = extent(scene, id, axis);
      size = std::max({size, -min, max});
    }
  }
  margin_ = 1e-9 * size;
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(order_.size()));
}

void DoubleTree::set_box(Node& node, std::uint32_t first, std::uint32_t count) const {
  for (int axis = 0; axis < 3; ++axis) {
    node.min[axis] = inf;
    node.max[axis] = -inf;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const auto [min, max] = extent(scene_, order_[i], axis);
      node.min[axis] = std::min(node.min[axis], min - margin_);
      node.max[axis] = std::max(node.max[axis], max + margin_);
    }
  }
}

/// Halves the primitives at the median centre along the box's longest side.
void DoubleTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  set_box(nodes_[node], first, count);
  nodes_[node].first = first;
  nodes_[node].count = count;
  if (count <= leaf_size) return;
  const Node& box = nodes_[node];
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    if (box.max[other] - box.min[other] > box.max[axis] - box.min[axis]) axis = other;
  }
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  const auto twice_center = [&](std::int32_t id) {
    const auto [min, max] = extent(scene_, id, axis);
    return min + max;
  };
  std::nth_element(begin, begin + half, begin + count, [&](std::int32_t a, std::int32_t b) {
    return twice_center(a) < twice_center(b);
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_[node].count = 0;
  nodes_.resize(nodes_.size() + 2);
  build(child, first, half);
  build(child + 1, first + half, count - half);
}

/// Calls visit(id) for the primitives of the leaves that the ray enters before `limit`, which visit
/// may lower, roughly in the ray's order; until visit returns true.
template <class Visit>
void DoubleTree::traverse(const Ray& ray, const double& limit, const Visit& visit) const {
  struct Entry {
    double near;
    std::uint32_t node;
  };
  const BoxRay box_ray(ray);
  Entry stack[stack_size];
  int size = 0;
  const double root = entry(box_ray, nodes_[0], limit);
  if (root < inf) stack[size++] = {root, 0};
  while (size > 0) {
    const Entry top = stack[--size];
    if (top.near > limit) continue;
    const Node& node = nodes_[top.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (visit(order_[i])) return;
    }
    if (node.count > 0) continue;
    Entry a = {entry(box_ray, nodes_[node.first], limit), node.first};
    Entry b = {entry(box_ray, nodes_[node.first + 1], limit), node.first + 1};
    if (a.near < b.near) std::swap(a, b);
    if (a.near < inf) stack[size++] = a;
    if (b.near < inf) stack[size++] = b;
  }
}

Hit DoubleTree::closest_hit(const Ray& ray) const {
  Hit nearest;
  nearest.t = double{ray.tmax};
  const double& limit = nearest.t;
  traverse(ray, limit, [&](std::int32_t id) {
    const double t = intersect(scene_, id, ray);
    const bool tie = t == nearest.t && (nearest.id == no_primitive || id < nearest.id);
    if (t < inf && (t < nearest.t || tie)) nearest = {t, id};
    return false;
  });
  return nearest.id == no_primitive ? Hit{} : nearest;
}

bool DoubleTree::any_hit(const Ray& ray) const {
  bool hit = false;
  const double limit{ray.tmax};
  traverse(ray, limit, [&](std::int32_t id) {
    hit = intersect(scene_, id, ray) < inf;
    return hit;
  });
  return hit;
}

void DoubleTree::for_each_candidate(const Ray& ray,
                                    const std::function<void(std::int32_t)>& visit) const {
  const double limit{ray.tmax};
  traverse(ray, limit, [&](std::int32_t id) {
    visit(id);
    return false;
  });
}

}  // namespace boule::bench
