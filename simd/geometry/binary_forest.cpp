#include "simd/geometry/binary_forest.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "simd/abi/bvh.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

/// Part of a run, which one thread bins or moves at a time.
struct Chunk {
  std::size_t run, begin, end;
  std::size_t lefts = 0;                         ///< number of its spheres that go left
  BuildBox left_extent = {}, right_extent = {};  ///< extent of those, and of the others
};

/// Spheres that lie side by side.
struct Piece {
  std::size_t begin, end;

  [[nodiscard]] std::size_t size() const { return begin < end ? end - begin : 0; }
};

/// Two equally long pieces of spheres that swap places.
struct Exchange {
  std::size_t a, b, size;
};

/// Lists, in order, how the spheres of two lists of pieces, equally many, swap places.
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

/// The extent of spheres, found by all threads.
BuildBox extent_of(std::span<const BuildSphere> spheres, const ParallelFor& parallel_for) {
  constexpr std::size_t size = tuning::chunk_size;
  std::vector<BuildBox> extents((spheres.size() + size - 1) / size);
  parallel_for(extents.size(), [&](std::size_t i) {
    const auto rest = spheres.subspan(i * size);
    extents[i] = boule::extent_of(rest.first(std::min(size, rest.size())));
  });
  BuildBox all;
  for (const BuildBox& extent : extents) all.add(extent);
  return all;
}

}  // namespace

/// The runs of one level, and the division of each of them.
struct BinaryForest::Level {
  Level(std::span<BuildSphere> all, const std::vector<Run>& all_runs, ScratchRooms& all_rooms)
      : spheres(all),
        runs(all_runs),
        rooms(all_rooms),
        grids(runs.size()),
        divisions(runs.size()),
        first_chunks(runs.size()) {
    for (std::size_t run = 0; run < runs.size(); ++run) {
      grids[run] = BinGrid(runs[run].extent);
      first_chunks[run] = chunks.size();
      for (std::size_t i = runs[run].begin; i < runs[run].end; i += tuning::chunk_size)
        chunks.push_back({run, i, std::min(i + tuning::chunk_size, runs[run].end)});
    }
  }

  [[nodiscard]] std::span<BuildSphere> spheres_of(const Chunk& chunk) const {
    return spheres.subspan(chunk.begin, chunk.end - chunk.begin);
  }

  [[nodiscard]] std::size_t stride_of(std::size_t run) const {
    return boule::stride_of(runs[run].end - runs[run].begin, grids[run]);
  }

  /// Finds the best cut of each run.
  void find_cuts(const ParallelFor& parallel_for) {
    std::vector<Bins> bins(chunks.size());
    parallel_for(chunks.size(), [&](std::size_t i) {
      const std::size_t run = chunks[i].run;
      bins[i].add(grids[run], spheres_of(chunks[i]), stride_of(run));
    });
    parallel_for(runs.size(), [&](std::size_t run) {
      Bins& all = bins[first_chunks[run]];
      for (std::size_t i = first_chunks[run] + 1; i < chunks.size() && chunks[i].run == run; ++i)
        all.add(bins[i]);
      divisions[run].choose(all, grids[run]);
      if (divisions[run].cut.axis >= 0 || stride_of(run) == 1) return;
      Bins whole;  // the sample had only copies of one sphere
      whole.add(grids[run], spheres.subspan(runs[run].begin, runs[run].end - runs[run].begin));
      divisions[run].choose(whole, grids[run]);
    });
  }

  /// Divides the runs that have a cut. First each chunk is divided by itself. Then the right
  /// spheres before the middle of their run swap places with the left ones behind it.
  void divide(const ParallelFor& parallel_for) {
    parallel_for(chunks.size(), [&](std::size_t i) { divide(chunks[i]); });
    for (const Chunk& chunk : chunks) {
      Division& division = divisions[chunk.run];
      division.middle += chunk.lefts;
      division.left_extent.add(chunk.left_extent);
      division.right_extent.add(chunk.right_extent);
    }
    const std::vector<Exchange> exchanges = find_exchanges();
    parallel_for(exchanges.size(), [&](std::size_t i) {
      const auto first = spheres.begin() + static_cast<std::ptrdiff_t>(exchanges[i].a);
      std::swap_ranges(first, first + static_cast<std::ptrdiff_t>(exchanges[i].size),
                       spheres.begin() + static_cast<std::ptrdiff_t>(exchanges[i].b));
    });
  }

  /// The extents are found while the spheres are in the cache.
  void divide(Chunk& chunk) const {
    const Cut& cut = divisions[chunk.run].cut;
    if (cut.axis < 0) return;
    const std::span<BuildSphere> own = spheres_of(chunk);
    rooms.lend(own.size(), [&](std::span<BuildSphere> scratch) {
      chunk.lefts = partition(own, grids[chunk.run], cut, scratch);
    });
    chunk.left_extent = boule::extent_of(own.first(chunk.lefts));
    chunk.right_extent = boule::extent_of(own.subspan(chunk.lefts));
  }

  [[nodiscard]] std::vector<Exchange> find_exchanges() const {
    std::vector<Exchange> exchanges;
    std::vector<Piece> rights, lefts;  // of one run: the pieces on the wrong side
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      const Chunk& chunk = chunks[i];
      const Division& division = divisions[chunk.run];
      if (division.cut.axis < 0) continue;
      const std::size_t middle = runs[chunk.run].begin + division.middle;
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

  /// The division of a run.
  struct Division {
    Cut cut = {};
    std::size_t middle = 0;  ///< number of spheres that go left
    BuildBox left_extent = {}, right_extent = {};
    BuildBox box = {};  ///< box around all spheres of the bins, for weighing

    void choose(const Bins& bins, const BinGrid& grid) {
      for (const BuildBox& bin : bins.boxes[0]) box.add(bin);
      cut = best_cut(bins, grid.axes());
    }
  };

  std::span<BuildSphere> spheres;
  const std::vector<Run>& runs;
  ScratchRooms& rooms;
  std::vector<BinGrid> grids;
  std::vector<Division> divisions;
  std::vector<std::size_t> first_chunks;  ///< of each run
  std::vector<Chunk> chunks;
};

BinaryForest::BinaryForest(std::span<BuildSphere> spheres, const ParallelFor& parallel_for,
                           int depth)
    : spheres_(spheres),
      subtree_size_(std::max(tuning::least_subtree, spheres.size() / tuning::most_subtrees)) {
  std::vector<Run> runs;
  Run whole{0, spheres.size(), depth, ForestNode::upper, false};
  if (whole.end <= subtree_size_) {
    add_subtree(whole);
  } else {
    const ParallelFor level_for =
        spheres.size() < tuning::parallel_size ? serial_for : parallel_for;
    whole.extent = extent_of(spheres, level_for);
    runs.push_back(whole);
    while (!runs.empty()) runs = divide(runs, level_for);
    sort_subtrees();
  }
}

bool BinaryForest::is_twig(std::size_t subtree) const {
  const Subtree& one = subtrees_[subtree];
  return root_.is_upper() && (one.end - one.begin) * tuning::twigs < subtree_size_;
}

void BinaryForest::build(std::size_t index, std::vector<std::int32_t>* ids) {
  Subtree& subtree = subtrees_[index];
  const std::span<BuildSphere> own = spheres_.subspan(subtree.begin, subtree.end - subtree.begin);
  std::span<const std::int32_t> known;
  if (ids != nullptr) {
    ids->reserve(own.size());
    for (BuildSphere& sphere : own) {
      const auto place = static_cast<std::int32_t>(ids->size());
      ids->push_back(std::exchange(sphere.id, place));
    }
    known = *ids;
  }
  rooms_.lend(own.size(), [&](std::span<BuildSphere> scratch) {
    subtree.tree = build_binary_tree(own, scratch, subtree.depth, known);
  });
  subtree.root = subtree.tree.nodes[0];
}

void BinaryForest::drop(std::size_t subtree) {
  std::vector<BinaryNode>().swap(subtrees_[subtree].tree.nodes);
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
  Level level(spheres_, runs, rooms_);
  level.find_cuts(parallel_for);
  level.divide(parallel_for);
  std::vector<Run> next;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (level.divisions[i].cut.axis < 0) {
      add_subtree(runs[i]);
    } else {
      add_children(next, level, i);
    }
  }
  return next;
}

/// Makes an upper node of a divided run.
void BinaryForest::add_children(std::vector<Run>& next, const Level& level, std::size_t index) {
  const Run& run = level.runs[index];
  const Level::Division& division = level.divisions[index];
  const auto node = static_cast<std::uint32_t>(upper_.size());
  upper_.emplace_back().node.set_box(division.box);
  attach(run, {ForestNode::upper, node});
  const std::size_t middle = run.begin + division.middle;
  const Run left{run.begin, middle, run.depth + 1, node, false, division.left_extent};
  const Run right{middle, run.end, run.depth + 1, node, true, division.right_extent};
  for (const Run& child : {left, right}) {
    const std::size_t size = child.end - child.begin;
    const bool deep = child.depth + halving_levels(size) > bvh_max_depth;
    size <= subtree_size_ || deep ? add_subtree(child) : next.push_back(child);
  }
}

/// Sorts the subtrees into the order of their spheres.
void BinaryForest::sort_subtrees() {
  std::vector<std::uint32_t> order(subtrees_.size()), places(subtrees_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
    return subtrees_[a].begin < subtrees_[b].begin;
  });
  std::vector<Subtree> sorted;
  sorted.reserve(subtrees_.size());
  for (const std::uint32_t i : order) {
    places[i] = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(std::move(subtrees_[i]));
  }
  subtrees_ = std::move(sorted);
  const auto renumber = [&](ForestNode& node) {
    if (!node.is_upper()) node.tree = places[node.tree];
  };
  renumber(root_);
  for (UpperNode& upper : upper_) {
    renumber(upper.left);
    renumber(upper.right);
  }
}

/// From the last to the first, because children come after their parents. Subtrees above the size
/// of twigs count as leaves: each becomes a wide node of its own in any case.
void BinaryForest::weigh() {
  std::vector<CollapseCosts> costs(upper_.size());
  const auto costs_of = [&](ForestNode node) {
    if (node.is_upper()) return costs[node.node];
    return is_twig(node.tree) ? subtrees_[node.tree].tree.costs : CollapseCosts{};
  };
  for (std::size_t i = upper_.size(); i-- > 0;)
    costs[i] = choose_shares(upper_[i].node, costs_of(upper_[i].left), costs_of(upper_[i].right));
}

void BinaryForest::finish() {
  for (std::size_t i = upper_.size(); i-- > 0;) {
    UpperNode& upper = upper_[i];
    BuildBox box = (*this)[upper.left].box();
    box.add((*this)[upper.right].box());
    upper.node.set_box(box);
  }
}

const BinaryNode& BinaryForest::operator[](ForestNode node) const {
  if (node.is_upper()) return upper_[node.node].node;
  const Subtree& subtree = subtrees_[node.tree];
  return node.node == 0 ? subtree.root : subtree.tree.nodes[node.node];
}

ForestNode BinaryForest::left(ForestNode node) const {
  return node.is_upper() ? upper_[node.node].left : ForestNode{node.tree, node.node + 1};
}

ForestNode BinaryForest::right(ForestNode node) const {
  return node.is_upper() ? upper_[node.node].right : ForestNode{node.tree, (*this)[node].right};
}

}  // namespace boule
