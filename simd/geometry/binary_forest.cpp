#include "simd/geometry/binary_forest.h"

#include <algorithm>
#include <numeric>

#include "core/base/memory_pages.h"
#include "simd/abi/bvh.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

/// Part of a run: what one thread bins or moves at a time.
struct Chunk {
  std::size_t run, begin, end;
  std::size_t lefts = 0;  ///< of its spheres
};

/// Some spheres that follow each other.
struct Piece {
  std::size_t begin, end;

  [[nodiscard]] std::size_t size() const { return begin < end ? end - begin : 0; }
};

/// As many spheres in two places that change places.
struct Exchange {
  std::size_t a, b, size;
};

/// Lists how the spheres of two lists of pieces, equally many, change places, in order.
void list_exchanges(const std::vector<Piece>& a, const std::vector<Piece>& b,
                    std::vector<Exchange>& exchanges) {
  std::size_t of_b = 0, done_of_b = 0;
  for (const Piece& piece : a) {
    for (std::size_t at = piece.begin; at < piece.end;) {
      const std::size_t size = std::min(piece.end - at, b[of_b].size() - done_of_b);
      exchanges.push_back({at, b[of_b].begin + done_of_b, size});
      at += size;
      done_of_b += size;
      if (done_of_b == b[of_b].size()) {
        ++of_b;
        done_of_b = 0;
      }
    }
  }
}

}  // namespace

/// The runs of one level, and how each of them is to be divided.
struct BinaryForest::Level {
  Level(std::span<BuildSphere> all, const std::vector<Run>& all_runs)
      : spheres(all), runs(all_runs), grids(runs.size()), cuts(runs.size()), middles(runs.size()) {
    for (std::size_t run = 0; run < runs.size(); ++run) {
      for (std::size_t i = runs[run].begin; i < runs[run].end; i += tuning::chunk_size)
        chunks.push_back({run, i, std::min(i + tuning::chunk_size, runs[run].end)});
    }
  }

  [[nodiscard]] std::span<BuildSphere> spheres_of(const Chunk& chunk) const {
    return spheres.subspan(chunk.begin, chunk.end - chunk.begin);
  }

  /// Finds the best cut of each run, and how many spheres go left.
  void find_cuts(const ParallelFor& parallel_for) {
    std::vector<BuildBox> extents(chunks.size()), run_extents(runs.size());
    parallel_for(chunks.size(),
                 [&](std::size_t i) { extents[i] = extent_of(spheres_of(chunks[i])); });
    for (std::size_t i = 0; i < chunks.size(); ++i) run_extents[chunks[i].run].add(extents[i]);
    for (std::size_t run = 0; run < runs.size(); ++run) grids[run] = BinGrid(run_extents[run]);
    std::vector<Bins> bins(chunks.size()), run_bins(runs.size());
    parallel_for(chunks.size(),
                 [&](std::size_t i) { bins[i].add(grids[chunks[i].run], spheres_of(chunks[i])); });
    for (std::size_t i = 0; i < chunks.size(); ++i) run_bins[chunks[i].run].add(bins[i]);
    for (std::size_t run = 0; run < runs.size(); ++run) {
      cuts[run] = best_cut(run_bins[run], grids[run].axes());
      if (cuts[run].axis >= 0) middles[run] = count_left(run_bins[run], cuts[run]);
    }
  }

  /// Divides the runs that have a cut. First each chunk by itself; then the right spheres that lie
  /// before the middle of their run and the left ones behind it change places.
  void divide(const ParallelFor& parallel_for) {
    parallel_for(chunks.size(), [&](std::size_t i) {
      Chunk& chunk = chunks[i];
      if (cuts[chunk.run].axis < 0) return;
      const std::size_t size = chunk.end - chunk.begin;
      const auto scratch = std::make_unique_for_overwrite<BuildSphere[]>(size);
      chunk.lefts =
          partition(spheres_of(chunk), grids[chunk.run], cuts[chunk.run], {scratch.get(), size});
    });
    const std::vector<Exchange> exchanges = find_exchanges();
    parallel_for(exchanges.size(), [&](std::size_t i) {
      const auto first = spheres.begin() + static_cast<std::ptrdiff_t>(exchanges[i].a);
      std::swap_ranges(first, first + static_cast<std::ptrdiff_t>(exchanges[i].size),
                       spheres.begin() + static_cast<std::ptrdiff_t>(exchanges[i].b));
    });
  }

  [[nodiscard]] std::vector<Exchange> find_exchanges() const {
    std::vector<Exchange> exchanges;
    std::vector<Piece> rights, lefts;  // of one run, that lie on the wrong side
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      const Chunk& chunk = chunks[i];
      if (cuts[chunk.run].axis < 0) continue;
      const std::size_t middle = runs[chunk.run].begin + middles[chunk.run];
      const std::size_t first_right = chunk.begin + chunk.lefts;
      const Piece right{first_right, std::min(chunk.end, middle)};
      const Piece left{std::max(chunk.begin, middle), first_right};
      if (right.size() > 0) rights.push_back(right);
      if (left.size() > 0) lefts.push_back(left);
      if (chunk.end < runs[chunk.run].end) continue;
      list_exchanges(rights, lefts, exchanges);
      rights.clear();
      lefts.clear();
    }
    return exchanges;
  }

  std::span<BuildSphere> spheres;
  const std::vector<Run>& runs;
  std::vector<BinGrid> grids;
  std::vector<Cut> cuts;
  std::vector<std::size_t> middles;  ///< spheres of each run that go left
  std::vector<Chunk> chunks;
};

BinaryForest::BinaryForest(std::span<BuildSphere> spheres, const ParallelFor& parallel_for,
                           int depth)
    : spheres_(spheres),
      subtree_size_(std::max(tuning::least_subtree, spheres.size() / tuning::most_subtrees)) {
  std::vector<Run> runs;
  const Run whole{0, spheres.size(), depth, ForestNode::upper, false};
  whole.end <= subtree_size_ ? add_subtree(whole) : runs.push_back(whole);
  const ParallelFor level_for = spheres.size() < tuning::parallel_size ? serial_for : parallel_for;
  while (!runs.empty()) runs = divide(runs, level_for);
  order_.resize(subtrees_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [this](std::uint32_t a, std::uint32_t b) {
    return subtrees_[a].begin < subtrees_[b].begin;
  });
  parallel_for(order_.size(), [&](std::size_t i) { build(subtrees_[order_[i]]); });
  finish_upper();
}

void BinaryForest::build(Subtree& subtree) {
  const std::size_t size = subtree.end - subtree.begin;
  const auto scratch = std::make_unique_for_overwrite<BuildSphere[]>(size);
  subtree.tree = build_binary_tree(spheres_.subspan(subtree.begin, size), {scratch.get(), size},
                                   subtree.depth);
  subtree.tree.nodes.shrink_to_fit();
}

void BinaryForest::drop(std::uint32_t subtree) {
  std::vector<BinaryNode>& nodes = subtrees_[subtree].tree.nodes;
  // The allocator keeps blocks of this size for later, and would keep their pages.
  release_pages(nodes.data(), nodes.size() * sizeof(BinaryNode));
  std::vector<BinaryNode>().swap(nodes);
}

void BinaryForest::attach(const Run& run, ForestNode node) {
  if (run.parent == ForestNode::upper) {
    root_ = node;
  } else {
    UpperNode& parent = upper_[run.parent];
    (run.is_right ? parent.right : parent.left) = node;
  }
}

void BinaryForest::add_subtree(const Run& run) {
  attach(run, {static_cast<std::uint32_t>(subtrees_.size()), 0});
  subtrees_.push_back({run.begin, run.end, run.depth});
}

/// Divides the runs of one level and returns those of the next.
std::vector<BinaryForest::Run> BinaryForest::divide(const std::vector<Run>& runs,
                                                    const ParallelFor& parallel_for) {
  Level level(spheres_, runs);
  level.find_cuts(parallel_for);
  level.divide(parallel_for);
  std::vector<Run> next;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (level.cuts[i].axis < 0) {
      add_subtree(runs[i]);
    } else {
      add_children(next, runs[i], level.middles[i]);
    }
  }
  return next;
}

/// Makes an upper node of `run`, which is divided.
void BinaryForest::add_children(std::vector<Run>& next, const Run& run, std::size_t middle) {
  const auto node = static_cast<std::uint32_t>(upper_.size());
  upper_.emplace_back();
  attach(run, {ForestNode::upper, node});
  const Run left{run.begin, run.begin + middle, run.depth + 1, node, false};
  const Run right{run.begin + middle, run.end, run.depth + 1, node, true};
  for (const Run& child : {left, right}) {
    const std::size_t size = child.end - child.begin;
    const bool deep = child.depth + halving_levels(size) > bvh_max_depth;
    size <= subtree_size_ || deep ? add_subtree(child) : next.push_back(child);
  }
}

/// Numbers the leaves and finds the boxes and shares of the upper nodes, the last one first:
/// children come after their parents.
void BinaryForest::finish_upper() {
  for (const std::uint32_t i : order_) {
    subtrees_[i].first_leaf = static_cast<std::uint32_t>(leaves_);
    leaves_ += subtrees_[i].tree.leaves;
  }
  std::vector<CollapseCosts> costs(upper_.size());
  const auto costs_of = [&](ForestNode node) {
    return node.tree == ForestNode::upper ? costs[node.node] : subtrees_[node.tree].tree.costs;
  };
  for (std::size_t i = upper_.size(); i-- > 0;) {
    UpperNode& upper = upper_[i];
    BuildBox box = (*this)[upper.left].box();
    box.add((*this)[upper.right].box());
    upper.node.set_box(box);
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
