#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/particle_file.h"

namespace boule {

/// Keeps particle files open from frame to frame of a series: the frames of a trajectory are then
/// found once and not for each picture. For one thread at a time.
class ParticleFileCache {
 public:
  /// As ParticleFile::open(), which it calls unless it has the file, read with the same options;
  /// one that has changed since, by its size or the time of its last change, is opened anew. The
  /// pointer is never null.
  Result<std::shared_ptr<ParticleFile>> open(const std::string& path,
                                             const ParticleFileOptions& options,
                                             const ParallelFor& parallel_for);

  /// Closes the files that were not asked for since the last call.
  void close_unused();

  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  /// What tells one state of a file from another; all 0 where the system does not tell.
  struct Stamp {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  ///< of the last change

    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct Entry {
    std::string path;
    ParticleFileOptions options;
    Stamp stamp;
    std::shared_ptr<ParticleFile> file;
    bool is_used = true;
  };

  static Stamp stamp_of(const std::string& path);

  std::vector<Entry> entries_;
};

}  // namespace boule
