#include "simd/build/bvh_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/math/vec.h"
#include "simd/abi/isa.h"
#include "simd/build/filter_range.h"

namespace boule {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

/// An axis-aligned box; the default one is empty.
struct Box {
  Vec3f min{inf, inf, inf}, max{-inf, -inf, -inf};

  void add(const Box& b) {
    min = {std::min(min.x, b.min.x), std::min(min.y, b.min.y), std::min(min.z, b.min.z)};
    max = {std::max(max.x, b.max.x), std::max(max.y, b.max.y), std::max(max.z, b.max.z)};
  }
  /// Half of the surface, in double: boxes of 1e18 square well.
  [[nodiscard]] double area() const {
    const double x = double{max.x} - double{min.x}, y = double{max.y} - double{min.y};
    const double z = double{max.z} - double{min.z};
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

float below(double x) { return std::nextafter(std::nextafter(static_cast<float>(x), -inf), -inf); }
float above(double x) { return std::nextafter(std::nextafter(static_cast<float>(x), inf), inf); }

/// Two float steps outward on each side: the box holds the sphere whatever was rounded.
Box box_of(const Sphere& sphere) {
  const double r = std::fabs(double{sphere.radius});
  const Vec3d c = vec_cast<double>(sphere.center);
  return {{below(c.x - r), below(c.y - r), below(c.z - r)},
          {above(c.x + r), above(c.y + r), above(c.z + r)}};
}

float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// A run of spheres in `order` that becomes a child.
struct Run {
  std::size_t begin, end;
  Box box;
  [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Where to cut a run: spheres whose centre lies in a bin below `bin` go left.
struct Cut {
  int axis = -1, bin = 0;
  double cost = std::numeric_limits<double>::infinity();
};

class Builder {
 public:
  explicit Builder(const std::vector<Sphere>& spheres) : spheres_(spheres) {}

  Bvh build() {
    Bvh bvh;
    std::vector<std::int32_t> apart;
    set_apart(apart);
    bvh.slots = apart;
    pad(bvh.slots, max_width);
    bvh.scanned = bvh.slots.size();
    if (order_.empty()) return bvh;
    bvh.nodes.emplace_back();
    fill(bvh, 0, run_of(0, order_.size()), 1);
    return bvh;
  }

 private:
  static constexpr int bins = 16;
  /// From this depth on runs are halved, largest first: eight equal parts a level, so that 2^31
  /// spheres end 11 levels below.
  static constexpr int halving_depth = 32;

  static void pad(std::vector<std::int32_t>& slots, std::size_t multiple) {
    while (slots.size() % multiple != 0) slots.push_back(-1);
  }

  /// Divides the spheres into those of the tree, `order_`, and those kept apart.
  void set_apart(std::vector<std::int32_t>& apart) {
    constexpr std::size_t most = 16;
    Box all;
    for (const Sphere& s : spheres_) {
      if (in_filter_range(s)) all.add(box_of(s));
    }
    std::size_t giants = 0;
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      const auto index = static_cast<std::int32_t>(i);
      const bool fits = in_filter_range(spheres_[i]);
      const bool giant = fits && giants < most && box_of(spheres_[i]).area() > 0.25 * all.area();
      giants += giant ? 1 : 0;
      (fits && !giant ? order_ : apart).push_back(index);
    }
  }

  [[nodiscard]] const Sphere& sphere(std::size_t i) const {
    return spheres_[static_cast<std::size_t>(order_[i])];
  }
  [[nodiscard]] Run run_of(std::size_t begin, std::size_t end) const {
    Run run{begin, end, {}};
    for (std::size_t i = begin; i < end; ++i) run.box.add(box_of(sphere(i)));
    return run;
  }

  /// Fills node `index` with the children of `run`.
  void fill(Bvh& bvh, std::size_t index, const Run& run, int depth) {
    const std::vector<Run> children = split(run, depth);
    BvhNode node = empty_node();
    node.size = static_cast<std::uint8_t>(children.size());
    for (std::size_t k = 0; k < children.size(); ++k) set_box(node, k, children[k].box);
    for (std::size_t k = 0; k < children.size(); ++k) {
      const Run& child = children[k];
      if (child.size() <= bvh_leaf_size) {
        node.leaf_size[k] = static_cast<std::uint8_t>(child.size());
        node.child[k] =
            static_cast<std::uint32_t>((bvh.slots.size() - bvh.scanned) / bvh_leaf_size);
        for (std::size_t i = child.begin; i < child.end; ++i) bvh.slots.push_back(order_[i]);
        bvh.slots.resize(bvh.scanned + (node.child[k] + std::size_t{1}) * bvh_leaf_size, -1);
      } else {
        node.child[k] = static_cast<std::uint32_t>(bvh.nodes.size());
        bvh.nodes.emplace_back();
        fill(bvh, node.child[k], child, depth + 1);
      }
    }
    bvh.nodes[index] = node;
  }

  /// Up to eight runs that make up `run`.
  std::vector<Run> split(const Run& run, int depth) {
    const bool halving = depth >= halving_depth;
    std::vector<Run> children = {run};
    while (children.size() < static_cast<std::size_t>(bvh_width)) {
      Run* widest = nullptr;
      double most = -1;
      for (Run& child : children) {
        const double weight = halving ? static_cast<double>(child.size()) : child.box.area();
        if (child.size() > bvh_leaf_size && weight > most) {
          widest = &child;
          most = weight;
        }
      }
      if (widest == nullptr) break;
      const Run whole = *widest;
      const std::size_t middle = halving ? whole.begin + whole.size() / 2 : cut(whole);
      *widest = run_of(whole.begin, middle);
      children.push_back(run_of(middle, whole.end));
    }
    return children;
  }

  /// Sorts a run into two by the best cut and returns where the second begins.
  std::size_t cut(const Run& run) {
    Box centers;
    for (std::size_t i = run.begin; i < run.end; ++i)
      centers.add({sphere(i).center, sphere(i).center});
    Cut best;
    for (int axis = 0; axis < 3; ++axis) consider(run, centers, axis, best);
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(run.begin);
    const auto last = order_.begin() + static_cast<std::ptrdiff_t>(run.end);
    if (best.axis < 0) return run.begin + run.size() / 2;  // all centres in one place
    const auto middle = std::partition(first, last, [&](std::int32_t i) {
      const Vec3f& center = spheres_[static_cast<std::size_t>(i)].center;
      return bin_of(center, centers, best.axis) < best.bin;
    });
    return run.begin + static_cast<std::size_t>(middle - first);
  }

  static int bin_of(const Vec3f& center, const Box& centers, int axis) {
    const double low = component(centers.min, axis), high = component(centers.max, axis);
    const double place = (double{component(center, axis)} - low) / (high - low);
    return std::min(static_cast<int>(place * bins), bins - 1);
  }

  void consider(const Run& run, const Box& centers, int axis, Cut& best) const {
    if (!(component(centers.min, axis) < component(centers.max, axis))) return;
    std::array<Box, bins> boxes;
    std::array<std::size_t, bins> counts{};
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const auto bin = static_cast<std::size_t>(bin_of(sphere(i).center, centers, axis));
      boxes[bin].add(box_of(sphere(i)));
      ++counts[bin];
    }
    std::array<double, bins> left_cost{};
    Box box;
    std::size_t count = 0;
    for (std::size_t bin = 0; bin + 1 < bins; ++bin) {
      box.add(boxes[bin]);
      count += counts[bin];
      left_cost[bin] = cost(box, count);
    }
    box = {};
    count = 0;
    for (std::size_t bin = bins - 1; bin > 0; --bin) {
      box.add(boxes[bin]);
      count += counts[bin];
      const double both = left_cost[bin - 1] + cost(box, count);
      if (count < run.size() && count > 0 && both < best.cost)
        best = {axis, static_cast<int>(bin), both};
    }
  }

  /// What a run costs those who meet its box: its leaves, as many as it fills.
  static double cost(const Box& box, std::size_t count) {
    return box.area() * static_cast<double>((count + bvh_leaf_size - 1) / bvh_leaf_size);
  }

  static BvhNode empty_node() {
    BvhNode node{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(bvh_width); ++k) set_box(node, k, {});
    return node;
  }
  static void set_box(BvhNode& node, std::size_t k, const Box& box) {
    node.min_x[k] = box.min.x;
    node.min_y[k] = box.min.y;
    node.min_z[k] = box.min.z;
    node.max_x[k] = box.max.x;
    node.max_y[k] = box.max.y;
    node.max_z[k] = box.max.z;
  }

  const std::vector<Sphere>& spheres_;
  std::vector<std::int32_t> order_;  ///< of the tree
};

}  // namespace

Bvh build_bvh(const std::vector<Sphere>& spheres) { return Builder(spheres).build(); }

Bvh no_bvh(std::size_t spheres) {
  Bvh bvh;
  bvh.slots.resize(spheres);
  std::iota(bvh.slots.begin(), bvh.slots.end(), 0);
  bvh.scanned = spheres;
  return bvh;
}

}  // namespace boule
