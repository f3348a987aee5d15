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

/// What is stored of each ray: TracedHit, packed in 24 bytes,
/// [('t', '<f8'), ('id', '<i4'), ('normal', '<f4', (3,))]; or met, '|u1', 1 for a hit and 0 else.
enum class HitKind { closest, any };

/// Hits as a .npy file (format 1.0, little-endian, shape (N,)), written piece by piece. It appears
/// under its name when it is complete (OutputFile). Errors: "cannot write 'NAME': REASON". Like an
/// OutputFile it refuses all once it was committed, or moved away.
class HitFile {
 public:
  /// Begins the file of `count` hits; `stop` as for OutputFile::create().
  static Result<HitFile> create(const std::string& path, HitKind kind, std::uint64_t count,
                                const std::function<bool()>& stop = {});

  /// The temporary file.
  [[nodiscard]] const std::string& temporary() const { return file_.path(); }

  /// Writes the next hits; those of the other kind, or more than `count`, are an error. Throws
  /// std::bad_alloc.
  Status append(std::span<const TracedHit> hits);
  Status append(std::span<const std::uint8_t> met);

  /// Makes what is written so far durable, which takes its time: commit() is quick after it.
  Status sync();

  /// Gives the file its name; an error if there are not `count` hits in it. `stop` as for
  /// OutputFile.
  Status commit(const std::function<bool()>& stop = {});

 private:
  HitFile(OutputFile file, std::string name, HitKind kind, std::uint64_t count);
  Status take(HitKind kind, std::size_t hits);

  OutputFile file_;
  std::string name_;
  HitKind kind_;
  std::uint64_t left_;               ///< hits that are not in it yet
  std::vector<unsigned char> rows_;  ///< as in the file
};

/// True if `path` ends with ".npy" and has a name before it.
bool is_npy_name(const std::string& path);

}  // namespace boule
