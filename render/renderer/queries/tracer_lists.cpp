// All that rays cross, and how long they are inside.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "render/memory/available_memory.h"
#include "render/renderer/queries/result_room.h"
#include "render/renderer/queries/trace_worker.h"
#include "render/renderer/tracer.h"

namespace boule {
namespace {

struct Crossing {
  double t;
  std::int32_t id;
  bool entering;

  [[nodiscard]] double position() const { return t; }
  [[nodiscard]] auto key() const {
    return std::tuple(t, static_cast<std::uint32_t>(id), !entering);
  }
};

/// A part of a line.
struct Span {
  double begin, end;

  [[nodiscard]] double position() const { return begin; }
  [[nodiscard]] auto key() const { return std::pair(begin, end); }

  [[nodiscard]] double length() const { return end > begin ? end - begin : 0; }
};

struct ChordLength {
  std::int32_t id;
  double length;
};

/// Memory for sort_spread().
template <class Value>
struct SortRoom {
  std::vector<Value> values;
  std::vector<std::uint32_t> ends;
};

/// Sorts values that are mostly spread evenly over their range: into as many buckets as there are
/// values, and then each bucket. Value::position() rises with key().
template <class Value>
void sort_spread(std::span<Value> values, SortRoom<Value>& room) {
  const auto before = [](const Value& a, const Value& b) { return a.key() < b.key(); };
  constexpr std::size_t fewest = 16;
  if (values.size() < fewest) {
    std::sort(values.begin(), values.end(), before);
    return;
  }
  const auto [least, most] = std::minmax_element(
      values.begin(), values.end(),
      [](const Value& a, const Value& b) { return a.position() < b.position(); });
  const double low = least->position();
  const double scale = static_cast<double>(values.size() - 1) / (most->position() - low);
  if (!(scale > 0) || !std::isfinite(scale) ||
      values.size() > std::numeric_limits<std::uint32_t>::max()) {
    std::sort(values.begin(), values.end(), before);
    return;
  }
  const auto bucket_of = [&](const Value& value) {
    const auto bucket = static_cast<std::size_t>((value.position() - low) * scale);
    return std::min(bucket, values.size() - 1);
  };
  std::vector<std::uint32_t>& ends = room.ends;
  room.values.assign(values.begin(), values.end());
  ends.assign(values.size() + 1, 0);
  for (const Value& value : room.values) ++ends[bucket_of(value) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  for (const Value& value : room.values) values[ends[bucket_of(value)]++] = value;
  std::size_t begin = 0;
  for (std::size_t bucket = 0; bucket < values.size(); begin = ends[bucket++]) {
    if (ends[bucket] - begin > 1) {
      std::sort(values.begin() + static_cast<std::ptrdiff_t>(begin),
                values.begin() + static_cast<std::ptrdiff_t>(ends[bucket]), before);
    }
  }
}

/// Calls visit(t, entering) for each crossing that counts. A tangent is one.
template <class Visit>
void visit_crossings(const RayChord& chord, const RayInterval& interval, const Visit& visit) {
  if (interval.holds(chord.enter)) visit(chord.enter, true);
  if (chord.leave != chord.enter && interval.holds(chord.leave)) visit(chord.leave, false);
}

/// A few crossings of a ray, in order.
class FewCrossings {
 public:
  static constexpr std::size_t most_chords = 8;

  void add(const RayChord& chord, const RayInterval& interval) {
    std::array<Crossing, 2> ends;
    std::size_t left = 0, from = size_;
    visit_crossings(chord, interval, [&](double t, bool entering) {
      ends[left++] = {t, chord.id, entering};
    });
    size_ += left;
    for (std::size_t at = size_; left > 0; --at) {
      const bool moves = from > 0 && ends[left - 1].key() < crossings_[from - 1].key();
      crossings_[at - 1] = moves ? crossings_[--from] : ends[--left];
    }
  }
  [[nodiscard]] std::span<const Crossing> first(std::size_t limit) const {
    return std::span(crossings_).first(std::min(size_, limit));
  }

 private:
  std::array<Crossing, 2 * most_chords> crossings_;
  std::size_t size_ = 0;
};

/// Appends the crossings of one ray in order, at most `limit`.
void add_crossings(std::span<const RayChord> chords, const RayInterval& interval, std::size_t limit,
                   SortRoom<Crossing>& room, std::vector<Crossing>& to) {
  if (chords.size() <= FewCrossings::most_chords) {
    FewCrossings few;
    for (const RayChord& chord : chords) few.add(chord, interval);
    const auto wanted = few.first(limit);
    to.insert(to.end(), wanted.begin(), wanted.end());
    return;
  }
  const std::size_t before = to.size();
  for (const RayChord& chord : chords) {
    visit_crossings(chord, interval, [&](double t, bool entering) {
      to.push_back({t, chord.id, entering});
    });
  }
  sort_spread(std::span(to).subspan(before), room);
  if (to.size() - before > limit) to.resize(before + limit);
}

/// The part of a solid's chord that counts. A ray that leaves the solid on its inside begins at 0.
Span clip(const RayChord& chord, const RayInterval& interval, const Ray& ray) {
  const double enter = chord.id == ray.source ? 0 : chord.enter;
  return {std::max(enter, interval.tmin), std::min(chord.leave, interval.end())};
}

/// The length of the union. Reorders the spans.
double union_length(std::vector<Span>& spans, SortRoom<Span>& room) {
  sort_spread(std::span(spans), room);
  double length = 0;
  for (std::size_t k = 0; k < spans.size();) {
    Span joined = spans[k];
    for (++k; k < spans.size() && spans[k].begin <= joined.end; ++k)
      joined.end = std::max(joined.end, spans[k].end);
    length += joined.length();
  }
  return length;
}

/// Moves the items of all pieces into columns: copy(piece, first) does so for the items of one
/// piece, of which the first is the first-th of all. The pieces are freed one by one.
template <class Item, class Copy>
void spread(RayLists<Item>& lists, const Copy& copy) {
  std::size_t first = 0;
  for (std::vector<Item>& piece : lists.pieces) {
    copy(piece, first);
    first += piece.size();
    std::vector<Item>().swap(piece);
  }
}

}  // namespace

/// make_list() makes a function for one block: list(worker, k, chords, items) appends the items of
/// ray k of the worker. Results that exceed the memory are counted and not kept. `name`: of the
/// items.
template <class Item, class MakeList>
Result<RayLists<Item>> Tracer::list_items(const RayView& rays, const std::string& name,
                                          const MakeList& make_list) {
  const std::string of_rays = " of " + std::to_string(rays.size()) + " rays";
  const std::uint64_t offsets = (std::uint64_t{rays.size()} + 1) * sizeof(std::int64_t);
  if (auto done = check_memory(offsets, "the " + name + of_rays + " need"); !done)
    return done.error();
  RayLists<Item> lists;
  ResultRoom room(offsets, 2 * sizeof(Item));
  const auto make = [&] {
    lists.offset.assign(rays.size() + 1, 0);
    lists.pieces.resize(Blocks{rays.size(), rays_of_stream}.count());
  };
  if (auto done = diagnose(std::cref(make)); !done) return done.error();
  const auto body = [&](TraceWorker& worker, std::size_t first) {
    std::vector<Item> found;
    found.reserve(4 * worker.size());
    auto list = make_list();
    worker.find_chords(target(), [&](std::size_t k, std::span<const RayChord> chords) {
      const std::size_t before = found.size();
      list(worker, k, chords, found);
      lists.offset[first + k + 1] = static_cast<std::int64_t>(found.size() - before);
    });
    if (!room.take(found.size())) return;
    lists.pieces[first / rays_of_stream] = found;  // a copy, which takes no more than it needs
  };
  if (auto done = run(rays, rays.size(), std::cref(body)); !done) return done.error();
  if (auto done = room.check("the " + std::to_string(room.count()) + " " + name + of_rays); !done)
    return done.error();
  std::partial_sum(lists.offset.begin(), lists.offset.end(), lists.offset.begin());
  return lists;
}

Result<Crossings> Tracer::all_hits(const RayView& rays, std::optional<std::size_t> limit) {
  const std::size_t most = limit.value_or(static_cast<std::size_t>(-1));
  auto lists = list_items<Crossing>(rays, "crossings", [most] {
    return [most, room = SortRoom<Crossing>()](const TraceWorker& worker, std::size_t k,
                                               std::span<const RayChord> chords,
                                               std::vector<Crossing>& items) mutable {
      add_crossings(chords, worker.interval(k), most, room, items);
    };
  });
  if (!lists) return lists.error();
  Crossings all;
  const auto fill = [&] {
    all.offset = std::move(lists.value().offset);
    const auto size = static_cast<std::size_t>(all.offset.back());
    all.t.resize(size);
    all.id.resize(size);
    all.entering.resize(size);
    spread(lists.value(), [&](const std::vector<Crossing>& piece, std::size_t at) {
      for (const Crossing& crossing : piece) {
        all.t[at] = crossing.t;
        all.id[at] = crossing.id;
        all.entering[at++] = crossing.entering ? 1 : 0;
      }
    });
  };
  if (auto done = diagnose(std::cref(fill)); !done) return done.error();
  return all;
}

Status Tracer::count(const RayView& rays, std::span<std::int64_t> counts) {
  const auto body = [&](TraceWorker& worker, std::size_t first) {
    worker.find_chords(target(), [&](std::size_t k, std::span<const RayChord> chords) {
      std::int64_t count = 0;
      for (const RayChord& chord : chords)
        visit_crossings(chord, worker.interval(k), [&](double, bool) { ++count; });
      counts[first + k] = count;
    });
  };
  return run(rays, counts.size(), std::cref(body));
}

Status Tracer::chord(const RayView& rays, std::span<double> lengths) {
  const auto body = [&](TraceWorker& worker, std::size_t first) {
    std::vector<Span> spans;
    SortRoom<Span> room;
    worker.find_chords(target(), [&](std::size_t k, std::span<const RayChord> chords) {
      const Ray ray = worker.ray(k);
      spans.clear();
      for (const RayChord& chord : chords) {
        if (is_solid(chord.id)) spans.push_back(clip(chord, worker.interval(k), ray));
      }
      lengths[first + k] = union_length(spans, room);
    });
  };
  return run(rays, lengths.size(), std::cref(body));
}

Result<SphereChords> Tracer::chords(const RayView& rays) {
  const auto list = [this](const TraceWorker& worker, std::size_t k,
                           std::span<const RayChord> chords, std::vector<ChordLength>& items) {
    const auto before = static_cast<std::ptrdiff_t>(items.size());
    const Ray ray = worker.ray(k);
    for (const RayChord& chord : chords) {
      const double length = clip(chord, worker.interval(k), ray).length();
      if (is_solid(chord.id) && length > 0) items.push_back({chord.id, length});
    }
    std::sort(items.begin() + before, items.end(),
              [](const ChordLength& a, const ChordLength& b) { return a.id < b.id; });
  };
  auto lists = list_items<ChordLength>(rays, "chords", [&list] { return list; });
  if (!lists) return lists.error();
  SphereChords all;
  const auto fill = [&] {
    all.offset = std::move(lists.value().offset);
    const auto size = static_cast<std::size_t>(all.offset.back());
    all.id.resize(size);
    all.length.resize(size);
    spread(lists.value(), [&](const std::vector<ChordLength>& piece, std::size_t at) {
      for (const ChordLength& chord : piece) {
        all.id[at] = chord.id;
        all.length[at++] = chord.length;
      }
    });
  };
  if (auto done = diagnose(std::cref(fill)); !done) return done.error();
  return all;
}

}  // namespace boule
