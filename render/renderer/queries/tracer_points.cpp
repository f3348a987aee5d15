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
#include "render/renderer/queries/pair_finder.h"
#include "render/renderer/queries/point_order.h"
#include "render/renderer/queries/point_visitors.h"
#include "render/renderer/queries/result_room.h"
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

/// Calls body(rows, block) for the blocks of all points.
Status Tracer::run_points(const PointColumns& points, const PointBody& body) {
  static_assert(points_of_chunk % rays_of_stream == 0);
  if (workers_.empty()) return moved_away();
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
    const auto work = [&](unsigned, std::size_t block) {
      const std::size_t begin = block * rays_of_stream;
      const std::span rows = std::span<const std::uint32_t>(order.rows)
                                 .subspan(begin, std::min(rays_of_stream, count - begin));
      body({first, rows}, (first + begin) / rays_of_stream);
    };
    std::atomic<std::size_t> done{0};
    status = run_blocks({count, rays_of_stream}, std::cref(work), done);
    points_ += done;
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
  if (auto done = check_room("points", points.size(), ids.size()); !done) return done;
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
  ResultRoom room(fixed, 2 * sizeof(std::int32_t));
  Members all;
  std::vector<MemberPiece> pieces;
  const auto make = [&] {
    all.offset.assign(points.size() + 1, 0);
    pieces.resize(Blocks{points.size(), rays_of_stream}.count());
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
  if (auto done = room.check("the first " + std::to_string(room.count()) + " members" + of_points);
      !done)
    return done.error();
  const auto fill = [&] { gather(pieces, all); };
  if (auto done = diagnose(std::cref(fill)); !done) return done.error();
  return all;
}

Result<SpherePairs> Tracer::pairs(double gap) {
  if (workers_.empty()) return moved_away();
  if (std::isnan(gap)) return Diagnostic::about("gap", "must be a number, is nan");
  const FloatEnvironment environment;
  const Stopwatch watch;
  const GeometryView view = geometry_.view();
  const std::size_t blocks = SphereBlocks(view).size();
  const std::uint64_t fixed = (std::uint64_t{geometry_.sphere_count()} + 1) * sizeof(std::size_t);
  if (auto done = check_memory(fixed, "the pairs of spheres need"); !done) return done.error();
  ResultRoom room(fixed, 3 * sizeof(SpherePair));
  const Blocks of_pieces{blocks, 64};
  std::vector<std::vector<SpherePair>> pieces;
  const auto make = [&] { pieces.resize(of_pieces.count()); };
  if (auto done = diagnose(std::cref(make)); !done) return done.error();
  const auto work = [&](unsigned, std::size_t index) {
    PairFinder finder(geometry_, view, gap);
    std::vector<SpherePair> found;
    const std::size_t end = std::min(blocks, (index + 1) * of_pieces.size);
    for (std::size_t block = index * of_pieces.size; block < end && !room.is_full(); ++block) {
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
  std::atomic<std::size_t> ended{0};
  if (auto done = run_blocks(of_pieces, std::cref(work), ended); !done) return done.error();
  if (auto done = room.check("the first " + std::to_string(room.count()) + " pairs of spheres");
      !done)
    return done.error();
  SpherePairs all;
  const auto fill = [&] { gather(pieces, geometry_.sphere_count(), all); };
  if (auto done = diagnose(std::cref(fill)); !done) return done.error();
  trace_seconds_ += watch.seconds();
  return all;
}

}  // namespace boule
