#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/frame/point_lists.h"
#include "render/frame/ray_lists.h"
#include "render/frame/traced_hit.h"
#include "render/image/output_file.h"

namespace boule {

/// What is stored, of rays:
/// - closest: a TracedHit in 25 bytes, [('t', '<f8'), ('id', '<i4'), ('normal', '<f4', (3,)),
///   ('entering', '|b1')].
/// - any: one byte, '|u1', which is 1 for a hit and 0 for a miss.
/// - all: a crossing in 21 bytes, [('ray', '<i8'), ('t', '<f8'), ('id', '<i4'), ('entering',
/// '|b1')];
///   `ray` is the row of the ray.
/// - count: the number of crossings, '<i8'.
/// - chord: a length, '<f8'.
/// And of points:
/// - nearest: a NearestPrimitive in 12 bytes, [('distance', '<f8'), ('id', '<i4')].
/// - members: a point and what it is in or near, in 12 bytes, [('point', '<i8'), ('id', '<i4')].
/// - pairs: two spheres in 16 bytes, [('first', '<i4'), ('second', '<i4'), ('gap', '<f8')].
enum class HitKind { closest, any, all, count, chord, nearest, members, pairs };

/// Whether a ray or point may have any number of records.
inline bool is_list(HitKind kind) {
  return kind == HitKind::all || kind == HitKind::members || kind == HitKind::pairs;
}

/// Hits as a .npy file (format 1.0, little-endian, shape (N,)), written piece by piece. Like an
/// OutputFile it appears under its name when it is complete, and its errors are "cannot write
/// 'NAME': REASON". After commit(), and after a move, it refuses all calls.
class HitFile {
 public:
  /// Begins a file of `count` hits; of a list of any number, whatever `count` is. `stop` is as for
  /// OutputFile::create().
  static Result<HitFile> create(const std::string& path, HitKind kind, std::uint64_t count,
                                const std::function<bool()>& stop = {});
  /// Begins a file of the k nearest primitives of `count` points: shape (count,), or (count, k) for
  /// k above 1.
  static Result<HitFile> create_nearest(const std::string& path, std::uint64_t count, std::size_t k,
                                        const std::function<bool()>& stop = {});

  /// The path of the temporary file.
  [[nodiscard]] const std::string& temporary() const { return file_.path(); }

  /// Writes the next hits. An error if they are of the other kind, or more than `count` in all.
  Status append(std::span<const TracedHit> hits);
  Status append(std::span<const std::uint8_t> met);
  Status append(std::span<const std::int64_t> counts);
  Status append(std::span<const double> lengths);
  /// The crossings of rays, the first of which is in this row.
  Status append(const Crossings& crossings, std::uint64_t first_ray);
  /// The same of points.
  Status append(const Members& members, std::uint64_t first_point);
  Status append(const SpherePairs& pairs);
  /// k rows of each point.
  Status append(std::span<const double> distances, std::span<const std::int32_t> ids);

  /// Makes the data durable. After the last hit, it saves commit() that time.
  Status sync();

  /// Gives the file its name. An error if it holds fewer than `count` hits. `stop` is as for
  /// OutputFile::commit().
  Status commit(const std::function<bool()>& stop = {});

 private:
  HitFile(OutputFile file, std::string name, HitKind kind, std::uint64_t count);
  static Result<HitFile> begin(const std::string& path, HitKind kind, std::uint64_t count,
                               const std::string& shape, const std::function<bool()>& stop);
  Status take(HitKind kind, std::size_t hits);
  Status complete_header();
  /// Writes `count` rows of `bytes`: put(to, k) writes row k and returns its end.
  template <class Put>
  Status write_rows(std::size_t count, std::size_t bytes, const Put& put);

  OutputFile file_;
  std::string name_;
  HitKind kind_;
  std::uint64_t left_;               ///< number of hits still to be written; of a list, written
  std::vector<unsigned char> rows_;  ///< of one write, as in the file
};

/// True if `path` ends with ".npy" and has a name before it.
bool is_npy_name(const std::string& path);

}  // namespace boule
