#include "simd/geometry/binary_forest.h"

#include <algorithm>

#include "simd/abi/bvh.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

/// Part of a run: what one thread bins or moves at a time.
struct Chunk {
  std::size_t run, begin, end;
  std::size_t lefts_before = 0;  ///< of the run, in chunks before this one
};

}  // namespace

/// The runs of one level, and how each of them is to be divided.
struct BinaryForest::Level {
  explicit Level(const std::vector<Run>& runs) : grids(runs.size()), cuts(runs.size()) {
    middles.resize(runs.size());
    for (std::size_t run = 0; run < runs.size(); ++run) {
      for (std::size_t i = runs[run].begin; i < runs[run].end; i += tuning::chunk_size)
        chunks.push_back({run, i, std::min(i + tuning::chunk_size, runs[run].end)});
    }
  }

  /// Finds the best cut of each run, and how many spheres of each chunk go left.
  void find_cuts(const SphereBuffers& buffers, int side, const ParallelFor& parallel_for) {
    const auto spheres = [&](const Chunk& c) { return buffers.run(side, c.begin, c.end); };
    std::vector<BuildBox> extents(chunks.size()), run_extents(grids.size());
    parallel_for(chunks.size(), [&](std::size_t i) { extents[i] = extent_of(spheres(chunks[i])); });
    for (std::size_t i = 0; i < chunks.size(); ++i) run_extents[chunks[i].run].add(extents[i]);
    for (std::size_t run = 0; run < grids.size(); ++run) grids[run] = BinGrid(run_extents[run]);
    std::vector<Bins> bins(chunks.size()), run_bins(grids.size());
    parallel_for(chunks.size(),
                 [&](std::size_t i) { bins[i].add(grids[chunks[i].run], spheres(chunks[i])); });
    for (std::size_t i = 0; i < chunks.size(); ++i) run_bins[chunks[i].run].add(bins[i]);
    for (std::size_t run = 0; run < grids.size(); ++run)
      cuts[run] = best_cut(run_bins[run], grids[run].axes());
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      Chunk& chunk = chunks[i];
      if (cuts[chunk.run].axis < 0) continue;
      chunk.lefts_before = middles[chunk.run];
      middles[chunk.run] += count_left(bins[i], cuts[chunk.run]);
    }
  }

  std::vector<BinGrid> grids;
  std::vector<Cut> cuts;
  std::vector<std::size_t> middles;  ///< spheres of each run that go left
  std::vector<Chunk> chunks;
};

BinaryForest::BinaryForest(SphereBuffers& buffers, const ParallelFor& parallel_for)
    : buffers_(buffers),
      subtree_size_(std::max(tuning::least_subtree, buffers.size / tuning::most_subtrees)) {
  std::vector<Run> runs;
  const Run whole{0, buffers.size, 1, ForestNode::upper, false};
  whole.end <= subtree_size_ ? add_subtree(whole, 0) : runs.push_back(whole);
  const ParallelFor level_for = buffers.size < tuning::parallel_size ? serial_for : parallel_for;
  for (int side = 0; !runs.empty(); side = 1 - side) runs = divide(runs, side, level_for);
  parallel_for(subtrees_.size(), [&](std::size_t i) {
    Subtree& s = subtrees_[i];
    s.tree = build_binary_tree(buffers_.run(s.side, s.begin, s.end),
                               buffers_.run(1 - s.side, s.begin, s.end), s.depth);
  });
  finish_upper();
}

void BinaryForest::attach(const Run& run, ForestNode node) {
  if (run.parent == ForestNode::upper) {
    root_ = node;
  } else {
    UpperNode& parent = upper_[run.parent];
    (run.is_right ? parent.right : parent.left) = node;
  }
}

void BinaryForest::add_subtree(const Run& run, int side) {
  attach(run, {static_cast<std::uint32_t>(subtrees_.size()), 0});
  subtrees_.push_back({run.begin, run.end, side, run.depth});
}

/// Divides the runs of one level, which lie on `side`, and returns those of the next.
std::vector<BinaryForest::Run> BinaryForest::divide(const std::vector<Run>& runs, int side,
                                                    const ParallelFor& parallel_for) {
  Level level(runs);
  level.find_cuts(buffers_, side, parallel_for);
  parallel_for(level.chunks.size(), [&](std::size_t i) {
    const Chunk& chunk = level.chunks[i];
    const Run& run = runs[chunk.run];
    if (level.cuts[chunk.run].axis < 0) return;
    const std::size_t rights_before = chunk.begin - run.begin - chunk.lefts_before;
    BuildSphere* const target = buffers_.run(1 - side, run.begin, run.end).data();
    partition(buffers_.run(side, chunk.begin, chunk.end), level.grids[chunk.run],
              level.cuts[chunk.run],
              {target + chunk.lefts_before, target + level.middles[chunk.run] + rights_before});
  });
  std::vector<Run> next;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (level.cuts[i].axis < 0) {
      add_subtree(runs[i], side);
    } else {
      add_children(next, runs[i], level.middles[i], 1 - side);
    }
  }
  return next;
}

/// Makes an upper node of `run`, whose parts now lie on `side`.
void BinaryForest::add_children(std::vector<Run>& next, const Run& run, std::size_t middle,
                                int side) {
  const auto node = static_cast<std::uint32_t>(upper_.size());
  upper_.emplace_back();
  attach(run, {ForestNode::upper, node});
  const Run left{run.begin, run.begin + middle, run.depth + 1, node, false};
  const Run right{run.begin + middle, run.end, run.depth + 1, node, true};
  for (const Run& child : {left, right}) {
    const std::size_t size = child.end - child.begin;
    const bool deep = child.depth + halving_levels(size) > bvh_max_depth;
    size <= subtree_size_ || deep ? add_subtree(child, side) : next.push_back(child);
  }
}

/// Numbers the leaves and finds the boxes and shares of the upper nodes, the last one first:
/// children come after their parents.
void BinaryForest::finish_upper() {
  for (Subtree& subtree : subtrees_) {
    subtree.first_leaf = leaves_;
    leaves_ += subtree.tree.leaves;
  }
  std::vector<CollapseCosts> costs(upper_.size());
  const auto costs_of = [&](ForestNode node) {
    return node.tree == ForestNode::upper ? costs[node.node] : subtrees_[node.tree].tree.costs;
  };
  for (std::size_t i = upper_.size(); i-- > 0;) {
    UpperNode& upper = upper_[i];
    upper.node.size = 0;
    upper.node.box = (*this)[upper.left].box;
    upper.node.box.add((*this)[upper.right].box);
    costs[i] = choose_shares(upper.node, costs_of(upper.left), costs_of(upper.right));
  }
}

const BinaryNode& BinaryForest::operator[](ForestNode node) const {
  if (node.tree == ForestNode::upper) return upper_[node.node].node;
  return subtrees_[node.tree].tree.nodes[node.node];
}

ForestNode BinaryForest::left(ForestNode node) const {
  if (node.tree == ForestNode::upper) return upper_[node.node].left;
  return {node.tree, node.node + 1};
}

ForestNode BinaryForest::right(ForestNode node) const {
  if (node.tree == ForestNode::upper) return upper_[node.node].right;
  return {node.tree, (*this)[node].right};
}

}  // namespace boule
