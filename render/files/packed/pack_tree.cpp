#include "render/files/packed/pack_tree.h"

#include <algorithm>
#include <vector>

#include "simd/geometry/binary_tree.h"
#include "simd/geometry/node_boxes.h"

namespace boule {
namespace {

/// Nodes above buckets lie so deep at most: below, a bucket of 2^31 spheres has room.
constexpr int most_depth = 20;

BuildBox box_of(const BvhNode& node) {
  BuildBox box;
  for (std::size_t k = 0; k < node.size; ++k) {
    box.add(child_box(node, k));
  }
  return box;
}

/// Appends a node as a child.
void add_child(BvhNode& node, const BuildBox& box, std::uint32_t child) {
  const std::size_t k = node.size++;
  set_child_box(node, k, box);
  node.child[k] = child;
}

/// How many spheres lie below each cut.
std::vector<std::uint64_t> counts_of(const Partition& partition, const BucketStore& store) {
  const std::vector<Partition::Cut>& cuts = partition.cuts();
  std::vector<std::uint64_t> counts(cuts.size());
  for (std::size_t i = cuts.size(); i-- > 0;) {
    const Partition::Cut& cut = cuts[i];
    counts[i] = cut.axis < 0 ? store.count(cut.bucket) : counts[cut.left] + counts[cut.right];
  }
  return counts;
}

/// The cuts that are the children of a node: those with the most spheres are opened, as long as
/// there is room.
std::vector<std::uint32_t> children_of(const Partition& partition,
                                       const std::vector<std::uint64_t>& counts,
                                       std::uint32_t root) {
  const std::vector<Partition::Cut>& cuts = partition.cuts();
  std::vector<std::uint32_t> children{root};
  const auto weight = [&](std::uint32_t cut) { return cuts[cut].axis < 0 ? 0 : counts[cut]; };
  while (children.size() < static_cast<std::size_t>(bvh_width)) {
    const auto largest =
        std::max_element(children.begin(), children.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return weight(a) < weight(b); });
    if (weight(*largest) == 0) break;
    const Partition::Cut& cut = cuts[*largest];
    *largest = counts[cut.left] > 0 ? cut.left : cut.right;
    if (counts[cut.left] > 0 && counts[cut.right] > 0) children.push_back(cut.right);
  }
  return children;
}

/// How many nodes a cut and those below it become.
std::uint32_t count_nodes(const Partition& partition, const std::vector<std::uint64_t>& counts,
                          std::uint32_t cut) {
  std::uint32_t count = 1;
  for (const std::uint32_t child : children_of(partition, counts, cut)) {
    if (partition.cuts()[child].axis >= 0) count += count_nodes(partition, counts, child);
  }
  return count;
}

bool are_copies(const Sphere& a, const Sphere& b) {
  return a.center == b.center && a.radius == b.radius;
}

}  // namespace

Status PackTree::add(const Partition& partition, BucketStore& store) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < store.size(); ++i) count += store.count(i);
  if (count == 0) return {};
  const auto part = add(partition, store, 1);
  return part ? Status() : part.error();
}

Result<PackTree::Part> PackTree::add(const Partition& partition, BucketStore& store, int depth) {
  if (partition.is_one()) return add_bucket(store, 0, depth);
  Plan plan{partition, store, counts_of(partition, store)};
  const auto first = writer_.reserve_nodes(count_nodes(partition, plan.counts, 0));
  if (!first) return first.error();
  plan.next_node = first.value();
  return add_node(plan, 0, depth);
}

Result<PackTree::Part> PackTree::add_node(Plan& plan, std::uint32_t cut, int depth) {
  if (depth > most_depth) return Diagnostic::of("its spheres lie too unevenly to be packed");
  Part part;
  part.node = plan.next_node++;
  BvhNode node = empty_node();
  for (const std::uint32_t child : children_of(plan.partition, plan.counts, cut)) {
    const Partition::Cut& of_child = plan.partition.cuts()[child];
    const auto below = of_child.axis >= 0 ? add_node(plan, child, depth + 1)
                                          : add_bucket(plan.store, of_child.bucket, depth + 1);
    if (!below) return below.error();
    add_child(node, below.value().box, below.value().node);
    part.box.add(below.value().box);
  }
  if (auto done = writer_.set_node(part.node, node); !done) return done.error();
  return part;
}

Result<PackTree::Part> PackTree::add_bucket(BucketStore& store, std::size_t bucket, int depth) {
  if (means_.stop && means_.stop()) return Diagnostic::of("interrupted");
  return store.count(bucket) <= std::max<std::uint64_t>(spheres_in_memory(means_.memory), 1)
             ? build(store, bucket, depth)
             : divide(store, bucket, depth);
}

Result<PackTree::Part> PackTree::build(BucketStore& store, std::size_t bucket, int depth) {
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> ids;
  spheres.reserve(static_cast<std::size_t>(store.count(bucket)));
  ids.reserve(spheres.capacity());
  const auto take = [&](std::span<const PackedSphere> some) -> Status {
    for (const PackedSphere& one : some) {
      spheres.push_back(one.sphere);
      ids.push_back(one.id);
    }
    return {};
  };
  if (auto done = store.drain(bucket, take); !done) return done.error();
  const Bvh tree =
      build_bvh(std::move(spheres), means_.parallel_for, {.depth = depth, .keeps_apart = false});
  const auto node = writer_.append(tree, ids);
  if (!node) return node.error();
  return Part{box_of(tree.nodes[0]), node.value()};
}

/// Divides the spheres of a bucket that are too many. They are read twice: first into a store of
/// one bucket, for a sample of them.
Result<PackTree::Part> PackTree::divide(BucketStore& store, std::size_t bucket, int depth) {
  SphereSample sample;
  BucketStore whole(1, means_.memory / 4, means_.beside);
  const auto copy = [&](std::span<const PackedSphere> some) -> Status {
    for (const PackedSphere& one : some) {
      sample.add(one.sphere);
      if (auto done = whole.add(0, one); !done) return done;
    }
    return {};
  };
  if (auto done = store.drain(bucket, copy); !done) return done.error();
  const Partition partition(sample, spheres_in_memory(means_.memory));
  if (partition.is_one()) return add_without_copies(whole, 0, sample.spheres().front(), depth);
  BucketStore parts(partition.buckets(), means_.memory / 4, means_.beside);
  const auto distribute = [&](std::span<const PackedSphere> some) -> Status {
    for (const PackedSphere& one : some) {
      if (auto done = parts.add(partition.bucket_of(one.sphere), one); !done) return done;
    }
    return {};
  };
  if (auto done = whole.drain(0, distribute); !done) return done.error();
  if (auto done = parts.settle(); !done) return done.error();
  return add(partition, parts, depth);
}

/// Of all copies of one sphere only the first kept_copies are of use, as build_bvh() knows.
Result<PackTree::Part> PackTree::add_without_copies(BucketStore& store, std::size_t bucket,
                                                    const Sphere& sphere, int depth) {
  BucketStore rest(1, means_.memory / 4, means_.beside);
  int copies = 0;
  const auto keep = [&](std::span<const PackedSphere> some) -> Status {
    for (const PackedSphere& one : some) {
      if (are_copies(one.sphere, sphere) && copies++ >= kept_copies) continue;
      if (auto done = rest.add(0, one); !done) return done;
    }
    return {};
  };
  if (auto done = store.drain(bucket, keep); !done) return done.error();
  return add_bucket(rest, 0, depth);
}

}  // namespace boule
