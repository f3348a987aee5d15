#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/frame/traced_hit.h"
#include "render/image/output_file.h"

namespace boule {

/// The stored form of a hit.
/// - closest: a TracedHit in 24 bytes, [('t', '<f8'), ('id', '<i4'), ('normal', '<f4', (3,))].
/// - any: one byte, '|u1', which is 1 for a hit and 0 for a miss.
enum class HitKind { closest, any };

/// Hits as a .npy file (format 1.0, little-endian, shape (N,)), written piece by piece. Like an
/// OutputFile it appears under its name when it is complete, and its errors are "cannot write
/// 'NAME': REASON". After commit(), and after a move, it refuses all calls.
class HitFile {
 public:
  /// Begins a file of `count` hits. `stop` is as for OutputFile::create().
  static Result<HitFile> create(const std::string& path, HitKind kind, std::uint64_t count,
                                const std::function<bool()>& stop = {});

  /// The path of the temporary file.
  [[nodiscard]] const std::string& temporary() const { return file_.path(); }

  /// Writes the next hits. An error if they are of the other kind, or more than `count` in all.
  Status append(std::span<const TracedHit> hits);
  Status append(std::span<const std::uint8_t> met);

  /// Makes the data durable. After the last hit, it saves commit() that time.
  Status sync();

  /// Gives the file its name. An error if it holds fewer than `count` hits. `stop` is as for
  /// OutputFile::commit().
  Status commit(const std::function<bool()>& stop = {});

 private:
  HitFile(OutputFile file, std::string name, HitKind kind, std::uint64_t count);
  Status take(HitKind kind, std::size_t hits);

  OutputFile file_;
  std::string name_;
  HitKind kind_;
  std::uint64_t left_;               ///< number of hits still to be written
  std::vector<unsigned char> rows_;  ///< of one write, as in the file
};

/// True if `path` ends with ".npy" and has a name before it.
bool is_npy_name(const std::string& path);

}  // namespace boule
