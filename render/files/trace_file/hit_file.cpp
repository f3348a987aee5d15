#include "render/files/trace_file/hit_file.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/base/text.h"

namespace boule {
namespace {

constexpr std::size_t hit_bytes = 25, crossing_bytes = 21, member_bytes = 12, pair_bytes = 16;
constexpr std::size_t rows_per_write = 4096;

/// The header as numpy.save writes it: the count has room to grow to 21 digits, and the data begin
/// at a multiple of 64 bytes.
std::string npy_start(const std::string& descr, const std::string& shape) {
  constexpr std::size_t alignment = 64, before = 10, most_digits = 21;
  std::string dict = "{'descr': " + descr + ", 'fortran_order': False, 'shape': (" + shape + "), }";
  const std::size_t digits = shape.find(',');
  dict.append(most_digits - digits, ' ');
  while ((before + dict.size() + 1) % alignment != 0) dict += ' ';
  dict += '\n';
  std::string start("\x93NUMPY\x01\x00", 8);
  start += static_cast<char>(dict.size() & 255);
  start += static_cast<char>(dict.size() >> 8);
  return start + dict;
}

std::string shape_of(std::uint64_t count) { return std::to_string(count) + ","; }

/// Writes the lowest `width` bytes, the lowest first on every machine.
unsigned char* put(unsigned char* to, std::uint64_t bits, std::size_t width) {
  for (std::size_t i = 0; i < width; ++i) *to++ = static_cast<unsigned char>(bits >> (8 * i));
  return to;
}
unsigned char* put(unsigned char* to, float x) {
  return put(to, std::bit_cast<std::uint32_t>(x), 4);
}

unsigned char* put(unsigned char* to, const TracedHit& hit) {
  to = put(to, std::bit_cast<std::uint64_t>(hit.t), 8);
  to = put(to, static_cast<std::uint32_t>(hit.id), 4);
  to = put(to, hit.normal.x);
  to = put(to, hit.normal.y);
  to = put(to, hit.normal.z);
  return put(to, std::uint64_t{hit.entering}, 1);
}

std::string descr_of(HitKind kind) {
  switch (kind) {
    case HitKind::closest:
      return "[('t', '<f8'), ('id', '<i4'), ('normal', '<f4', (3,)), ('entering', '|b1')]";
    case HitKind::any:
      return "'|u1'";
    case HitKind::all:
      return "[('ray', '<i8'), ('t', '<f8'), ('id', '<i4'), ('entering', '|b1')]";
    case HitKind::count:
      return "'<i8'";
    case HitKind::chord:
      return "'<f8'";
    case HitKind::nearest:
      return "[('distance', '<f8'), ('id', '<i4')]";
    case HitKind::members:
      return "[('point', '<i8'), ('id', '<i4')]";
    case HitKind::pairs:
      return "[('first', '<i4'), ('second', '<i4'), ('gap', '<f8')]";
  }
  return {};
}

}  // namespace

HitFile::HitFile(OutputFile file, std::string name, HitKind kind, std::uint64_t count)
    : file_(std::move(file)),
      name_(std::move(name)),
      kind_(kind),
      left_(is_list(kind) ? 0 : count) {}

Result<HitFile> HitFile::create(const std::string& path, HitKind kind, std::uint64_t count,
                                const std::function<bool()>& stop) {
  return begin(path, kind, count, shape_of(is_list(kind) ? 0 : count), stop);
}

Result<HitFile> HitFile::create_nearest(const std::string& path, std::uint64_t count, std::size_t k,
                                        const std::function<bool()>& stop) {
  const std::string shape =
      k == 1 ? shape_of(count) : std::to_string(count) + ", " + std::to_string(k);
  return begin(path, HitKind::nearest, count * k, shape, stop);
}

Result<HitFile> HitFile::begin(const std::string& path, HitKind kind, std::uint64_t count,
                               const std::string& shape, const std::function<bool()>& stop) {
  Result<OutputFile> file = OutputFile::create(path, stop);
  if (!file) return file.error();
  const std::string start = npy_start(descr_of(kind), shape);
  if (auto done = file.value().write(start.data(), start.size()); !done) return done.error();
  return HitFile(std::move(file).value(), path, kind, count);
}

Status HitFile::take(HitKind kind, std::size_t hits) {
  if (kind != kind_) return cannot_write(name_, "hits of the other kind");
  if (is_list(kind)) {
    left_ += hits;
    return {};
  }
  if (hits > left_) return cannot_write(name_, "more hits than it is made for");
  left_ -= hits;
  return {};
}

template <class Put>
Status HitFile::write_rows(std::size_t count, std::size_t bytes, const Put& put_row) {
  rows_.resize(rows_per_write * bytes);
  for (std::size_t first = 0; first < count; first += rows_per_write) {
    unsigned char* end = rows_.data();
    const std::size_t last = std::min(count, first + rows_per_write);
    for (std::size_t k = first; k < last; ++k) end = put_row(end, k);
    const auto size = static_cast<std::size_t>(end - rows_.data());
    if (auto done = file_.write(rows_.data(), size); !done) return done;
  }
  return {};
}

Status HitFile::append(std::span<const TracedHit> hits) {
  if (auto done = take(HitKind::closest, hits.size()); !done) return done;
  return write_rows(hits.size(), hit_bytes,
                    [&](unsigned char* to, std::size_t k) { return put(to, hits[k]); });
}

Status HitFile::append(std::span<const std::int64_t> counts) {
  if (auto done = take(HitKind::count, counts.size()); !done) return done;
  return write_rows(counts.size(), 8, [&](unsigned char* to, std::size_t k) {
    return put(to, static_cast<std::uint64_t>(counts[k]), 8);
  });
}

Status HitFile::append(std::span<const double> lengths) {
  if (auto done = take(HitKind::chord, lengths.size()); !done) return done;
  return write_rows(lengths.size(), 8, [&](unsigned char* to, std::size_t k) {
    return put(to, std::bit_cast<std::uint64_t>(lengths[k]), 8);
  });
}

Status HitFile::append(const Crossings& crossings, std::uint64_t first_ray) {
  if (auto done = take(HitKind::all, crossings.t.size()); !done) return done;
  std::size_t ray = 0;
  return write_rows(crossings.t.size(), crossing_bytes, [&](unsigned char* to, std::size_t k) {
    while (crossings.offset[ray + 1] <= static_cast<std::int64_t>(k)) ++ray;
    to = put(to, first_ray + ray, 8);
    to = put(to, std::bit_cast<std::uint64_t>(crossings.t[k]), 8);
    to = put(to, static_cast<std::uint32_t>(crossings.id[k]), 4);
    return put(to, crossings.entering[k], 1);
  });
}

Status HitFile::append(const Members& members, std::uint64_t first_point) {
  if (auto done = take(HitKind::members, members.id.size()); !done) return done;
  std::size_t point = 0;
  return write_rows(members.id.size(), member_bytes, [&](unsigned char* to, std::size_t k) {
    while (members.offset[point + 1] <= static_cast<std::int64_t>(k)) ++point;
    to = put(to, first_point + point, 8);
    return put(to, static_cast<std::uint32_t>(members.id[k]), 4);
  });
}

Status HitFile::append(const SpherePairs& pairs) {
  if (auto done = take(HitKind::pairs, pairs.gap.size()); !done) return done;
  return write_rows(pairs.gap.size(), pair_bytes, [&](unsigned char* to, std::size_t k) {
    to = put(to, static_cast<std::uint32_t>(pairs.first[k]), 4);
    to = put(to, static_cast<std::uint32_t>(pairs.second[k]), 4);
    return put(to, std::bit_cast<std::uint64_t>(pairs.gap[k]), 8);
  });
}

Status HitFile::append(std::span<const double> distances, std::span<const std::int32_t> ids) {
  if (auto done = take(HitKind::nearest, ids.size()); !done) return done;
  return write_rows(ids.size(), member_bytes, [&](unsigned char* to, std::size_t k) {
    to = put(to, std::bit_cast<std::uint64_t>(distances[k]), 8);
    return put(to, static_cast<std::uint32_t>(ids[k]), 4);
  });
}

Status HitFile::append(std::span<const std::uint8_t> met) {
  if (auto done = take(HitKind::any, met.size()); !done) return done;
  return file_.write(met.data(), met.size());
}

/// The number of crossings is known only in the end.
Status HitFile::complete_header() {
  if (!is_list(kind_)) return {};
  const std::string start = npy_start(descr_of(kind_), shape_of(left_));
  return file_.rewrite_start(start.data(), start.size());
}

Status HitFile::sync() {
  if (auto done = complete_header(); !done) return done;
  return file_.sync();
}

Status HitFile::commit(const std::function<bool()>& stop) {
  if (!is_list(kind_) && left_ > 0)
    return cannot_write(name_, std::to_string(left_) + " hits are missing");
  if (auto done = complete_header(); !done) return done;
  return file_.commit(stop);
}

bool is_npy_name(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = ascii_lower(c);
  return extension == ".npy";
}

}  // namespace boule
