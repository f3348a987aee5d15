#include "simd/geometry/part_boxes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "simd/abi/filter_bounds.h"
#include "simd/geometry/node_boxes.h"
#include "simd/geometry/part_placement.h"

namespace boule {
namespace {

/// The box of a node's child k, moved as the kernels move it (simd/kernel/search/packet/parts.h),
/// but in double.
BuildBox moved_box(const BvhNode& node, std::size_t k, const PlacementView& placement) {
  const double low[3] = {node.min_x[k], node.min_y[k], node.min_z[k]};
  const double high[3] = {node.max_x[k], node.max_y[k], node.max_z[k]};
  constexpr double outward = filter::moved_box * filter::u;
  const Vec3d rows[3] = {placement.row_x, placement.row_y, placement.row_z};
  const double shift[3] = {placement.shift.x, placement.shift.y, placement.shift.z};
  BuildBox box;
  for (int i = 0; i < 3; ++i) {
    const double row[3] = {rows[i].x, rows[i].y, rows[i].z};
    double middle = shift[i], size = std::fabs(middle) * outward;
    for (int j = 0; j < 3; ++j) {
      const double along = placement.scale * row[j];
      const double farthest = std::max(std::fabs(low[j]), std::fabs(high[j]));
      middle += along * (low[j] + high[j]) / 2;
      size += std::fabs(along) *
              ((high[j] - low[j]) / 2 + farthest * outward + double{filter::moved_least});
    }
    box.low[i] = static_cast<float>(middle - size);
    box.high[i] = static_cast<float>(middle + size);
  }
  return box;
}

/// Divides boxes in halves, the largest first, until their number is that of a node's children.
class BoxTree {
 public:
  explicit BoxTree(std::span<const BuildBox> boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    add({0, order_.size(), {}});
  }
  std::vector<BvhNode> take() { return std::move(nodes_); }

 private:
  struct Run {
    std::size_t begin, end;
    BuildBox box;

    [[nodiscard]] std::size_t size() const { return end - begin; }
  };

  /// Appends the tree over a run and returns the index of its root.
  std::uint32_t add(const Run& run) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    BvhNode node = empty_node();
    for (const Run& child : children_of(run)) {
      set_child_box(node, node.size, child.box);
      const bool single = child.size() == 1;
      node.child[node.size] = single ? order_[child.begin] | leaf_bit : add(child);
      node.leaf_size[node.size++] = single ? 1 : 0;
    }
    nodes_[index] = node;
    return index;
  }

  std::vector<Run> children_of(const Run& run) {
    std::vector<Run> children{with_box(run.begin, run.end)};
    while (children.size() < bvh_width) {
      Run* largest = nullptr;
      for (Run& one : children) {
        if (one.size() < 2) continue;
        if (largest == nullptr || largest->box.area() < one.box.area()) largest = &one;
      }
      if (largest == nullptr) break;
      const Run whole = *largest;
      const std::size_t middle = halve(whole);
      *largest = with_box(whole.begin, middle);
      children.push_back(with_box(middle, whole.end));
    }
    return children;
  }

  /// Moves one half of a run before the other, along the longest axis. Each half has at most half
  /// of the node's boxes, which bounds the depth by the logarithm of their number.
  std::size_t halve(const Run& run) {
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (run.box.high[k] - run.box.low[k] > run.box.high[axis] - run.box.low[axis]) axis = k;
    }
    const auto at = [this](std::size_t i) {
      return order_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto middle_of = [&](std::uint32_t box) {
      return boxes_[box].low[axis] / 2 + boxes_[box].high[axis] / 2;
    };
    const std::size_t middle = run.begin + run.size() / 2;
    std::nth_element(at(run.begin), at(middle), at(run.end), [&](std::uint32_t a, std::uint32_t b) {
      return middle_of(a) != middle_of(b) ? middle_of(a) < middle_of(b) : a < b;
    });
    return middle;
  }

  [[nodiscard]] Run with_box(std::size_t begin, std::size_t end) const {
    BuildBox box;
    for (std::size_t i = begin; i < end; ++i) box.add(boxes_[order_[i]]);
    return {begin, end, box};
  }

  std::span<const BuildBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<BvhNode> nodes_;
};

}  // namespace

BuildBox box_of(const PartView& part) {
  BuildBox box;
  if (part.nodes != nullptr) {
    const BvhNode& root = part.nodes[0];
    for (std::size_t k = 0; k < root.size; ++k) {
      box.add(part.placement.moves ? moved_box(root, k, part.placement) : child_box(root, k));
    }
  }
  for (std::uint32_t slot = 0; slot < part.scanned_spheres; ++slot) {
    const Sphere s = sphere_of(part, slot);
    box.add(outward_box({{s.center.x, s.center.y, s.center.z, s.radius}, 0}));
  }
  box.low[3] = box.high[3] = 0;
  return box;
}

std::vector<BvhNode> build_box_tree(std::span<const BuildBox> boxes) {
  return BoxTree(boxes).take();
}

}  // namespace boule
