// What is near points, and near spheres.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/float_environment.h"
#include "core/scene/number_text.h"
#include "render/frame/stopwatch.h"
#include "render/memory/available_memory.h"
#include "render/renderer/point_order.h"
#include "render/renderer/point_visitors.h"
#include "render/renderer/tracer.h"
#include "simd/points/point_search.h"

namespace boule {
namespace {

/// Points that are put in order at a time, a multiple of the blocks.
constexpr std::size_t points_of_chunk = std::size_t{1} << 20;

Status check_radii(const RayNumbers& radius, std::size_t points) {
  const std::size_t rows = radius.ray_step == 0 ? std::min<std::size_t>(points, 1) : points;
  for (std::size_t row = 0; row < rows; ++row) {
    if (std::isnan(radius.at(row)))
      return Diagnostic::about("radius",
                               "row " + std::to_string(row) + ": must be a number, is nan");
  }
  return {};
}

/// Results in pieces, which are refused before they exceed the memory.
class Room {
 public:
  /// `bytes`: taken anyway; `bytes_each`: of a result in its piece and in its columns.
  Room(std::uint64_t bytes, std::uint64_t bytes_each) : bytes_(bytes), bytes_each_(bytes_each) {}

  /// Whether so many results more have room.
  bool take(std::size_t results) {
    count_ += results;
    return !is_full();
  }
  [[nodiscard]] bool is_full() const { return bytes() > available_; }
  /// An error if there were too many. `name`: of the results.
  [[nodiscard]] Status check(const std::string& name) const {
    if (!is_full()) return {};
    return Diagnostic::out_of_memory("the first " + std::to_string(count_) + " " + name + " need " +
                                     memory_text(bytes()) + ", there are " +
                                     memory_text(available_));
  }

 private:
  [[nodiscard]] std::uint64_t bytes() const { return bytes_ + count_ * bytes_each_; }

  std::uint64_t bytes_, bytes_each_;
  std::uint64_t available_ = available_memory();
  std::atomic<std::uint64_t> count_{0};
};

/// The members of one block of points, in the order in which they were asked.
struct MemberPiece {
  std::vector<std::size_t> rows;
  std::vector<std::int32_t> ids;
};

void gather(std::vector<MemberPiece>& pieces, Members& all) {
  std::partial_sum(all.offset.begin(), all.offset.end(), all.offset.begin());
  all.id.resize(static_cast<std::size_t>(all.offset.back()));
  for (MemberPiece& piece : pieces) {
    auto from = piece.ids.begin();
    for (const std::size_t row : piece.rows) {
      const auto size = static_cast<std::ptrdiff_t>(all.offset[row + 1] - all.offset[row]);
      std::copy_n(from, size, all.id.begin() + static_cast<std::ptrdiff_t>(all.offset[row]));
      from += size;
    }
    piece = {};
  }
}

/// Puts the pairs in order. Precondition: `first` is below `spheres`.
void gather(std::vector<std::vector<SpherePair>>& pieces, std::size_t spheres, SpherePairs& all) {
  std::vector<std::size_t> ends(spheres + 1, 0);
  for (const auto& piece : pieces) {
    for (const SpherePair& pair : piece) ++ends[static_cast<std::size_t>(pair.first) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<SpherePair> sorted(ends.back());
  for (auto& piece : pieces) {
    for (const SpherePair& pair : piece)
      sorted[ends[static_cast<std::size_t>(pair.first)]++] = pair;
    std::vector<SpherePair>().swap(piece);
  }
  std::size_t begin = 0;
  for (std::size_t first = 0; first < spheres; begin = ends[first++]) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
              sorted.begin() + static_cast<std::ptrdiff_t>(ends[first]),
              [](const SpherePair& a, const SpherePair& b) { return a.second < b.second; });
  }
  all.first.resize(sorted.size());
  all.second.resize(sorted.size());
  all.gap.resize(sorted.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    all.first[k] = sorted[k].first;
    all.second[k] = sorted[k].second;
    all.gap[k] = sorted[k].gap;
  }
}

}  // namespace

/// Runs work(block) for all blocks of `size` things each, of which there are `all`.
Status Tracer::run_points(std::size_t all, std::size_t size,
                          const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> done{0};
  const auto body = [&](unsigned index, std::size_t block) {
    work(block);
    done += std::min(size, all - block * size);
    if (index == 0 && options_.progress)
      options_.progress({static_cast<double>(done) / static_cast<double>(all), done});
  };
  Status status = scheduler_.run((all + size - 1) / size, std::cref(body), options_.cancel);
  if (!status) return status;
  if (done != all) return Diagnostic::of("tracing was cancelled");
  return {};
}

/// Calls body(rows, block) for the blocks of all points.
Status Tracer::run_points(const PointColumns& points, const PointBody& body) {
  static_assert(points_of_chunk % rays_of_stream == 0);
  if (workers_.empty()) return Diagnostic::of("the tracer was moved away");
  const FloatEnvironment environment;
  if (auto done = check_points(points); !done) return done;
  const Stopwatch watch;
  Status status;
  PointOrder order;
  for (std::size_t first = 0; status && first < points.size(); first += points_of_chunk) {
    const std::size_t count = std::min(points_of_chunk, points.size() - first);
    const auto make = [&] { order.make(points, first, count); };
    status = diagnose(std::cref(make));
    if (!status) break;
    const auto work = [&](std::size_t block) {
      const std::size_t begin = block * rays_of_stream;
      const std::span rows = std::span<const std::uint32_t>(order.rows)
                                 .subspan(begin, std::min(rays_of_stream, count - begin));
      body({first, rows}, (first + begin) / rays_of_stream);
    };
    status = run_points(count, rays_of_stream, std::cref(work));
  }
  trace_seconds_ += watch.seconds();
  return status;
}

Status Tracer::nearest(const PointColumns& points, std::size_t k, double limit,
                       const NearestColumns& found) {
  if (k < 1) return Diagnostic::about("k", "must be at least 1, is 0");
  if (std::isnan(limit)) return Diagnostic::about("limit", "must be a number, is nan");
  const GeometryView view = geometry_.view();
  const auto body = [&](const PointRows& rows, std::size_t) {
    NearestVisitor visitor(geometry_, k, limit);
    PointSearch<NearestVisitor> search(view, visitor);
    rows.visit([&](std::size_t row) {
      const Vec3d point = points.at(row);
      visitor.start(point);
      search.search(point);
      visitor.finish(found.distance + row * k, found.id + row * k);
    });
  };
  return run_points(points, std::cref(body));
}

Result<Members> Tracer::inside(const PointColumns& points) {
  const double surface = 0;
  return within(points, surface);
}

Status Tracer::first_inside(const PointColumns& points, std::span<std::int32_t> ids) {
  if (ids.size() != points.size())
    return Diagnostic::of("there are " + std::to_string(points.size()) + " points, but room for " +
                          std::to_string(ids.size()) + " results");
  const GeometryView view = geometry_.view();
  const auto body = [&](const PointRows& rows, std::size_t) {
    MemberVisitor visitor(geometry_);
    PointSearch<MemberVisitor> search(view, visitor);
    rows.visit([&](std::size_t row) {
      const Vec3d point = points.at(row);
      visitor.start(point, 0);
      search.search(point);
      const auto& members = visitor.finish();
      ids[row] = members.empty() ? no_primitive : members.front();
    });
  };
  return run_points(points, std::cref(body));
}

Result<Members> Tracer::within(const PointColumns& points, double radius) {
  return within(points, RayNumbers{reinterpret_cast<const unsigned char*>(&radius), 0, 0, true});
}

Result<Members> Tracer::within(const PointColumns& points, const RayNumbers& radius) {
  if (auto done = check_radii(radius, points.size()); !done) return done.error();
  const std::string of_points = " of " + std::to_string(points.size()) + " points";
  const std::uint64_t fixed =
      (std::uint64_t{points.size()} + 1) * (sizeof(std::int64_t) + sizeof(std::size_t));
  if (auto done = check_memory(fixed, "the members" + of_points + " need"); !done)
    return done.error();
  Room room(fixed, 2 * sizeof(std::int32_t));
  Members all;
  std::vector<MemberPiece> pieces;
  const auto make = [&] {
    all.offset.assign(points.size() + 1, 0);
    pieces.resize(blocks_of(points.size()));
  };
  if (auto done = diagnose(std::cref(make)); !done) return done.error();
  const GeometryView view = geometry_.view();
  const auto body = [&](const PointRows& rows, std::size_t block) {
    MemberVisitor visitor(geometry_);
    PointSearch<MemberVisitor> search(view, visitor);
    MemberPiece piece;
    rows.visit([&](std::size_t row) {
      if (room.is_full()) return;
      const Vec3d point = points.at(row);
      visitor.start(point, radius.at(row));
      search.search(point);
      const auto& members = visitor.finish();
      if (!room.take(members.size())) return;
      piece.rows.push_back(row);
      piece.ids.insert(piece.ids.end(), members.begin(), members.end());
      all.offset[row + 1] = static_cast<std::int64_t>(members.size());
    });
    pieces[block] = {piece.rows, piece.ids};  // copies, which take no more than they need
  };
  if (auto done = run_points(points, std::cref(body)); !done) return done.error();
  if (auto done = room.check("members" + of_points); !done) return done.error();
  const auto fill = [&] { gather(pieces, all); };
  if (auto done = diagnose(std::cref(fill)); !done) return done.error();
  return all;
}

Result<SpherePairs> Tracer::pairs(double gap) {
  if (workers_.empty()) return Diagnostic::of("the tracer was moved away");
  if (std::isnan(gap)) return Diagnostic::about("gap", "must be a number, is nan");
  const FloatEnvironment environment;
  const Stopwatch watch;
  const GeometryView view = geometry_.view();
  const std::size_t blocks = SphereBlocks(view).size();
  const std::uint64_t fixed = (std::uint64_t{geometry_.sphere_count()} + 1) * sizeof(std::size_t) +
                              std::uint64_t{blocks} * sizeof(BlockBounds);
  if (auto done = check_memory(fixed, "the pairs of spheres need"); !done) return done.error();
  Room room(fixed, 3 * sizeof(SpherePair));
  constexpr std::size_t blocks_of_piece = 64;
  std::vector<std::vector<SpherePair>> pieces;
  std::vector<BlockBounds> bounds;
  const auto make = [&] {
    pieces.resize((blocks + blocks_of_piece - 1) / blocks_of_piece);
    bounds.reserve(blocks);
    for (std::size_t block = 0; block < blocks; ++block)
      bounds.push_back(bounds_of(SphereBlocks(view).at(block).spheres()));
  };
  if (auto done = diagnose(std::cref(make)); !done) return done.error();
  const auto work = [&](std::size_t index) {
    PairFinder finder(geometry_, view, bounds, gap);
    std::vector<SpherePair> found;
    const std::size_t end = std::min(blocks, (index + 1) * blocks_of_piece);
    for (std::size_t block = index * blocks_of_piece; block < end && !room.is_full(); ++block) {
      const std::size_t before = found.size();
      finder.find(block, found);
      if (!room.take(found.size() - before)) found.clear();
    }
    // A damaged packed file may name other ids.
    std::erase_if(found, [this](const SpherePair& pair) {
      return pair.first < 0 || static_cast<std::size_t>(pair.second) >= geometry_.sphere_count();
    });
    pieces[index] = found;  // a copy, which takes no more than it needs
  };
  if (auto done = run_points(blocks, blocks_of_piece, std::cref(work)); !done) return done.error();
  if (auto done = room.check("pairs of spheres"); !done) return done.error();
  SpherePairs all;
  const auto fill = [&] { gather(pieces, geometry_.sphere_count(), all); };
  if (auto done = diagnose(std::cref(fill)); !done) return done.error();
  trace_seconds_ += watch.seconds();
  return all;
}

}  // namespace boule
